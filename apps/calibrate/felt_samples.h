#pragma once

#include <optional>
#include <vector>

#include "anatomy/geometry/pose.h"
#include "calibration/lump_contact.h"
#include "calibration/soft_contact.h"
#include "calibration/surface_friction.h"

namespace palpa::calibrate {

/// A round tip on a soft sample: where its lowest point was in P, what the sample did to it, how
/// far a lump had moved (where something tells that). At even times, `dt` apart.
struct FeltSample {
  Vec3 p_P = Vec3::Zero(), f_P = Vec3::Zero();  ///< m, N
  std::optional<Vec3> lump_P;                   ///< m
};
struct FeltSamples {
  double dt = 1e-3;  ///< s
  std::vector<FeltSample> samples;
};

/// The same as the estimators want them: depth along -z, its rate over the last step.
std::vector<calibration::PressSample> pressesOf(const FeltSamples& felt);
std::vector<calibration::SlideSample> slidesOf(const FeltSamples& felt);
std::vector<calibration::LumpSample> lumpTouchesOf(const FeltSamples& felt);

/// The first three quarters, to fit; the last, to judge.
FeltSamples toFit(const FeltSamples& felt);
FeltSamples toJudge(const FeltSamples& felt);

}  // namespace palpa::calibrate
