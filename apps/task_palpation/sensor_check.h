#pragma once

#include <string>
#include <vector>

#include "haptics/loop/tick_config.h"

namespace palpa::task_palpation {

/// Whether a force sensor that still speaks can be meant, by what everybody knows of a phantom on
/// the table: nothing pushes in the air, what is pressed pushes back, and it does so about as its
/// silicone was identified to. A lump that is not there changes nothing of that: the sensor lies
/// before it.
///     drifted    0.1 s long, more than the loop takes for touch, the tip 4 mm or more above the
///                top
///     reversed   0.1 s long, more than that toward the phantom, the tip 2 mm or more below the
///                top
///     scale      the last five presses of 3 mm or more gave less than half or more than twice
///                H(depth) of their places, in the median: registration errs by a millimetre,
///                silicone ages, but not that much
class SensorCheck {
 public:
  explicit SensorCheck(const haptics::TickConfig& config);
  void reset();
  /// Every tick. What is wrong and what to do, in a clause; empty: nothing.
  std::string add(const haptics::FlightRecord& record);
  /// Now, of one tick: a force that is sensed in the air, N; 0: none, or not in the air.
  double inTheAir(const haptics::FlightRecord& record) const;

 private:
  struct Sensed {
    double height = 0;  ///< m, of the tip over the top, along its normal
    Vec3 p_P = Vec3::Zero();
    Vec3 f_P = Vec3::Zero();  ///< turned so that this normal is z
  };
  Sensed sensedIn(const haptics::FlightRecord& record) const;
  std::string pressed(const Sensed& now);

  Pose X_PD_;
  TopShape top_;
  double radius_;
  haptics::StiffnessModulation law_;
  haptics::LearntMap map_;
  double air_s_ = 0, reversed_s_ = 0;
  std::int64_t last_ns_ = -1;
  double deepest_ = 0, ratio_ = 0;  ///< of this press
  std::vector<double> ratios_;      ///< of the last presses
};

}  // namespace palpa::task_palpation
