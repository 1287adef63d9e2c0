#include "apps/assess/needle/phases.h"

#include <algorithm>

#include "anatomy/base/pinned_math.h"

namespace palpa::assess {

using haptics::NeedlePhase;

const char* clinicalName(ProcedurePhase phase) {
  switch (phase) {
    case ProcedurePhase::approach:
      return "approach to the skin";
    case ProcedurePhase::puncture:
      return "phase 1: puncture";
    case ProcedurePhase::reorient:
      return "reorientation";
    case ProcedurePhase::advance:
      return "phase 2: advance to the vein";
  }
  return "";
}

void PhaseDetector::add(const TrialSample& sample) {
  smooth(sample);
  if (sample.phase != NeedlePhase::inserted) {
    phase_ = ProcedurePhase::approach;
    return;
  }
  if (phase_ == ProcedurePhase::approach) beginPass(sample);
  if (turn() < rules_.turned && steady()) before_turn_ = sample;
  if (phase_ == ProcedurePhase::advance) {
    maybeTakeBack(sample);
    return;
  }
  followTurn();
  followProgress();
  bool straight = false;
  if (advanceBegins(sample, &straight)) beginAdvance(sample, straight);
}

namespace {

Vec3 blended(const Vec3& from, const Vec3& to, double gain) {
  const Vec3 axis = from + gain * (to - from);
  return axis.norm() > 1e-6 ? Vec3(axis.normalized()) : to;
}

}  // namespace

void PhaseDetector::smooth(const TrialSample& sample) {
  const double dt = sample.t_s - t_s_;
  const bool fresh = !started_ || dt < 0;
  const double gain = fresh ? 1 : 1 - pinned::exp(-dt / rules_.smoothing_s);
  const double slow_gain = fresh ? 1 : 1 - pinned::exp(-dt / rules_.steady_s);
  started_ = true;
  t_s_ = sample.t_s;
  tip_ += gain * (sample.tip_A - tip_);
  axis_ = blended(axis_, sample.axis_A, gain);
  slow_axis_ = blended(slow_axis_, sample.axis_A, slow_gain);
}

void PhaseDetector::beginPass(const TrialSample& sample) {
  phase_ = ProcedurePhase::puncture;
  reoriented_ = straight_ = false;
  // The approach may have been fast: what is smoothed starts afresh at the skin.
  tip_ = sample.tip_A;
  axis_ = slow_axis_ = sample.axis_A;
  setAnchor();
  puncture_ = before_turn_ = sample;
  end_of_phase_1_ = start_of_phase_2_ = TrialSample{};
}

void PhaseDetector::setAnchor() {
  anchor_tip_ = tip_;
  anchor_axis_ = axis_;
}

double PhaseDetector::turn() const { return angleBetween(axis_, puncture_.axis_A); }
bool PhaseDetector::steady() const { return angleBetween(axis_, slow_axis_) < rules_.steady; }

void PhaseDetector::followTurn() {
  if (phase_ == ProcedurePhase::puncture && turn() > rules_.turn_begins)
    phase_ = ProcedurePhase::reorient;
  else if (phase_ == ProcedurePhase::reorient && turn() < rules_.turn_undone)
    phase_ = ProcedurePhase::puncture;
  const bool turning = phase_ == ProcedurePhase::reorient;
  reoriented_ = turning && (reoriented_ || turn() >= rules_.turned);
  if (turning) end_of_phase_1_ = before_turn_;
}

void PhaseDetector::followProgress() {
  const bool pulled_back = (tip_ - anchor_tip_).dot(anchor_axis_) < 0;
  const bool turned_on = angleBetween(axis_, anchor_axis_) > rules_.settled;
  if (turn() < rules_.turned || pulled_back || turned_on) setAnchor();
}

bool PhaseDetector::advanceBegins(const TrialSample& sample, bool* straight) const {
  if (sample.tissue == Tissue::vein_lumen) return true;
  if ((tip_ - anchor_tip_).dot(anchor_axis_) >= rules_.advance) return true;
  *straight = (tip_ - puncture_.tip_A).norm() > rules_.straight;
  return *straight;
}

void PhaseDetector::beginAdvance(const TrialSample& sample, bool straight) {
  if (!reoriented_) end_of_phase_1_ = sample;
  phase_ = ProcedurePhase::advance;
  straight_ = straight;
  start_of_phase_2_ = sample;
}

void PhaseDetector::maybeTakeBack(const TrialSample& sample) {
  if (sample.tissue == Tissue::vein_lumen) straight_ = false;
  const bool returned = (tip_ - puncture_.tip_A).norm() < rules_.straight / 2;
  if (!straight_ || !returned || turn() < rules_.turn_begins) return;
  phase_ = ProcedurePhase::reorient;
  straight_ = false;
  setAnchor();
  followTurn();
}

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
