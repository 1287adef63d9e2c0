#pragma once

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "anatomy/base/random.h"
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

/// Physiological tremor: white noise through a resonator at 10 Hz (8-12 Hz band), scaled to a
/// stated rms. x'' + 2 z w x' + w^2 x = w^2 n; with z = 0.15 the half-power band is 8.5-11.5 Hz.
class Tremor {
 public:
  Tremor(double rms, RandomStream stream) : rms_(rms), stream_(stream) {}

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
  RandomStream stream_;
  Vec3 x_ = Vec3::Zero(), v_ = Vec3::Zero();
};

/// A tool's tip that is led from place to place, each time with minimum jerk, and held there. Frame
/// P of twin::SoftBlock.
class LedTip {
 public:
  explicit LedTip(const Vec3& start) : at_(start) { stops_.push_back({start, 0, 0}); }
  LedTip& go(const Vec3& to, double seconds, double hold = 0);
  /// Down to `depth` below `place` and up to 2 mm above it.
  LedTip& press(const Vec3& place, double depth, double seconds_down, double hold = 0);
  double duration() const { return stops_.back().until; }
  Vec3 at(double t) const;

 private:
  struct Stop {
    Vec3 p;
    double arrival, until;  // s
  };
  std::vector<Stop> stops_;
  Vec3 at_;
};

/// Motions of a hand over soft things; `deep` is the deepest, m. Seeded: none is like another.
LedTip pressing(const Vec3& place, double deep, std::uint64_t seed);
LedTip tapping(const Vec3& place, double deep, std::uint64_t seed);
/// Down beside `place`, over it back and forth as far as `reach`, along the direction `way`.
LedTip stroking(const Vec3& place, double deep, double reach, const Vec3& way, std::uint64_t seed);

}  // namespace palpa::twin
