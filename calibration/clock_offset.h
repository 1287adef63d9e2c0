#pragma once

#include <vector>

#include "anatomy/geometry/pose.h"
#include "calibration/robust_fit.h"

namespace palpa::calibration {

/// A point's place at a time, in the clock (s) and frame of the one who saw it.
struct TimedPoint {
  double t = 0;
  Vec3 p = Vec3::Zero();
};

/// One motion, seen by camera and device, tells how far their clocks are apart; nothing but a hand
/// that moves is needed. At the camera's time t the device's clock showed
///   t + offset + drift * (t - t_middle)
/// when both saw the same instant. Start: the lag at which the ranks of the speeds correlate best,
/// and others that are nearly as good; then a robust fit of
///   R p_device(t + offset + ...) + c = p_camera(t)
/// over offset, drift, R and c, the device's path as cubics through its samples (Catmull & Rom
/// 1974, over the times as they are); of several starts the best fit, if it is the best by far.
struct ClockOffset {
  double offset = 0, drift = 0;  ///< s at t_middle; s per s
  double offset_sd = 0, drift_sd = 0;
  double offset_half95 = 0;  ///< s
  double t_middle = 0;       ///< of the camera's recording, its clock
  double rms = 0;            ///< m, of the good samples
  double correlation = 0;    ///< of the speeds' ranks at the best lag
  /// a by-product: the device's base in the camera, of the moving point
  Pose X_CD = Pose::Identity();
  Fit fit;
};

/// `most`: the largest offset looked for, s. Throws Error for too few samples (60 of the camera),
/// times that run backwards, a hand that hardly moved, recordings that share too little time,
/// speeds that do not look alike, paths that fit alike at several lags (a steady to and fro), and
/// invalid figures.
ClockOffset estimateClockOffset(const std::vector<TimedPoint>& camera,
                                const std::vector<TimedPoint>& device, double most = 2.0);

}  // namespace palpa::calibration
