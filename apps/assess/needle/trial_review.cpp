#include "apps/assess/needle/trial_review.h"

#include <algorithm>
#include <cmath>

#include "anatomy/base/error.h"
#include "anatomy/base/pinned_math.h"
#include "apps/training/trial_words.h"

namespace palpa::assess {
namespace {

constexpr double kFarthestEntry = 0.050;  // m: further off says nothing more
constexpr double kWorstDirection = 5000;  // PHASE_2 of a trial without phase 2

double elevation(const Vec3& d_L) { return pinned::asin(std::clamp(d_L.y(), -1.0, 1.0)); }
double azimuth(const Vec3& d_L) { return pinned::atan2(d_L.z(), d_L.x()); }

double distanceFromLine(const Vec3& p_L, const Vec3& from_L, const Vec3& along_L) {
  return (p_L - from_L).cross(along_L).norm();
}

}  // namespace

DirectionError comparedWith(const Vec3& axis_L, const calibration::TaughtPath& path) {
  const Vec3& taught = path.direction_L;
  DirectionError error;
  error.angle = angleBetween(axis_L, taught);
  error.steeper = elevation(axis_L) - elevation(taught);
  const double turn = std::remainder(azimuth(axis_L) - azimuth(taught), 2 * M_PI);
  error.more_cephalad = turn * pinned::cos(elevation(axis_L));
  error.value = 1000 * error.angle / path.direction_acceptable;
  return error;
}

EntryError entryError(const Pass* pass, Samples samples, const anatomy::LandmarkFrame& frame,
                      const calibration::TaughtPath& path) {
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
                              const calibration::TaughtPath& path) {
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
                const calibration::TaughtPath& path, double shaft_point) {
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

namespace {

void checkSamples(const TrialFacts& facts, Samples samples) {
  const std::string where = "record of trial " + std::to_string(facts.trial);
  double before = -1e9;
  for (const TrialSample& s : samples) {
    const bool finite = std::isfinite(s.t_s) && s.tip_A.allFinite() && s.axis_A.allFinite() &&
                        std::isfinite(s.depth) && std::isfinite(s.bone_force);
    if (!finite || std::abs(s.axis_A.norm() - 1) > 1e-3)
      throw Error("a sample near " + std::to_string(before) + " s has no valid needle pose", where,
                  "The record is damaged; replay the session or void the trial");
    if (s.t_s < before)
      throw Error("time runs backward after " + std::to_string(before) + " s", where,
                  "Give the samples of one trial in order");
    before = s.t_s;
  }
}

void checkScale(const calibration::TaughtPath& path, const ScoringRules& rules) {
  if (!(path.direction_acceptable > 0) || !((path.line_to_L - path.line_from_L).norm() > 1e-6) ||
      !(std::abs(path.direction_L.norm() - 1) < 1e-3))
    throw Error("the path has no direction, line or acceptable deviation", "expert path",
                "Calibrate it with experts' trials");
  if (!(rules.sample_rate_Hz > 0))
    throw UsageError("sample_rate_Hz must be positive", "scoring rules",
                     "Tzafestas et al. 2008 used 20");
}

void findContacts(const ScoringRules& rules, TrialReview* r) {
  r->lung_touched = intervals(r->samples, touchesLung);
  r->lung = intervals(r->samples, inLung);
  r->artery = intervals(r->samples, touchesArtery);
  r->ribcage = intervals(r->samples, touchesRibcage);
  r->clavicle = intervals(r->samples, touchesClavicle);
  r->clavicle_struck =
      intervals(r->samples, [&](const TrialSample& s) { return strikesClavicle(s, rules); });
  r->vein_lumen = intervals(r->samples, inVein);
  r->back_wall = intervals(r->samples, touchesBackWall);
  const TrialSample* const begin = r->samples.data();
  r->vein_unneeded = intervals(r->samples, [&](const TrialSample& s) {
    return touchesVein(s) && !r->stay.covers(static_cast<std::size_t>(&s - begin));
  });
}

ParacentesisValues valuesOf(const TrialReview& r, const ScoringRules& rules) {
  const CollisionCounts counts = countCollisions(r.samples, r.stay, rules);
  ParacentesisValues v;
  v.col_lung = counts.lung;
  v.col_rib = counts.rib;
  v.col_art = counts.artery;
  v.col_vein = counts.vein;
  v.phase_1 = r.entry.value_mm;
  v.phase_2 = r.direction.value;
  v.econ_mean = r.economy.mean_mm;
  v.econ_var = r.economy.variance_mm2;
  v.time_ms = 1000 * r.time_s();
  v.success = r.success;
  return v;
}

}  // namespace

TrialReview review(const TrialFacts& facts, Samples all, const anatomy::LandmarkFrame& frame,
                   const OrganDistance& distance, const calibration::TaughtPath& path,
                   const ScoringRules& rules) {
  checkSamples(facts, all);
  checkScale(path, rules);
  TrialReview r;
  r.success = facts.outcome == training::Outcome::success && !all.empty();
  r.has_lung = std::isfinite(distance(Organ::lung, Vec3::Zero()));
  r.has_artery = std::isfinite(distance(Organ::artery, Vec3::Zero()));
  r.samples = r.success ? all.first(successSample(all, rules) + 1) : all;
  r.end_s = r.samples.empty() ? 0 : r.samples.back().t_s;
  r.asked = std::any_of(all.begin(), all.end(), [](const TrialSample& s) { return s.waiting; });
  r.waited_s = heldTime(intervals(
      r.samples, [](const TrialSample& s) { return s.waiting; }, 0));
  r.history = detectPhases(r.samples);
  r.pass = scoredPass(r.history.passes, r.success);
  if (r.success) r.stay = finalStay(r.samples);
  r.entry = entryError(r.pass, r.samples, frame, path);
  for (const Pass& pass : r.history.passes)
    r.entry_distances.push_back(entryError(&pass, r.samples, frame, path).offset_L.norm());
  r.direction = directionError(r.pass, r.samples, frame, path);
  r.economy = economy(r.pass, r.samples, frame, path, rules.shaft_point);
  findContacts(rules, &r);
  r.pleura_miss = nearMiss(r.samples, Organ::lung, distance, rules.sample_rate_Hz);
  r.artery_miss = nearMiss(r.samples, Organ::artery, distance, rules.sample_rate_Hz);
  r.values = valuesOf(r, rules);
  return r;
}

double peakBoneForce(Samples samples, const std::vector<Interval>& stretches) {
  double peak = 0;
  for (const Interval& stretch : stretches)
    for (std::size_t i = stretch.first; i <= stretch.last; ++i)
      peak = std::max(peak, samples[i].bone_force);
  return peak;
}

}  // namespace palpa::assess
