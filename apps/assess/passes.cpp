#include "apps/assess/passes.h"

#include <algorithm>

namespace palpa::assess {
namespace {

void takeFrom(const PhaseDetector& detector, std::size_t sample, Pass* pass) {
  if (detector.advancing() && !pass->advanced) pass->phase_2 = sample;
  pass->advanced = detector.advancing();
  pass->reoriented = detector.reoriented();
  pass->puncture = detector.puncture();
  pass->end_of_phase_1 = detector.endOfPhase1();
  pass->start_of_phase_2 = detector.startOfPhase2();
}

}  // namespace

PhaseHistory detectPhases(Samples samples) {
  PhaseHistory history;
  history.phases.reserve(samples.size());
  PhaseDetector detector;
  ProcedurePhase before = ProcedurePhase::approach;
  for (std::size_t i = 0; i < samples.size(); ++i) {
    detector.add(samples[i]);
    const ProcedurePhase now = detector.phase();
    history.phases.push_back(now);
    if (now != ProcedurePhase::approach) {
      if (before == ProcedurePhase::approach) {
        history.passes.emplace_back();
        history.passes.back().first = i;
      }
      Pass& pass = history.passes.back();
      takeFrom(detector, i, &pass);
      pass.last = i;
      if (!pass.advanced) pass.deepest = std::max(pass.deepest, samples[i].depth);
    }
    before = now;
  }
  return history;
}

const Pass* scoredPass(const std::vector<Pass>& passes, bool success) {
  if (passes.empty()) return nullptr;
  if (!success)
    for (auto pass = passes.rbegin(); pass != passes.rend(); ++pass)
      if (pass->advanced) return &*pass;
  return &passes.back();
}

namespace {

constexpr double kLeast = 0.003, kLeastTurn = 0.05236;  // m; 3 degrees

}  // namespace

void RedirectionCounter::add(double reach, const Vec3& axis) {
  if (!retreating_) {
    if (reach > peak_) peak_ = reach, axis_at_peak_ = axis;
    if (reach < peak_ - kLeast) retreating_ = true, low_ = reach;
    return;
  }
  low_ = std::min(low_, reach);
  if (reach <= low_ + kLeast) return;
  if (angleBetween(axis, axis_at_peak_) > kLeastTurn) ++count_;
  retreating_ = false, peak_ = reach, axis_at_peak_ = axis;
}

void PassCounter::add(const TrialSample& sample) {
  const bool was_advancing = detector_.advancing();
  detector_.add(sample);
  punctures_ += (sample.events & haptics::kSkinPunctured) != 0;
  const bool inserted = detector_.phase() != ProcedurePhase::approach,
             was_inserted = before_ != ProcedurePhase::approach;
  insertions_ += inserted && !was_inserted;
  before_ = detector_.phase();
  if (!inserted && was_inserted) {
    redirections_ += current_.count();
    current_ = {};
  }
  if (inserted && !detector_.advancing()) current_ = {};  // phase 2 was taken back: it begins anew
  if (detector_.advancing()) {
    if (!was_advancing) current_ = {};
    current_.add((sample.tip_A - detector_.puncture().tip_A).norm(), sample.axis_A);
  }
}

int countRedirections(Samples samples, const std::vector<Pass>& passes) {
  int count = 0;
  for (const Pass& pass : passes) {
    if (!pass.advanced) continue;
    RedirectionCounter counter;
    for (std::size_t i = pass.phase_2; i <= pass.last; ++i)
      counter.add((samples[i].tip_A - pass.puncture.tip_A).norm(), samples[i].axis_A);
    count += counter.count();
  }
  return count;
}

}  // namespace palpa::assess
