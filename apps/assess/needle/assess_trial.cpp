#include "apps/assess/needle/assess_trial.h"

#include <algorithm>
#include <limits>

#include "apps/assess/needle/contacts.h"
#include "apps/assess/needle/needle_metrics.h"
#include "apps/assess/needle/paracentesis_score.h"
#include "apps/assess/needle/phases.h"
#include "apps/assess/needle/technical_errors.h"
#include "apps/assess/needle/wording.h"

namespace palpa::assess {
namespace {

TrialAssessment headed(const TrialFacts& facts) {
  TrialAssessment a;
  a.trial = facts.trial;
  a.role = facts.role;
  a.simulated = facts.simulated;
  a.force_feedback = facts.force_feedback;
  a.seed = facts.seed;
  a.outcome = facts.outcome;
  return a;
}

int countPunctures(const TrialReview& r) {
  int events = 0;
  for (const TrialSample& s : r.samples) events += (s.events & haptics::kSkinPunctured) != 0;
  // A record whose events were left out still shows every pass.
  return std::max(events, static_cast<int>(r.history.passes.size()));
}

}  // namespace

TrialAssessment assessTrial(const TrialFacts& facts, const std::vector<TrialSample>& samples,
                            const anatomy::Patient& patient, const OrganDistance& distance,
                            const calibration::TaughtPath& path, const ScoringRules& rules) {
  const anatomy::LandmarkFrame frame(patient);
  const TrialReview r = review(facts, samples, frame, distance, path, rules);
  TrialAssessment a = headed(facts);
  a.rules = rules.version;
  a.values = r.values;
  a.total = total(r.values, rules.weights);
  a.penalties = explain(r, path, rules);
  if (!r.has_lung) a.not_judged.push_back(name(Organ::lung));
  if (!r.has_artery) a.not_judged.push_back(name(Organ::artery));
  a.summary = summarise(facts, r, a.penalties);
  a.spans = timelineSpans(r, rules);
  a.moments = timelineMoments(facts, r, rules);
  a.closest_pleura_mm = 1000 * r.pleura_miss.distance;
  a.closest_pleura_s = r.pleura_miss.t_s;
  a.closest_artery_mm = 1000 * r.artery_miss.distance;
  a.closest_artery_s = r.artery_miss.t_s;
  a.skin_punctures = countPunctures(r);
  a.redirections = countRedirections(r.samples, r.history.passes);
  a.errors = technicalErrors(r, frame, path, rules);
  a.metrics = needleMetrics(r, a, frame, path, rules);
  return a;
}

double total(const ParacentesisValues& v, const ScoreWeights& w) {
  return w.lung * v.col_lung + w.rib * v.col_rib + w.artery * v.col_art + w.vein * v.col_vein +
         w.phase_1 * v.phase_1 + w.phase2Weight(v.phase_2) * v.phase_2 + w.econ_mean * v.econ_mean +
         w.econ_var * v.econ_var + w.time * v.time_ms;
}

TrialAssessment assessTrial(const TrialFacts& facts, const std::vector<TrialSample>& samples,
                            const anatomy::Patient& patient, const anatomy::SurfaceQuery& query,
                            const calibration::TaughtPath& path, const ScoringRules& rules) {
  const OrganDistance distance = [&](Organ organ, const Vec3& p_A) {
    double closest = std::numeric_limits<double>::infinity();
    for (std::size_t i = 0; i < patient.organs.size(); ++i)
      if (patient.organs[i].organ == organ)
        closest = std::min(closest, query.closest(static_cast<int>(i), p_A).distance);
    return closest;
  };
  return assessTrial(facts, samples, patient, distance, path, rules);
}

bool expertTrial(const std::vector<TrialSample>& samples, const anatomy::LandmarkFrame& frame,
                 const calibration::TeachingLine& line, const std::string& expert,
                 calibration::ExpertTrial* trial) {
  const PhaseHistory history = detectPhases(samples);
  if (history.passes.empty()) return false;
  const Pass& pass = history.passes.back();
  // The tip may have been drawn out after the blood came: the path ends where it was in the vein
  // last.
  std::size_t end = pass.last;
  while (end > pass.phase_2 && !inVein(samples[end])) --end;
  if (!pass.reoriented || !pass.advanced || !inVein(samples[end]) || end == pass.phase_2)
    return false;
  trial->expert = expert;
  trial->line = line;
  trial->entry_L = frame.pointToLandmarks(pass.puncture.tip_A);
  trial->depth = pass.end_of_phase_1.depth;
  trial->direction_L = frame.vectorToLandmarks(pass.start_of_phase_2.axis_A).normalized();
  trial->start_L = frame.pointToLandmarks(samples[pass.phase_2].tip_A);
  trial->end_L = frame.pointToLandmarks(samples[end].tip_A);
  return true;
}

calibration::TeachingLine teachingLineOf(const anatomy::Patient& patient,
                                         const anatomy::SurfaceQuery& query) {
  const anatomy::LandmarkFrame frame(patient);
  const Vec3& entry_A = patient.landmark(anatomy::landmark::kEntry);
  const auto skin = static_cast<int>(&patient.organ(Organ::skin) - patient.organs.data());
  return {frame.pointToLandmarks(entry_A),
          frame.vectorToLandmarks(-query.closest(skin, entry_A).n_A),
          frame.pointToLandmarks(patient.landmark(anatomy::landmark::kVeinTarget))};
}

}  // namespace palpa::assess
