#include "apps/assess/path_errors.h"

#include <algorithm>
#include <cmath>

namespace palpa::assess {
namespace {

constexpr double kFarthestEntry = 0.050;  // m: further off says nothing more
constexpr double kWorstDirection = 5000;  // PHASE_2 of a trial without phase 2

double elevation(const Vec3& d_L) { return std::asin(std::clamp(d_L.y(), -1.0, 1.0)); }
double azimuth(const Vec3& d_L) { return std::atan2(d_L.z(), d_L.x()); }

double distanceFromLine(const Vec3& p_L, const Vec3& from_L, const Vec3& along_L) {
  return (p_L - from_L).cross(along_L).norm();
}

}  // namespace

DirectionError comparedWith(const Vec3& axis_L, const calibration::ExpertPath& path) {
  const Vec3& taught = path.direction_L;
  DirectionError error;
  error.angle = angleBetween(axis_L, taught);
  error.steeper = elevation(axis_L) - elevation(taught);
  const double turn = std::remainder(azimuth(axis_L) - azimuth(taught), 2 * M_PI);
  error.more_cephalad = turn * std::cos(elevation(axis_L));
  error.value = 1000 * error.angle / path.direction_acceptable;
  return error;
}

EntryError entryError(const Pass* pass, Samples samples, const anatomy::LandmarkFrame& frame,
                      const calibration::ExpertPath& path) {
  EntryError error;
  if (pass) {
    error.punctured = true;
    error.offset_L = frame.pointToLandmarks(pass->puncture.tip_A) - path.entry_L;
    error.depth_error =
        (pass->reoriented ? pass->end_of_phase_1.depth : pass->deepest) - path.depth;
    error.value_mm = 1000 * (error.offset_L.norm() + std::abs(error.depth_error));
    return error;
  }
  double away = kFarthestEntry;
  if (!samples.empty()) {
    error.offset_L = frame.pointToLandmarks(samples.back().tip_A) - path.entry_L;
    away = std::min(away, error.offset_L.norm());
  }
  error.depth_error = -path.depth;
  error.value_mm = 1000 * (away + path.depth);
  return error;
}

DirectionError directionError(const Pass* pass, Samples samples,
                              const anatomy::LandmarkFrame& frame,
                              const calibration::ExpertPath& path) {
  DirectionError error;
  error.value = kWorstDirection;
  if (!pass) return error;
  const TrialSample& judged = pass->advanced ? pass->start_of_phase_2 : samples[pass->last];
  error = comparedWith(frame.vectorToLandmarks(judged.axis_A), path);
  error.judged = pass->advanced ? DirectionError::Judged::at_phase_2
                                : DirectionError::Judged::at_last_insertion;
  if (!pass->advanced) error.value = std::min(error.value, kWorstDirection);
  return error;
}

Economy economy(const Pass* pass, Samples samples, const anatomy::LandmarkFrame& frame,
                const calibration::ExpertPath& path, double shaft_point) {
  Economy result;
  if (!pass || !pass->advanced) return result;
  const Vec3 along_L = (path.line_to_L - path.line_from_L).normalized();
  double mean = 0, squares = 0;  // Welford: stable for long phases with small spread
  long n = 0;
  for (std::size_t i = pass->phase_2; i <= pass->last; ++i) {
    const Vec3 shaft_A = samples[i].tip_A - shaft_point * samples[i].axis_A;
    const double e_mm =
        500 *
        (distanceFromLine(frame.pointToLandmarks(samples[i].tip_A), path.line_from_L, along_L) +
         distanceFromLine(frame.pointToLandmarks(shaft_A), path.line_from_L, along_L));
    const double step = e_mm - mean;
    mean += step / static_cast<double>(++n);
    squares += step * (e_mm - mean);
    if (e_mm > result.largest_mm) result.largest_mm = e_mm, result.largest_s = samples[i].t_s;
  }
  result.mean_mm = mean;
  result.variance_mm2 = squares / static_cast<double>(n);
  return result;
}

}  // namespace palpa::assess
