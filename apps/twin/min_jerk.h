#pragma once

#include <algorithm>

#include "anatomy/geometry/pose.h"

namespace palpa::twin {

/// Voluntary movement between two poses with minimum jerk (Flash and Hogan 1985):
/// s(u) = 10 u^3 - 15 u^4 + 6 u^5; peak speed is 1.875 times the mean.
class MinJerk {
 public:
  MinJerk() = default;
  MinJerk(const Pose& from, const Pose& to, double start_s, double duration_s)
      : from_(from), to_(to), start_s_(start_s), duration_s_(std::max(duration_s, 1e-3)) {}

  Pose at(double t_s) const {
    const double u = std::clamp((t_s - start_s_) / duration_s_, 0.0, 1.0);
    const double s = u * u * u * (10 + u * (6 * u - 15));
    const Vec3 p = from_.translation() + s * (to_.translation() - from_.translation());
    return makePose(
        Quat(from_.rotation()).slerp(s, Quat(to_.rotation())).normalized().toRotationMatrix(), p);
  }
  bool done(double t_s) const { return t_s >= start_s_ + duration_s_; }

 private:
  Pose from_ = Pose::Identity(), to_ = Pose::Identity();
  double start_s_ = 0, duration_s_ = 1e-3;
};

}  // namespace palpa::twin
