#pragma once

#include <string>
#include <vector>

#include "calibration/robust_fit.h"
#include "haptics/materials/dahl.h"

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
/// words, for too few strokes, no sliding, one speed only, no beginning of a stroke, and figures
/// that are none.
SurfaceFriction identifySurfaceFriction(const std::vector<SlideSample>& samples, double dt);

}  // namespace palpa::calibration
