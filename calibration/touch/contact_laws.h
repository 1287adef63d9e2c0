#pragma once

#include <array>
#include <cmath>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "anatomy/geometry/pose.h"
#include "calibration/robust_fit.h"
#include "haptics/materials/force_laws.h"

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

/// What a surface's friction is, from strokes over it, back and forth.
namespace palpa::calibration {

/// At even times, `dt` apart, in one frame: contact point, m; unit normal; normal force, N; force
/// with which the tool drags the surface, N.
struct SlideSample {
  Vec3 p = Vec3::Zero(), n = Vec3::UnitZ();
  double f_n = 0;
  Vec3 drag = Vec3::Zero();
};

struct SurfaceFriction {
  haptics::Dahl law;
  Mat3 covariance = Mat3::Zero();  ///< of (mu, sigma, B)
  double rms = 0;                  ///< N, of what is left, per axis
  double relative_rms = 0;         ///< of the rms drag
  double slid = 0;     ///< longest stroke in units of F_c / sigma: beyond 3 it truly slid
  std::string advice;  ///< what motion would tell more; empty: nothing needed
  Fit fit;
};

/// Divide and conquer (after Mahvash & Okamura 2006): mu and B from the second halves of the
/// strokes, where it slides, sigma from their beginnings, each a linear problem; then robust least
/// squares of all three on the law itself, run over the whole recording. Throws Error, in plain
/// words, for too few strokes, no sliding, one speed only, no beginning of a stroke, and
/// invalid figures.
SurfaceFriction identifySurfaceFriction(const std::vector<SlideSample>& samples, double dt);

}  // namespace palpa::calibration

/// What a lump adds to the soft thing it lies in, from touches of a sample that has one (Jeon, Choi
/// & Harders 2015, their 5.2).
namespace palpa::calibration {

/// At even times: tip and reaction on it in one frame, as sensed; the outward normal of the
/// surface; how far the lump has moved (seen by a camera through a clear sample, or by ultrasound).
struct LumpSample {
  Vec3 p = Vec3::Zero(), n = Vec3::UnitZ(), f_r = Vec3::Zero();
  double x = 0, rate = 0;  ///< m, m/s: depth along -n, and its rate
  Vec3 d = Vec3::Zero();   ///< m
};

struct LumpContact {
  haptics::HuntCrossley H_T;  ///< against how much the way between tool and lump is shortened
  std::array<haptics::HuntCrossley, 3> G;  ///< the lump's bed along x, y, z
  double l0 = 0;                           ///< m, from the lump to the surface above it
  double relative_rms = 0;                 ///< of what the lump adds
  std::string advice;
};

/// f_T = f_r + drag - H_NT(x, x') n (10.17, and what a hand rubs that is not quite still); H_T by
/// |f_T| against l = l0 - |p - p_T0 - d| where the tool is above the lump; G_i by f_T,i against
/// |d_i|, i = z above the lump, x and y beside it; where what lies across n tells no law, it is
/// taken from the line between lump and the middle of the tip. `H_NT`, `x0`: the same thing without
/// a lump, and where its contact begins; `friction`: of its surface; none: nothing rubs; `p_T0`:
/// where the lump rests; `tip_radius`: of a round tip, m; `dt` between samples. Throws Error, in
/// plain words.
LumpContact identifyLump(const std::vector<LumpSample>& samples, const SoftContact& without,
                         const haptics::Dahl& friction, const Vec3& p_T0, double tip_radius,
                         double dt);

}  // namespace palpa::calibration
