#pragma once

#include <cstdint>

#include "anatomy/geometry/pose.h"

namespace palpa::ar {

/// Adaptive low-pass for the pose of a camera that stands or moves slowly: averages while still,
/// follows while moving. The 1 euro filter (Casiez, Roussel, Vogel 2012, CHI, eq. 1-6), on the
/// translation as a vector and on the rotation along the shortest arc:
///
///   alpha(fc) = 1 / (1 + 1 / (2 pi fc T))            T: time since the last pose, s
///   speed     = low-pass of (raw - last raw) / T with alpha(speed_cutoff), a vector
///   fc        = min_cutoff + beta |speed|
///   smooth   += alpha(fc) (raw - smooth)             rotation: R <- R exp(alpha log(R^T R_raw))
///
/// Lag at a constant speed s is s / (2 pi (min_cutoff + beta s)) once `speed` has settled: never
/// more than 1 / (2 pi beta). White jitter of a still camera is reduced by sqrt(alpha / (2 -
/// alpha)), 0.31 at 15 pictures a second, as long as it is small. Jitter opens the filter a little
/// itself: to 0.37 at 0.05 mm and 0.02 degrees, to 0.45 at 0.15 mm and 0.05 degrees.
class PoseSmoother {
 public:
  struct Settings {
    double min_cutoff_hz = 0.5;
    double beta_translation = 320;  ///< Hz per m/s: lag below 0.5 mm
    double beta_rotation = 45;      ///< Hz per rad/s: lag below 3.6 mrad (0.21 degrees)
    double speed_cutoff_hz = 1.0;
    double longest_gap = 0.5;  ///< s; after a longer one the filter starts anew
  };

  PoseSmoother() : PoseSmoother(Settings{}) {}
  explicit PoseSmoother(const Settings& settings) : settings_(settings) {}

  /// The smoothed pose at the time of this one. The first pose, and one after a gap, passes
  /// through; a time that does not advance changes nothing and returns the last result.
  Pose update(const Pose& X_raw, std::int64_t t_ns);

  void reset() { started_ = false; }

 private:
  void start(const Pose& X_raw, std::int64_t t_ns);

  Settings settings_;
  bool started_ = false;
  std::int64_t t_ns_ = 0;
  Pose raw_ = Pose::Identity();  ///< the last one given
  Pose smooth_ = Pose::Identity();
  Vec3 v_ = Vec3::Zero();  ///< smoothed speed of the raw pose, m/s
  Vec3 w_ = Vec3::Zero();  ///< and turning rate, rad/s
};

}  // namespace palpa::ar
