#pragma once

#include <cmath>
#include <numbers>

#include "anatomy/geometry/pose.h"
#include "apps/runtime/random.h"

namespace palpa::twin {

/// Physiological tremor: white noise through a resonator at 10 Hz (8-12 Hz band), scaled to a
/// stated rms. x'' + 2 z w x' + w^2 x = w^2 n; with z = 0.15 the half-power band is 8.5-11.5 Hz.
class Tremor {
 public:
  Tremor(double rms, runtime::RandomStream stream) : rms_(rms), stream_(stream) {}

  /// The next displacement, `dt` later.
  Vec3 next(double dt) {
    constexpr double kOmega = 2 * std::numbers::pi * 10, kDamping = 0.15;
    // Stationary variance of the resonator under white noise of intensity q: q / (4 z w^3).
    const double q = 4 * kDamping * kOmega * kOmega * kOmega;
    for (int i = 0; i < 3; ++i) {
      const double kick = std::sqrt(q / dt) * stream_.normal();
      v_[i] += (kick - 2 * kDamping * kOmega * v_[i] - kOmega * kOmega * x_[i]) * dt;
      x_[i] += v_[i] * dt;
    }
    return rms_ * x_;
  }

 private:
  double rms_;
  runtime::RandomStream stream_;
  Vec3 x_ = Vec3::Zero(), v_ = Vec3::Zero();
};

}  // namespace palpa::twin
