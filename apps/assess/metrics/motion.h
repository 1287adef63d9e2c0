#pragma once

#include <vector>

#include "anatomy/geometry/pose.h"

namespace palpa::metrics {

/// One recorded tick of a tool: any rate, any frame that rests with the patient.
struct RawSample {
  double t_s = 0;             ///< rising
  Vec3 tip = Vec3::Zero();    ///< m
  Vec3 axis = Vec3::UnitZ();  ///< unit, along the tool toward the tip
  double inserted = 0;        ///< m of the tool's shaft in tissue; 0: outside
  double force = 0;           ///< N, magnitude
};

/// The same at an even rate: means over steps of 20 ms. A sensor's steps and noise would otherwise
/// add up to metres of path; what a hand does on purpose lies below 2 Hz (98.9 % of its power) and
/// stays as it is.
struct Motion {
  static constexpr double kStep_s = 0.02;
  std::vector<Vec3> tip, axis;
  std::vector<double> inserted, force;
  std::size_t size() const { return tip.size(); }
  double seconds() const { return static_cast<double>(size()) * kStep_s; }
};

/// A step without a sample repeats the one before it. Throws Error for samples that run backward or
/// are not finite.
Motion motionOf(const std::vector<RawSample>& samples);

/// m/s between neighbours, one less than the motion has steps; in rad/s of the axis.
std::vector<double> speedsOf(const Motion& motion);
std::vector<double> turningSpeedsOf(const Motion& motion);

}  // namespace palpa::metrics
