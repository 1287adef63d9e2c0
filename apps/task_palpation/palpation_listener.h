#pragma once

#include <vector>

#include "apps/assess/palpation/palpation_sample.h"
#include "haptics/tick.h"

namespace palpa::task_palpation {

/// Makes of recorded ticks what a palpation is judged by; the same for a session and for its
/// replay. Place: the lowest point of the round tip, on whose end T is. How hard it is pressed:
/// what the hand has to hold against along P's z, the real thing and the device together. A mark:
/// button 1 of the device goes down while the tip is not above the phantom's top by more than
/// `kOver`; beside the area, too, where it is a false alarm.
class PalpationListener {
 public:
  static constexpr std::uint32_t kMark = 1;  ///< bit of DeviceReading::buttons
  static constexpr double kOver =
      0.010;  ///< m above the top, at which a button still means the phantom
  explicit PalpationListener(const haptics::TickConfig& config);

  void begin(std::uint32_t trial);  ///< everything so far is forgotten
  /// Counts while the trial is on and the force may be rendered. True for a sample that was kept
  /// (one in 10 ms).
  bool add(const haptics::FlightRecord& record);
  /// What was said of the mark with this number, from 1; 0: the last one. Figures of 0: of that
  /// nothing was said.
  void grade(double diameter, int hardness, int mobility, std::size_t mark = 0);

  double seconds() const { return seconds_; }  ///< of the trial, pauses left out
  const std::vector<assess::PalpationSample>& samples() const { return samples_; }
  const std::vector<assess::LumpMark>& marks() const { return marks_; }

 private:
  Pose X_PD_, X_ET_;
  double radius_;
  std::uint32_t trial_ = 0;
  std::int64_t last_ns_ = -1, kept_ns_ = -1;
  double seconds_ = 0;
  bool pressed_ = false;
  std::vector<assess::PalpationSample> samples_;
  std::vector<assess::LumpMark> marks_;
};

}  // namespace palpa::task_palpation
