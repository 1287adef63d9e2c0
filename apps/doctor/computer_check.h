#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "apps/doctor/finding.h"
#include "apps/doctor/picture_facts.h"
#include "apps/runtime/clock.h"
#include "apps/sound/loudspeaker.h"

namespace palpa::doctor {

/// How steadily a thread of this computer runs: a thousand steps of a millisecond, with what a
/// session asks of the system.
struct LoopFacts {
  std::string priority;  ///< what becomeRealTime said
  double rate_Hz = 0;
  double late_99_us = 0;    ///< 99 of 100 steps began no later
  std::string memory = {};  ///< what MemoryLock said; empty: not asked
};
LoopFacts measureLoop();
/// `needed`: a real device is held by this loop; the virtual bench waits for nobody.
Finding judgeLoop(const LoopFacts& facts, bool needed);

/// Room for what a session leaves, in the folder where results go.
struct DiskFacts {
  std::filesystem::path folder;
  bool writable = true;
  std::uint64_t free_bytes = 0;
};
DiskFacts measureDisk(const std::filesystem::path& folder);
Finding judgeDisk(const DiskFacts& facts);

/// Whether everything that windows and paper say can be drawn; `root`: where the system's files
/// are.
Finding judgeLetters(const std::filesystem::path& root = "/");

/// The computer's date, by which sessions and calibrations are dated. `now_utc` as in a calibration
/// file; `built_utc`: when the program was made: earlier than that it cannot be.
Finding judgeDate(const std::string& now_utc, const std::string& built_utc);

/// What pictures are drawn with.
struct Drawing {
  std::string context;                  ///< "X11 window"
  std::string renderer;                 ///< as OpenGL names it; empty: not known
  bool on_processor = false;            ///< no graphics processor draws
  std::vector<std::string> cards = {};  ///< that could, by number
};
/// What a desktop has: `trouble`, why no window can be opened, with `advice`; else its monitors.
struct Desktop {
  std::string trouble, advice;
  bool is_there = false;              ///< where nobody sits there is none, and that is well
  std::vector<std::string> monitors;  ///< from the left: "HDMI-1, 1920x1080"
};
Finding judgeDesktop(const Desktop& desktop);

/// Pictures can be drawn, and by what. `draw` makes a context and says which, or throws.
Finding askDrawing(const std::function<Drawing()>& draw);

/// What a session's sounds would be played on.
Finding judgeSound(const sound::SpeakerFound& found);

/// A headset's OpenXR runtime, by the file that names it: its library is there. `file` empty: none
/// is installed.
Finding judgeHeadset(const std::filesystem::path& file);
/// $XR_RUNTIME_JSON, else active_runtime.json in the usual places; empty: none.
std::filesystem::path headsetRuntime();

/// The language settings name what is installed.
Finding askLocale();

/// The program's own files.
Finding askAssets();

/// How the computer's clocks went for a while.
struct ClockFacts {
  std::int64_t resolution_ns = 1;  ///< of the clock by which sessions run
  double seconds = 0;              ///< how long they were watched
  /// how much further the date went than that clock: it was set meanwhile
  double date_moved_ms = 0;
  bool synchronised = true;  ///< the date is kept by a time server
};

/// Watches them from its making until it is asked.
class ClockWatch {
 public:
  ClockWatch();
  ClockFacts facts() const;

 private:
  std::int64_t ahead() const;  ///< of the date before that clock
  runtime::SteadyClock clock_;
  std::int64_t ahead_;
};

/// `shared`: several stations write into the same records, and their dates should agree.
/// `pictures`: whether the camera dates its pictures by this computer's clock.
Finding judgeClocks(const ClockFacts& facts, const PictureFacts& pictures, bool shared);

}  // namespace palpa::doctor
