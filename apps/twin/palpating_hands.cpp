#include "apps/twin/palpating_hand.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace palpa::twin {
namespace {

constexpr std::int64_t kThink_ns = 10'000'000, kGlance_ns = 100'000'000;  // 100 Hz, 10 Hz
constexpr double kThink_s = 0.01;
constexpr double kSharp = 0.3;      // touch is not sharper than about 25 ms
constexpr double kOverTop = 0.005;  // m, from where a press begins
constexpr double kMoves = 0.003,
                 kNear = 0.0008;  // m above the top: between them the hand learns what moving takes
constexpr double
    kTouch_N = 0.06,
    kDeepest = 0.009;  // N above the air's, m below the top: a hand that feels nothing stops there
constexpr double kLift = 0.05;  // m/s
constexpr double kMarkFor_s = 0.3;
constexpr double kHome = 0.04;  // m above the top

}  // namespace

PalpatingHand::PalpatingHand(const PalpatingSkill& skill, const VisiblePhantom& phantom,
                             const Pose& X_ET, std::uint64_t seed)
    : skill_(skill),
      X_AP_(phantom.X_AP),
      X_ET_(X_ET),
      X_TE_(X_ET.inverse()),
      noise_(seed, "palpating.noise"),
      tremor_(skill.tremor_rms, RandomStream(seed, "palpating.tremor")),
      search_(skill, phantom, seed) {}

void PalpatingHand::beginTrial(int trial, double now_s) {
  trial_ = trial;
  done_ = false;
  search_.begin(trial);
  next(now_s);
}

void PalpatingHand::goTo(const Vec3& p_P, double now_s, PalpationStep next) {
  const Vec3 over(p_P.x(), p_P.y(), p_P.z() + kOverTop);
  move_ = MinJerk(makePose(Mat3::Identity(), tip_P_), makePose(Mat3::Identity(), over), now_s,
                  std::max(0.15, (over - tip_P_).norm() / skill_.travel_speed));
  step_ = PalpationStep::travel;
  after_travel_ = next;
}

/// Down evenly; what it takes to move in the air is no resistance of the phantom.
void PalpatingHand::pressing(double now_s) {
  tip_P_.z() -= skill_.press_speed * kThink_s;
  if (tip_now_P_.z() > kMoves)
    air_N_ = felt_N_;
  else if (tip_now_P_.z() > kNear)
    air_N_ += kSharp * (felt_N_ - air_N_);
  const double resistance = felt_N_ - air_N_, z = tip_now_P_.z();
  // Where between two thoughts a force was passed: a press is felt as one, not in steps.
  const auto passed = [&](double force_N) {
    const double share = (force_N - resistance_N_) / std::max(resistance - resistance_N_, 1e-9);
    return z_ + std::clamp(share, 0.0, 1.0) * (z - z_);
  };
  if (!touched_ && resistance > kTouch_N) {
    touched_ = true;
    touched_z_ = passed(kTouch_N);
  }
  while (touched_ && depths_.size() < skill_.pressures.size() &&
         resistance >= skill_.pressures[depths_.size()]) {
    const double there = passed(skill_.pressures[depths_.size()]);
    if (depths_.empty()) light_z_ = there;
    depths_.push_back((depths_.empty() ? touched_z_ : light_z_) - there);
  }
  resistance_N_ = resistance;
  z_ = z;
  const double enough = skill_.pressures.back() * (search_.looksCloser() ? skill_.closer_force : 1);
  if (resistance < enough && tip_now_P_.z() > -kDeepest) return;
  since_s_ = now_s;
  step_ = PalpationStep::overshoot;  // it goes on for as long as it takes to react
}

void PalpatingHand::next(double now_s) {
  using Deed = LumpSearch::Deed;
  const LumpSearch::Intent intent = search_.next();
  if (intent.deed != Deed::press) word_ = intent.word;
  done_ = intent.deed == Deed::end;
  if (done_) return goTo(Vec3(0, 0, kHome), now_s, PalpationStep::rest);
  goTo(intent.p_P, now_s, intent.deed == Deed::mark ? PalpationStep::mark : PalpationStep::press);
}

void PalpatingHand::think(const Senses& senses) {
  const double now_s = static_cast<double>(senses.now_ns) * 1e-9;
  const Pose X_PD = X_AP_.inverse() * bearings_.X_DA().inverse();
  tip_now_P_ = X_PD * (senses.X_DE * X_ET_).translation();
  felt_N_ += kSharp * (-(X_PD.linear() * senses.f_fingers_D).z() - felt_N_);
  if (!senses.seen) return;
  if (senses.seen->running && senses.seen->trial != trial_)
    return beginTrial(senses.seen->trial, now_s);
  if (!senses.seen->running && step_ != PalpationStep::rest &&
      step_ != PalpationStep::travel) {  // paused or over: away from it
    return goTo(Vec3(tip_P_.x(), tip_P_.y(), kHome), now_s, PalpationStep::rest);
  }
  if (senses.seen->running && step_ == PalpationStep::rest && trial_ > 0 && !done_)
    return next(now_s);  // after a pause
  switch (step_) {
    case PalpationStep::rest:
      return;
    case PalpationStep::travel:
      tip_P_ = move_.at(now_s).translation();
      if (!move_.done(now_s)) return;
      step_ = after_travel_;
      since_s_ = now_s;
      touched_ = false;
      air_N_ = felt_N_;
      resistance_N_ = 0;
      z_ = tip_now_P_.z();
      depths_.clear();
      return;
    case PalpationStep::press:
      return pressing(now_s);
    case PalpationStep::overshoot:
      tip_P_.z() -= skill_.press_speed * kThink_s;
      if (now_s - since_s_ >= skill_.reaction) step_ = PalpationStep::lift;
      return;
    case PalpationStep::lift:
      tip_P_.z() += kLift * kThink_s;
      if (tip_P_.z() < kOverTop) return;
      search_.felt(tip_now_P_, depths_);
      return next(now_s);
    case PalpationStep::mark:
      if (now_s - since_s_ >= kMarkFor_s) step_ = PalpationStep::release, since_s_ = now_s;
      return;
    case PalpationStep::release:
      if (now_s - since_s_ >= kMarkFor_s) next(now_s);
      return;
  }
}

Hand::Action PalpatingHand::act(const Senses& senses, double dt) {
  const Vec3 p_D = senses.X_DE.translation();
  hand_speed_ += ((p_D - p_last_D_).norm() / dt - hand_speed_) * std::min(1.0, dt / 0.05);
  p_last_D_ = p_D;
  if (senses.seen && (senses.now_ns - last_look_ns_ >= kGlance_ns || !bearings_.taken())) {
    last_look_ns_ = senses.now_ns;
    const bool first = !bearings_.taken();
    bearings_.look(senses.seen->X_AT, senses.X_DE * X_ET_, skill_.look_sd, hand_speed_, noise_);
    if (first) tip_P_ = X_AP_.inverse() * bearings_.X_AT().translation();
  }
  if (!bearings_.taken()) return {senses.X_DE, 0, 0, {}};
  if (senses.now_ns >= next_thought_ns_) {
    next_thought_ns_ = senses.now_ns + kThink_ns;
    think(senses);
  }
  const Vec3 tip_P = tip_P_ + tremor_.next(dt);
  Action action;
  action.X_DH =
      bearings_.X_DA() * X_AP_ *
      makePose(Eigen::AngleAxisd(std::numbers::pi, Vec3::UnitX()).toRotationMatrix(), tip_P) *
      X_TE_;
  action.buttons = step_ == PalpationStep::mark ? 1u : 0u;
  const bool says_now = word_.kind == WordKind::done ? step_ == PalpationStep::travel
                                                     : step_ == PalpationStep::release;
  if (says_now && word_.kind != WordKind::none) std::swap(action.says, word_);
  return action;
}

}  // namespace palpa::twin
