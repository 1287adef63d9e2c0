#include "apps/assess/assess_trial.h"
#include "apps/assess/contacts.h"
#include "apps/assess/passes.h"

namespace palpa::assess {

bool expertTrial(const std::vector<TrialSample>& samples, const anatomy::LandmarkFrame& frame,
                 const std::string& expert, calibration::ExpertTrial* trial) {
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
  trial->entry_L = frame.pointToLandmarks(pass.puncture.tip_A);
  trial->depth = pass.end_of_phase_1.depth;
  trial->direction_L = frame.vectorToLandmarks(pass.start_of_phase_2.axis_A).normalized();
  trial->tip_L = {frame.pointToLandmarks(samples[pass.phase_2].tip_A)};
  const Samples phase_2 = Samples(samples).subspan(pass.phase_2, end - pass.phase_2 + 1);
  for (const std::size_t i : scoringSamples(phase_2, 20))
    if (i > 0) trial->tip_L.push_back(frame.pointToLandmarks(phase_2[i].tip_A));
  trial->tip_L.push_back(frame.pointToLandmarks(samples[end].tip_A));
  return true;
}

}  // namespace palpa::assess
