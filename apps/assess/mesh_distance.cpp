#include <algorithm>
#include <limits>

#include "apps/assess/assess_trial.h"

namespace palpa::assess {

TrialAssessment assessTrial(const TrialFacts& facts, const std::vector<TrialSample>& samples,
                            const anatomy::Patient& patient, const anatomy::SurfaceQuery& query,
                            const calibration::ExpertPath& path, const ScoringRules& rules) {
  const OrganDistance distance = [&](Organ organ, const Vec3& p_A) {
    double closest = std::numeric_limits<double>::infinity();
    for (std::size_t i = 0; i < patient.organs.size(); ++i)
      if (patient.organs[i].organ == organ)
        closest = std::min(closest, query.closest(static_cast<int>(i), p_A).distance);
    return closest;
  };
  return assessTrial(facts, samples, patient, distance, path, rules);
}

}  // namespace palpa::assess
