#include "apps/twin/operator.h"

#include <algorithm>
#include <cmath>

namespace palpa::twin {
namespace {

constexpr std::int64_t kThoughtPeriod = 10'000'000;  // decisions at 100 Hz
constexpr double kThought = Reaction::kStep;         // s
constexpr std::int64_t kLookPeriod = 100'000'000;    // a glance at the needle, 10 Hz
constexpr double kAbove = 0.020;                     // m above the skin, where the approach ends
constexpr double kHover = 0.002;                     // m above the skin, where the push begins
constexpr double kBackFromBone = 0.006;              // m
constexpr double kPatience = 1.5;  // s of interrupted flow before the needle goes a little deeper
constexpr double kNudge = 0.001;   // m
constexpr int kNudges = 2;         // then this is the edge of the vein: try elsewhere
constexpr double kDrawn = 0.4;     // plunger held under suction while advancing
constexpr double kDeepestPush = 0.020;  // m the hand goes below the skin in search of the puncture
constexpr double kFirstGrip = 0.4;      // share of peak force below which resistance counts as lost

}  // namespace

Pose needlePickedUp(const station::Station& station, const Pose& X_WA, const Vec3& entry_A,
                    bool left_handed) {
  const Vec3 tip_W = X_WA * entry_A + Vec3(left_handed ? -0.02 : 0.02, -0.05, 0.07);
  const Vec3 axis_W = Vec3(0, 0.35, -1).normalized();
  return station.X_WD.inverse() * makePose(rotationWithZ(axis_W), tip_W) * station.X_ET.inverse();
}

Operator::Operator(const OperatorSkill& skill, const VisibleAnatomy& anatomy, const Pose& X_ET,
                   std::uint64_t seed)
    : skill_(skill),
      vein_distance_(anatomy.vein_distance),
      plan_(skill, anatomy, seed),
      X_ET_(X_ET),
      X_TE_(X_ET.inverse()),
      noise_(seed, "operator.noise"),
      tremor_(skill.tremor_rms, RandomStream(seed, "operator.tremor")),
      turn_tremor_(skill.turn_tremor_rms, RandomStream(seed, "operator.turn_tremor")),
      reaction_(skill.reaction) {}

Pose Operator::needleAt(const Vec3& tip_A, const Vec3& axis_A) const {
  return makePose(rotationWithZ(axis_A, plan_.bevel_A()), tip_A);
}

double Operator::seenInsertion() const {
  return (bearings_.X_AT().translation() - entry_seen_A_).dot(axis_A_) + plan_.depthError();
}

/// Compares the needle on the screen with the own hand: where is the patient for my hand?
void Operator::look(const Senses& senses) {
  if (!senses.seen) return;
  const bool first = !bearings_.taken();
  bearings_.look(senses.seen->X_AT, senses.X_DE * X_ET_, skill_.look_sd, hand_speed_, noise_);
  if (!first) return;
  X_DH_ = senses.X_DE;
  tip_A_ = bearings_.X_AT().translation();
  axis_A_ = bearings_.X_AT().rotation() * Vec3::UnitZ();
}

void Operator::feel(const Senses& senses) {
  Reaction::Sight sight;
  if (senses.seen)
    sight = {senses.seen->flows, senses.seen->injury,
             senses.seen->question == runtime::Displayed::Question::aspirated};
  reaction_.perceive(bearings_.X_DA().rotation().transpose() * senses.f_grip_D, sight);
}

void Operator::begin(NeedleStep step, double now_s, double pause_s) {
  if (step == NeedleStep::leave &&
      moving_) {  // a turn that is broken off: out along the needle from where it is
    insertion_ = (tip_A_ - entry_seen_A_).dot(axis_A_);
    moving_ = false;
  }
  step_ = step;
  ready_s_ = now_s + pause_s;
  peak_N_ = 0;
}

void Operator::beginTrial(int trial, double now_s) {
  trial_ = trial;
  passes_ = 0;
  plan_.begin(trial);
  approach(now_s);
}

/// The same trial, after a pause in which he has left the skin.
void Operator::goOn(double now_s) {
  if (step_ == NeedleStep::rest) approach(now_s);
}

void Operator::approach(double now_s) {
  interrupted_ = going_back_ = false;
  nudges_ = 0;
  entry_seen_A_ = plan_.entry_A();
  moveTo(needleAt(plan_.entry_A() + kAbove * plan_.normal_A(), -plan_.normal_A()), now_s,
         skill_.travel_speed);
  plunger_wanted_ = 0;
  begin(NeedleStep::approach, now_s, 0);
}

void Operator::moveTo(const Pose& X_AT, double now_s, double speed) {
  const Pose from = needleAt(tip_A_, axis_A_);
  const double way = (X_AT.translation() - from.translation()).norm();
  const double turn =
      std::acos(std::clamp(axis_A_.dot(X_AT.rotation() * Vec3::UnitZ()), -1.0, 1.0));
  move_ = MinJerk(from, X_AT, now_s, std::max(way / speed, turn / 1.0));  // wrists turn 1 rad/s
  moving_ = true;
}

/// Turns about the entry, keeping the insertion.
void Operator::aimAt(const Vec3& axis_A, double now_s, double duration_s) {
  move_ =
      MinJerk(needleAt(entry_seen_A_, axis_A_), needleAt(entry_seen_A_, axis_A), now_s, duration_s);
  moving_ = true;
}

void Operator::holdHere() {
  tip_A_ = bearings_.X_AT().translation();
  insertion_ = (tip_A_ - entry_seen_A_).dot(axis_A_);
}

/// Along the skin's normal until the resistance is lost, or, without feeling, until it looks deep
/// enough.
void Operator::pushing(double now_s) {
  insertion_ += skill_.push_speed * kThought;
  const Vec3& felt = reaction_.felt();
  const double resistance = felt.dot(axis_A_);
  peak_N_ = std::max(peak_N_, resistance);
  const bool lost = peak_N_ > skill_.notice_puncture_N && resistance < kFirstGrip * peak_N_;
  const bool deep = seenInsertion() >= skill_.first_depth;
  if (lost || deep || insertion_ > kDeepestPush) {
    feels_ = peak_N_ > skill_.notice_puncture_N;
    holdHere();
    begin(NeedleStep::settle, now_s, skill_.pause);
  }
}

void Operator::advancing(double now_s) {
  insertion_ += skill_.advance_speed * kThought;
  if (reaction_.bloodFlows()) return dwell(now_s);
  if (reaction_.injury()) return tryElsewhere(now_s, insertion_ - skill_.first_depth);
  const double along = reaction_.felt().dot(axis_A_);
  const Vec3 sideways = reaction_.felt() - along * axis_A_;
  const bool bone = sideways.norm() > skill_.notice_bone_N || along > 3 * skill_.notice_bone_N;
  const bool dry = seenInsertion() > vein_distance_ + skill_.search_margin;
  if (!bone && !dry) return;
  tryElsewhere(now_s, bone ? kBackFromBone : insertion_ - skill_.first_depth);
  // The hand pushes against the bone: it yields the other way. After a dry pass: try another side.
  if (bone && sideways.norm() > 1e-6) turn_toward_A_ = -sideways.normalized();
}

/// Draws the needle back, then redirects it; after too many attempts, gives up.
void Operator::tryElsewhere(double now_s, double back) {
  if (++passes_ > skill_.redirections) {
    gives_up_ = true;
    return begin(NeedleStep::leave, now_s, skill_.pause);
  }
  going_back_ = true;
  turn_toward_A_ = Vec3::Zero();
  retreat_to_ = std::max(insertion_ - back, 0.5 * skill_.first_depth);
  begin(NeedleStep::retreat, now_s, 0);
}

void Operator::retreating(double now_s) {
  insertion_ -= skill_.withdraw_speed * kThought;
  if (!going_back_ && reaction_.bloodFlows()) return dwell(now_s);
  if (insertion_ <= retreat_to_) turnAway(turn_toward_A_, now_s);
}

/// Redirects: away from bone, or in turn to the sides, always by a small angle.
void Operator::turnAway(const Vec3& toward_A, double now_s) {
  aimAt(plan_.redirected(axis_A_, toward_A, passes_), now_s, 0.5 * skill_.turn_time);
  nudges_ = 0;
  begin(NeedleStep::redirect, now_s, 0);
}

void Operator::dwell(double now_s) {
  holdHere();
  dwell_since_s_ = dwell_begun_s_ = now_s;
  begin(NeedleStep::dwell, now_s, 0);
}

void Operator::dwelling(double now_s) {
  plunger_wanted_ = 1;
  if (reaction_.injury()) return tryElsewhere(now_s, insertion_ - skill_.first_depth);
  if (reaction_.bloodFlows()) {
    dwell_since_s_ = now_s;
    if (now_s - dwell_begun_s_ <= kPatience) return;
    // It comes and goes: a little deeper; when that does not help, this is only the vein's edge.
    if (++nudges_ > kNudges) return tryElsewhere(now_s, 2 * skill_.search_margin);
    insertion_ += kNudge;
    dwell_begun_s_ = now_s;
  } else if (now_s - dwell_since_s_ > 2 * skill_.reaction) {  // lost it: back a little, slowly
    going_back_ = false;
    retreat_to_ = insertion_ - 0.5 * skill_.search_margin;
    turn_toward_A_ = Vec3::Zero();
    begin(NeedleStep::retreat, now_s, 0);
  }
}

void Operator::think(const Senses& senses) {
  const double now_s = static_cast<double>(senses.now_ns) * 1e-9;
  feel(senses);
  if (!senses.seen || !bearings_.taken()) return;
  running_ = senses.seen->running;
  if (running_ && senses.seen->trial != trial_) return beginTrial(senses.seen->trial, now_s);
  interrupted_ |= !running_;
  if (!running_ && step_ != NeedleStep::rest && step_ != NeedleStep::leave)
    return begin(NeedleStep::leave, now_s, skill_.pause);
  if (running_ && interrupted_) goOn(now_s);
  if (!reaction_.seen().asks) told_ = false;
  if (now_s < ready_s_) return;
  step(now_s);
}

/// Once for each question: what the blood in the syringe looks like says whose it is.
int Operator::tells() {
  const Reaction::Sight& seen = reaction_.seen();
  if (told_ || !seen.asks) return 0;
  told_ = true;
  return seen.flows == Tissue::vein_lumen ? 1 : seen.flows == Tissue::artery_lumen ? 2 : 3;
}

void Operator::step(double now_s) {
  const bool arrived = !moving_ || move_.done(now_s);
  switch (step_) {
    case NeedleStep::rest:
      return;
    case NeedleStep::approach:
      if (!arrived) return;
      moveTo(needleAt(plan_.entry_A() + kHover * plan_.normal_A(), -plan_.normal_A()), now_s,
             0.25 * skill_.travel_speed);
      return begin(NeedleStep::lower, now_s, 0);
    case NeedleStep::lower:
      if (!arrived) return;
      moving_ = false;
      insertion_ = -kHover;
      return begin(NeedleStep::push, now_s, skill_.pause);
    case NeedleStep::push:
      return pushing(now_s);
    case NeedleStep::settle:
      entry_seen_A_ =
          bearings_.X_AT().translation() -
          std::max((bearings_.X_AT().translation() - plan_.entry_A()).dot(axis_A_), 0.0) * axis_A_;
      return begin(NeedleStep::deepen, now_s, 0);
    case NeedleStep::deepen:
      if (seenInsertion() < skill_.first_depth) {
        insertion_ += skill_.push_speed * kThought;
        return;
      }
      holdHere();
      aimAt(plan_.firstAim(entry_seen_A_, feels_), now_s + skill_.pause, skill_.turn_time);
      return begin(NeedleStep::turn, now_s, skill_.pause);
    case NeedleStep::turn:
    case NeedleStep::redirect:
      if (!arrived) return;
      moving_ = false;
      plunger_wanted_ = kDrawn;
      return begin(NeedleStep::advance, now_s,
                   step_ == NeedleStep::turn ? skill_.pause : 0.5 * skill_.pause);
    case NeedleStep::advance:
      return advancing(now_s);
    case NeedleStep::retreat:
      return retreating(now_s);
    case NeedleStep::dwell:
      return dwelling(now_s);
    case NeedleStep::leave:
      return leaving(now_s);
  }
}

void Operator::leaving(double now_s) {
  insertion_ -= skill_.withdraw_speed * kThought;
  plunger_wanted_ = 0;
  if (insertion_ > -kHover) return;
  // Out of the skin: up and away from it, since behind a flat needle the chest may bulge.
  moveTo(needleAt(plan_.entry_A() + kAbove * plan_.normal_A(), -plan_.normal_A()), now_s,
         skill_.travel_speed);
  begin(NeedleStep::rest, now_s, 0);
}

Operator::Action Operator::act(const Senses& senses, double dt) {
  const double now_s = static_cast<double>(senses.now_ns) * 1e-9;
  const Vec3 p_D = senses.X_DE.translation();
  hand_speed_ += ((p_D - p_last_D_).norm() / dt - hand_speed_) * std::min(1.0, dt / 0.05);
  p_last_D_ = p_D;
  if (senses.now_ns - last_look_ns_ >= kLookPeriod || !bearings_.taken()) {
    last_look_ns_ = senses.now_ns;
    look(senses);
  }
  if (senses.now_ns >= next_thought_ns_) {
    next_thought_ns_ = senses.now_ns + kThoughtPeriod;
    think(senses);
  }
  plunger_ += std::clamp(plunger_wanted_ - plunger_, -dt, dt);  // drawn in a second
  if (!bearings_.taken()) return {senses.X_DE, plunger_, 0, {}};

  if (moving_) {
    const Pose X = move_.at(now_s);
    axis_A_ = X.rotation() * Vec3::UnitZ();
    const bool turning = step_ == NeedleStep::turn || step_ == NeedleStep::redirect;
    tip_A_ = turning ? Vec3(X.translation() + insertion_ * axis_A_) : Vec3(X.translation());
  } else if (step_ != NeedleStep::rest) {
    tip_A_ = entry_seen_A_ + insertion_ * axis_A_;
  }
  const Vec3 turn = turn_tremor_.next(dt);
  Pose X_AT = needleAt(tip_A_ + tremor_.next(dt), axis_A_);
  X_AT.linear() = X_AT.linear() * Eigen::AngleAxisd(turn.norm(), turn.normalized()).matrix();
  X_DH_ = bearings_.X_DA() * X_AT * X_TE_;
  Action action{X_DH_, plunger_, 0, {}};
  if (const int choice = tells(); choice > 0) {
    action.says.kind = WordKind::chooses;
    action.says.choice = choice;
  }
  if (gives_up_) action.says.kind = WordKind::gives_up;
  gives_up_ = false;
  return action;
}

}  // namespace palpa::twin
