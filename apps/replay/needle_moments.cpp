#include "apps/replay/needle_moments.h"

#include <algorithm>

#include "apps/replay/trial_replay.h"

namespace palpa::replay {
namespace {

constexpr double kDrawn = 0.25, kFill = 0.25;  // of the syringe: drawn enough to aspirate; a second

}  // namespace

MomentReader::MomentReader(const Pose& X_AD, const PackedPose& X_ET, int trial)
    : X_ET_(unpack(X_ET)), sampler_(X_AD, X_ET) {
  sampler_.begin(static_cast<std::uint32_t>(trial));
}

void MomentReader::add(const haptics::FlightRecord& record) {
  assess::TrialSample sample;
  if (!sampler_.add(record, &sample)) return;
  phases_.add(sample);
  const bool flows = sample.tissue == Tissue::vein_lumen && sample.plunger >= kDrawn;
  if (flows) blood_ = std::min(sample.plunger, blood_ + kFill * (sample.t_s - last_s_));
  last_s_ = sample.t_s;
  if (!moments_.empty() && sample.t_s - moments_.back().t_s < kMomentStep - 1e-9) return;
  moments_.push_back({sample.t_s, toolIn(record, X_ET_), phases_.phase(), blood_, flows});
}

task_needle::TaskStatus statusAt(const Moment& moment, int trial, bool force_feedback) {
  task_needle::TaskStatus status;
  status.state = trial::TrialState::running;
  status.trial = trial;
  status.trials = 1;
  status.force_feedback = force_feedback;
  status.elapsed_s = moment.t_s;
  status.phase = moment.phase;
  status.step = assess::clinicalName(moment.phase);
  status.plunger = moment.tool.plunger;
  status.blood = moment.blood;
  status.blood_flows = moment.blood_flows;
  return status;
}

}  // namespace palpa::replay
