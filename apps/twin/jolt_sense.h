#pragma once

#include <algorithm>
#include <cmath>

#include "anatomy/geometry/pose.h"
#include "apps/runtime/random.h"

namespace palpa::twin {

/// What fingers notice of sudden changes of force. A change is what differs from the force that one has got used to:
///   jolt = |f_fast - f_slow|,   f_fast, f_slow: the force, low-passed with 3 ms and 50 ms
/// and is noticed where jolt > (w |f_slow| + f_0) (1 + s n), n standard normal, at most once in 25 ms. Roughness is the root mean square of the jolt over a stroke, with a floor: r = sqrt(mean jolt^2 + r_0^2).
class JoltSense {
 public:
  struct Limits {
    double weber = 0.25;        ///< w
    double least_N = 0.05;      ///< f_0
    double spread = 0.15;       ///< s
    double rough_floor_N = 0.1; ///< r_0
  };
  JoltSense(const Limits& limits, runtime::RandomStream noise) : limits_(limits), noise_(noise) {}

  /// The next `dt` seconds; true: a jolt is noticed now.
  bool feel(const Vec3& f, double dt) {
    constexpr double kFast = 0.003, kSlow = 0.050, kRest = 0.025;   // s
    if (!started_) fast_ = slow_ = f;
    started_ = true;
    fast_ += (f - fast_) * (dt / (kFast + dt));
    slow_ += (f - slow_) * (dt / (kSlow + dt));
    const double jolt = (fast_ - slow_).norm();
    squares_ += jolt * jolt * dt;
    seconds_ += dt;
    rest_ -= dt;
    if (rest_ > 0) return false;
    const double least = (limits_.weber * slow_.norm() + limits_.least_N) * (1 + limits_.spread * noise_.normal());
    if (jolt <= std::max(least, 0.0)) return false;
    rest_ = kRest;
    return true;
  }
  void beginStroke() { squares_ = seconds_ = 0; }
  double roughness() const { return std::sqrt((seconds_ > 0 ? squares_ / seconds_ : 0) + limits_.rough_floor_N * limits_.rough_floor_N); }

 private:
  Limits limits_;
  runtime::RandomStream noise_;
  Vec3 fast_ = Vec3::Zero(), slow_ = Vec3::Zero();
  double squares_ = 0, seconds_ = 0, rest_ = 0;
  bool started_ = false;
};

}  // namespace palpa::twin
