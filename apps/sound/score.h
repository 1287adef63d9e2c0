#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "apps/runtime/clock.h"

namespace palpa::sound {

/// What can be heard.
enum class Cue : std::uint8_t { beat, blood, arterial_blood, warning, alarm };
inline constexpr int kCues = 5;

/// How urgent what the screen says is: high where force is taken away.
enum class Urgency : std::uint8_t { none, medium, high };

/// What whoever performs is shown at a moment, as far as there is a sound for it. Nothing else
/// comes in here: so no sound can tell more than the screen does.
struct Seen {
  int trial = 0;
  bool running = false;  ///< the trial is on and not paused
  Urgency urgency = Urgency::none;
  double blood = 0;       ///< fraction of the syringe that is filled with blood, 0..1
  bool arterial = false;  ///< the screen says in words that it is an artery's
  bool operator==(const Seen&) const = default;
};

/// A cue starts.
struct CueStart {
  Cue cue = Cue::beat;
  std::int64_t t_ns = 0;  ///< session time
  bool operator==(const CueStart&) const = default;
};

/// Decides which cue starts when. Pure: no audio, no clock, no thread.
///   beat     at every whole multiple of 60 s / rate of session time while a trial runs, so that a
///            pause shifts none; one that is noticed too late is left out
///   blood    once for each flash: the level in the syringe rises after a second without a rise (an
///            artery's rests between its beats, 0.83 s apart, for less); again where the screen
///            meanwhile says that it is an artery's
///   warning, alarm   with the first moment of an urgency, at its rise from medium to high, and
///            every 15 s while it stands. What was high stays so until nothing is urgent: one burst
///            does not follow another because the screen's reason changes
class Score {
 public:
  static constexpr std::int64_t kFlashOver_ns = runtime::kSecond;
  /// The longest that IEC 60601-1-8 (2006, table 3) leaves between bursts of high priority.
  static constexpr std::int64_t kAgain_ns = 15 * runtime::kSecond;
  static constexpr std::int64_t kTooLate_ns = 50 * runtime::kMillisecond;  ///< [chosen] of a beat

  /// Beats a minute, above 0; empty: there is no heart, or none that may be heard.
  explicit Score(std::optional<double> heart_per_min) : heart_per_min_(heart_per_min) {}

  /// What starts since the last call, in the order of Cue. `now_ns` does not go back.
  std::vector<CueStart> next(const Seen& seen, std::int64_t now_ns);

 private:
  void addBeats(const Seen& seen, std::int64_t now_ns, std::vector<CueStart>* starts) const;
  void addBlood(const Seen& seen, std::int64_t now_ns, std::vector<CueStart>* starts);
  void addAlarm(const Seen& seen, std::int64_t now_ns, std::vector<CueStart>* starts);

  std::optional<double> heart_per_min_;
  std::int64_t last_ns_ = -1;  ///< of the call before; -1: there was none
  int trial_ = 0;
  double level_ = 0;                           ///< of blood, as last seen
  std::int64_t rose_ns_ = -2 * kFlashOver_ns;  ///< it last rose
  bool said_arterial_ = false;                 ///< of this flash
  Urgency standing_ = Urgency::none;
  std::int64_t again_ns_ = 0;
};

}  // namespace palpa::sound
