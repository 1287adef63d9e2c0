#include "apps/assess/trial_review.h"

#include <algorithm>
#include <cmath>

#include "anatomy/geometry/error.h"

namespace palpa::assess {
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

void checkScale(const calibration::ExpertPath& path, const ScoringRules& rules) {
  if (!(path.direction_acceptable > 0) || !((path.line_to_L - path.line_from_L).norm() > 1e-6) ||
      !(std::abs(path.direction_L.norm() - 1) < 1e-3))
    throw Error("the path has no direction, line or acceptable deviation", "expert path",
                "Calibrate it with experts' trials");
  if (!(rules.sample_rate_Hz > 0))
    throw UsageError("sample_rate_Hz must be positive", "scoring rules", "The paper's rate is 20");
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
  v.time_ms = 1000 * r.end_s;
  v.success = r.success;
  return v;
}

}  // namespace

TrialReview review(const TrialFacts& facts, Samples all, const anatomy::LandmarkFrame& frame,
                   const OrganDistance& distance, const calibration::ExpertPath& path,
                   const ScoringRules& rules) {
  checkSamples(facts, all);
  checkScale(path, rules);
  TrialReview r;
  r.success = facts.outcome == "success" && !all.empty();
  r.samples = r.success ? all.first(successSample(all, rules) + 1) : all;
  r.end_s = r.samples.empty() ? 0 : r.samples.back().t_s;
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
