#pragma once

#include <cstdint>
#include <filesystem>
#include <fstream>
#include <string>

#include "apps/runtime/activity.h"
#include "apps/runtime/bus.h"
#include "apps/runtime/clock.h"
#include "haptics/loop/tick_config.h"

namespace palpa::runtime {

/// RECORDER: drains what the others queued into the session's evidence and commits it every 100
/// ticks. Once a minute of the session, memory that is free goes back to the system: a session of
/// hours would keep a little more at every hitch of the computer. It is the thread that may wait.
class RecorderActivity final : public Activity {
 public:
  RecorderActivity(Bus& bus, FlightSink& sink,
                   std::int64_t tick_period_ns = haptics::TickConfig{}.period_ns)
      : bus_(bus), sink_(sink), period_ns_(kTicks * tick_period_ns) {}
  const char* name() const override { return "recorder"; }
  std::int64_t step(std::int64_t now_ns) override;
  /// After the executive has stopped: the rest.
  void finish() { drain(); }

  /// Records lost because the recorder could not keep up; 0 in virtual time.
  std::uint64_t dropped() const {
    return bus_.haptic_to_recorder.overflows() + bus_.geometry_to_recorder.overflows() +
           bus_.keyframes_to_recorder.overflows() + bus_.task_to_recorder.overflows();
  }

 private:
  /// half of what a killed process may lose; the queue holds 8192
  static constexpr std::int64_t kTicks = 100;
  static constexpr std::int64_t kKeepsFree_ns = 60 * kSecond;
  void drain();
  Bus& bus_;
  FlightSink& sink_;
  const std::int64_t period_ns_;
  std::int64_t gives_back_ns_ = kKeepsFree_ns;
};

/// Pictures with their times: NAME.mjpeg, JPEG after JPEG (any player shows it; what is on the disk
/// stays readable if the program is killed), and NAME.mjpeg.csv: number, time of exposure (session,
/// ns) and what else its header names. One writer, one thread. A full disk ends it: `trouble`.
class PictureFile {
 public:
  /// `columns`: the table's, after the first two. Throws Error where the files cannot be made.
  PictureFile(const std::filesystem::path& folder, const std::string& name,
              const std::string& columns);
  /// `quality`: JPEG's, to 100; `fields`: those columns of this picture.
  void add(const cv::Mat& picture, std::int64_t t_ns, int quality, const std::string& fields);
  std::uint64_t bytes() const { return bytes_; }
  std::uint64_t pictures() const { return pictures_; }
  const std::string& trouble() const { return trouble_; }  ///< empty: everything was kept

 private:
  std::filesystem::path film_;
  std::ofstream pictures_file_, table_;
  std::uint64_t pictures_ = 0, bytes_ = 0;
  std::string trouble_;
};

/// A session's pictures beside their poses: a `PictureFile` "camera", with source ("virtual
/// camera": simulated), fault, tracking, pose of the board in the camera (m, quaternion), as
/// measured. On the camera's thread.
class VideoRecorder {
 public:
  explicit VideoRecorder(const std::filesystem::path& folder);
  void add(const CameraView& view);
  std::uint64_t pictures() const { return file_.pictures(); }
  const std::string& trouble() const { return file_.trouble(); }

 private:
  PictureFile file_;
};

}  // namespace palpa::runtime
