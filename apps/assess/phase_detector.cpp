#include "apps/assess/phase_detector.h"

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
  const double gain = fresh ? 1 : 1 - std::exp(-dt / rules_.smoothing_s);
  const double slow_gain = fresh ? 1 : 1 - std::exp(-dt / rules_.steady_s);
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

}  // namespace palpa::assess
