#include "apps/assess/assess_trial.h"

#include "apps/assess/explanations.h"
#include "apps/assess/needle_metrics.h"
#include "apps/assess/technical_errors.h"
#include "apps/assess/timeline.h"

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
                            const calibration::ExpertPath& path, const ScoringRules& rules) {
  const anatomy::LandmarkFrame frame(patient);
  const TrialReview r = review(facts, samples, frame, distance, path, rules);
  TrialAssessment a = headed(facts);
  a.values = r.values;
  a.total = total(r.values, rules.weights);
  a.penalties = explain(r, path, rules);
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

}  // namespace palpa::assess
