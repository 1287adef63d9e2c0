#pragma once

#include <algorithm>
#include <cmath>

#include "anatomy/geometry/pose.h"
#include "apps/runtime/random.h"

namespace palpa::twin {

/// What fingers notice of a handle that shakes in them. Of its velocity against what the hand
/// itself does, v,
///   shake = |v_fast - v_slow|,   v_fast, v_slow: low-passed with 1 ms and 3 ms: about 50 to 160 Hz
/// A jolt is noticed where shake > (v_0 + c b) (1 + s n), b the root mean square of the shaking of
/// the last second, n standard normal; at most once in 25 ms. Roughness is the root mean square of
/// the shaking over a stroke, with a floor: r = sqrt(mean shake^2 + r_0^2). Velocity, because what
/// is just felt through a held stylus is, above 20 Hz, about the same velocity at every frequency.
class JoltSense {
 public:
  struct Limits {
    double least = 0.002;         ///< v_0, m/s
    double contrast = 2;          ///< c
    double spread = 0.15;         ///< s
    double rough_floor = 0.0005;  ///< r_0, m/s
  };
  JoltSense(const Limits& limits, runtime::RandomStream noise) : limits_(limits), noise_(noise) {}

  /// The next `dt` seconds; true: a jolt is noticed now.
  bool feel(const Vec3& v, double dt) {
    constexpr double kFast = 0.001, kSlow = 0.003, kBackground = 1.0, kRest = 0.025;  // s
    fast_ += (v - fast_) * (dt / (kFast + dt));
    slow_ += (v - slow_) * (dt / (kSlow + dt));
    const double shake = (fast_ - slow_).norm(), square = shake * shake;
    const double least = (limits_.least + limits_.contrast * std::sqrt(background_)) *
                         (1 + limits_.spread * noise_.normal());
    background_ += (square - background_) * (dt / (kBackground + dt));
    squares_ += square * dt;
    seconds_ += dt;
    rest_ -= dt;
    if (rest_ > 0 || shake <= std::max(least, 0.0)) return false;
    rest_ = kRest;
    return true;
  }
  void beginStroke() { squares_ = seconds_ = 0; }
  double roughness() const {
    return std::sqrt((seconds_ > 0 ? squares_ / seconds_ : 0) +
                     limits_.rough_floor * limits_.rough_floor);
  }

 private:
  Limits limits_;
  runtime::RandomStream noise_;
  Vec3 fast_ = Vec3::Zero(), slow_ = Vec3::Zero();
  double background_ = 0, squares_ = 0, seconds_ = 0, rest_ = 0;
};

}  // namespace palpa::twin
