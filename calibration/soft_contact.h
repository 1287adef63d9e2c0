#pragma once

#include <Eigen/Core>
#include <cmath>
#include <string>
#include <vector>

#include "calibration/robust_fit.h"
#include "haptics/materials/hunt_crossley.h"

/// What a soft thing is made of, from presses and releases along its normal.
namespace palpa::calibration {

/// Depth, m, along the inward normal from where the surface is thought to be; its rate, m/s; force
/// on the thing, N.
struct PressSample {
  double x = 0, rate = 0, f = 0;
};

/// The law while the hand still presses: recursive least squares with forgetting (Haddadi &
/// Hashtrudi-Zaad 2008) on
///     ln f = ln k + m ln x + b/k x'                for small b x'/k, weighted by f^2
/// over samples above 5 % of the largest force so far. A start and a live picture: it is biased by
/// its linearisation and by where the surface is.
class PressEstimator {
 public:
  explicit PressEstimator(double forgetting = 0.999) : forgetting_(forgetting) {}
  void add(const PressSample& sample);
  haptics::HuntCrossley law() const;
  int samples() const { return samples_; }

 private:
  double forgetting_;
  double largest_ = 0;
  int samples_ = 0;
  Eigen::Vector3d theta_{std::log(300.0), 1.2, 0};
  Eigen::Matrix3d P_ = Eigen::Vector3d(1e4, 1e2, 1e2)
                           .asDiagonal();  ///< (ln k, m, b/k): how little is known at first
};

struct SoftContact {
  haptics::HuntCrossley law;
  double x0 = 0;  ///< m, where contact truly begins, in the samples' x
  Eigen::Matrix4d covariance = Eigen::Matrix4d::Zero();  ///< of (k, b, m, x0)
  double rms = 0;                                        ///< N, of what is left
  double relative_rms = 0;                               ///< of the rms force in contact
  double largest_f = 0;                                  ///< N
  std::string advice;  ///< what motion would tell more; empty: nothing needed
  Fit fit;
};

/// Robust least squares of f = (x - x0)^m (k + b x') on all samples in contact, from where
/// PressEstimator ends. Throws Error, in plain words, for too few samples, one speed only, one
/// depth only, a force that is cut off (saturated sensor) or of the wrong sign, figures that are
/// none, and a law outside 0.5 <= m <= 4, k > 0, b >= 0.
SoftContact identifySoftContact(const std::vector<PressSample>& samples);

}  // namespace palpa::calibration
