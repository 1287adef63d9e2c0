#include "apps/twin/feeling_hands.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>
#include <string>

#include "anatomy/base/random.h"
#include "apps/twin/fingers.h"
#include "apps/twin/hand_motion.h"
#include "apps/twin/hand_senses.h"

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
// Rolling: both come down, then one after the other presses, this often; s, m
constexpr double kRollBegins_s = 0.4, kRollTurn_s = 0.8, kRollMean = 0.0035, kRollSwing = 0.0015;
constexpr int kRolls = 3;

std::string streamOf(const char* name, std::size_t finger) {
  return finger == 0 ? name : std::string(name) + "." + std::to_string(finger);
}

/// One finger: where it is, what it feels.
struct Finger {
  Finger(const PalpatingSkill& skill, std::size_t number, std::uint64_t seed)
      : noise(seed, streamOf("palpating.noise", number)),
        tremor(skill.tremor_rms, RandomStream(seed, streamOf("palpating.tremor", number))) {}

  /// A press begins here.
  void begin() {
    touched = false;
    ended = false;
    air_N = felt_N;
    resistance_N = 0;
    z = tip_P.z();
    depths.clear();
  }

  RandomStream noise;
  Tremor tremor;
  Bearings bearings;
  double speed = 0;
  Vec3 p_last_D = Vec3::Zero();
  std::int64_t last_look_ns = 0, next_feeling_ns = 0;
  Vec3 tip_P = Vec3::Zero();
  double wanted_z = 0;
  double felt_N = 0, air_N = 0, touched_z = 0, light_z = 0;
  double resistance_N = 0, z = 0;  // at the last thought
  bool touched = false, ended = false;
  std::vector<double> depths;  // of this press so far
};

/// The person behind the fingers.
class PalpatingMind {
 public:
  PalpatingMind(const PalpatingSkill& skill, const VisiblePhantom& phantom, const Pose& X_ET,
                std::size_t fingers, std::uint64_t seed)
      : skill_(skill),
        X_AP_(phantom.X_AP),
        top_(phantom.top),
        X_ET_(X_ET),
        X_TE_(X_ET.inverse()),
        search_(skill, phantom, static_cast<int>(fingers), seed) {
    for (std::size_t i = 0; i < fingers; ++i) fingers_.emplace_back(skill, i, seed);
  }

  Hand::Action act(std::size_t number, const Hand::Senses& senses, double dt);

 private:
  enum class PalpationStep { rest, travel, press, overshoot, lift, roll, mark, release };
  void look(std::size_t number, const Hand::Senses& senses, double dt);
  void feel(Finger& finger, const Hand::Senses& senses);
  void think(const Hand::Senses& senses);
  void beginTrial(int trial, double now_s);
  void goTo(const Vec3& p_P, double now_s, PalpationStep next);
  void travel(double now_s);
  void press(double now_s);
  void pressing(Finger& finger);
  void lift(double now_s);
  void roll(double now_s);
  void next(double now_s);
  bool presses(std::size_t number) const { return number == 0 || both_; }
  void lower(double by);
  Pose toolOver(const Vec3& along, const Vec3& trembling) const;

  PalpatingSkill skill_;
  Pose X_AP_;
  TopShape top_;
  Pose X_ET_, X_TE_;
  std::vector<Finger> fingers_;

  PalpationStep step_ = PalpationStep::rest, after_travel_ = PalpationStep::rest;
  int trial_ = 0;
  // Where the first finger is wanted, along the top; its height is each finger's own
  Vec3 at_P_ = Vec3::Zero();
  bool both_ = false;  // press in this press
  MinJerk move_;
  double since_s_ = 0;
  LumpSearch search_;
  std::optional<LumpSearch::Intent> to_mark_;  // once it has been rolled
  Hand::Word word_;
  bool done_ = false;
};

void PalpatingMind::beginTrial(int trial, double now_s) {
  trial_ = trial;
  done_ = false;
  to_mark_.reset();
  search_.begin(trial);
  next(now_s);
}

void PalpatingMind::goTo(const Vec3& p_P, double now_s, PalpationStep next) {
  const Vec3 over(p_P.x(), p_P.y(), p_P.z() + kOverTop);
  const Vec3 from(at_P_.x(), at_P_.y(), fingers_[0].wanted_z);
  move_ = MinJerk(makePose(Mat3::Identity(), from), makePose(Mat3::Identity(), over), now_s,
                  std::max(0.15, (over - from).norm() / skill_.travel_speed));
  step_ = PalpationStep::travel;
  after_travel_ = next;
}

/// A finger that does not press this time stays above.
void PalpatingMind::lower(double by) {
  for (std::size_t i = 0; i < fingers_.size(); ++i)
    if (presses(i) && !fingers_[i].ended) fingers_[i].wanted_z -= by;
}

/// Down evenly; what it takes to move in the air is no resistance of the phantom.
void PalpatingMind::pressing(Finger& f) {
  if (f.tip_P.z() > kMoves)
    f.air_N = f.felt_N;
  else if (f.tip_P.z() > kNear)
    f.air_N += kSharp * (f.felt_N - f.air_N);
  const double resistance = f.felt_N - f.air_N, z = f.tip_P.z();
  // Where between two thoughts a force was passed: a press is felt as one, not in steps.
  const auto passed = [&](double force_N) {
    const double share = (force_N - f.resistance_N) / std::max(resistance - f.resistance_N, 1e-9);
    return f.z + std::clamp(share, 0.0, 1.0) * (z - f.z);
  };
  if (!f.touched && resistance > kTouch_N) {
    f.touched = true;
    f.touched_z = passed(kTouch_N);
  }
  while (f.touched && f.depths.size() < skill_.pressures.size() &&
         resistance >= skill_.pressures[f.depths.size()]) {
    const double there = passed(skill_.pressures[f.depths.size()]);
    if (f.depths.empty()) f.light_z = there;
    f.depths.push_back((f.depths.empty() ? f.touched_z : f.light_z) - there);
  }
  f.resistance_N = resistance;
  f.z = z;
  const double enough = skill_.pressures.back() * (search_.looksCloser() ? skill_.closer_force : 1);
  f.ended = resistance >= enough || f.tip_P.z() <= -kDeepest;
}

/// Each finger goes on until it has pressed enough; the other one waits where it is.
void PalpatingMind::press(double now_s) {
  lower(skill_.press_speed * kThink_s);
  bool all = true;
  for (std::size_t i = 0; i < fingers_.size(); ++i) {
    if (!presses(i)) continue;
    if (!fingers_[i].ended) pressing(fingers_[i]);
    all &= fingers_[i].ended;
  }
  if (!all) return;
  since_s_ = now_s;
  for (Finger& f : fingers_) f.ended = false;
  step_ = PalpationStep::overshoot;  // it goes on for as long as it takes to react
}

void PalpatingMind::next(double now_s) {
  using Deed = LumpSearch::Deed;
  const LumpSearch::Intent intent = to_mark_ ? *to_mark_ : search_.next();  // a pause came between
  if (intent.deed != Deed::press) word_ = intent.word;
  both_ = intent.both;
  done_ = intent.deed == Deed::end;
  if (done_) return goTo(Vec3(0, 0, kHome), now_s, PalpationStep::rest);
  if (intent.deed == Deed::mark && fingers_.size() > 1) {
    to_mark_ = intent;
    both_ = true;
    return goTo(intent.p_P - 0.5 * search_.apart(), now_s, PalpationStep::roll);
  }
  goTo(intent.p_P, now_s, intent.deed == Deed::mark ? PalpationStep::mark : PalpationStep::press);
}

void PalpatingMind::travel(double now_s) {
  const Vec3 now = move_.at(now_s).translation();
  at_P_ = now;
  for (Finger& f : fingers_) f.wanted_z = now.z();
  if (!move_.done(now_s)) return;
  step_ = after_travel_;
  since_s_ = now_s;
  for (Finger& f : fingers_) f.begin();
}

void PalpatingMind::lift(double now_s) {
  for (std::size_t i = 0; i < fingers_.size(); ++i)
    if (presses(i) && fingers_[i].wanted_z < kOverTop) fingers_[i].wanted_z += kLift * kThink_s;
  for (std::size_t i = 0; i < fingers_.size(); ++i)
    if (presses(i) && fingers_[i].wanted_z < kOverTop) return;
  search_.felt(fingers_[0].tip_P, fingers_[0].depths);
  if (both_) search_.felt(fingers_[1].tip_P, fingers_[1].depths);
  next(now_s);
}

/// The lump between the fingers, one pressing as the other yields.
void PalpatingMind::roll(double now_s) {
  const double t = now_s - since_s_, turns = (t - kRollBegins_s) / kRollTurn_s;
  const double down = std::clamp(t / kRollBegins_s, 0.0, 1.0);
  const double swing =
      turns > 0 ? kRollSwing * std::sin(2 * std::numbers::pi * std::min<double>(turns, kRolls)) : 0;
  fingers_[0].wanted_z = kOverTop - down * (kOverTop + kRollMean) - swing;
  fingers_[1].wanted_z = kOverTop - down * (kOverTop + kRollMean) + swing;
  if (turns < kRolls) return;
  const LumpSearch::Intent mark = *to_mark_;
  to_mark_.reset();
  both_ = false;
  goTo(mark.p_P, now_s, PalpationStep::mark);
}

void PalpatingMind::think(const Hand::Senses& senses) {
  const double now_s = static_cast<double>(senses.now_ns) * 1e-9;
  if (!senses.seen) return;
  if (senses.seen->running && senses.seen->trial != trial_)
    return beginTrial(senses.seen->trial, now_s);
  if (!senses.seen->running && step_ != PalpationStep::rest &&
      step_ != PalpationStep::travel) {  // paused or over: away from it
    return goTo(Vec3(at_P_.x(), at_P_.y(), kHome), now_s, PalpationStep::rest);
  }
  if (senses.seen->running && step_ == PalpationStep::rest && trial_ > 0 && !done_)
    return next(now_s);  // after a pause
  switch (step_) {
    case PalpationStep::rest:
      return;
    case PalpationStep::travel:
      return travel(now_s);
    case PalpationStep::press:
      return press(now_s);
    case PalpationStep::overshoot:
      lower(skill_.press_speed * kThink_s);
      if (now_s - since_s_ >= skill_.reaction) step_ = PalpationStep::lift;
      return;
    case PalpationStep::lift:
      return lift(now_s);
    case PalpationStep::roll:
      return roll(now_s);
    case PalpationStep::mark:
      if (now_s - since_s_ >= kMarkFor_s) step_ = PalpationStep::release, since_s_ = now_s;
      return;
    case PalpationStep::release:
      if (now_s - since_s_ >= kMarkFor_s) next(now_s);
      return;
  }
}

void PalpatingMind::look(std::size_t number, const Hand::Senses& senses, double dt) {
  Finger& f = fingers_[number];
  const Vec3 p_D = senses.X_DE.translation();
  f.speed += ((p_D - f.p_last_D).norm() / dt - f.speed) * std::min(1.0, dt / 0.05);
  f.p_last_D = p_D;
  if (!senses.seen || (senses.now_ns - f.last_look_ns < kGlance_ns && f.bearings.taken())) return;
  f.last_look_ns = senses.now_ns;
  const bool first = !f.bearings.taken();
  f.bearings.look(number == 0 ? senses.seen->X_AT : senses.seen->second_X_AT, senses.X_DE * X_ET_,
                  skill_.look_sd, f.speed, f.noise);
  if (!first) return;
  const Vec3 tip_P = alongTop(top_, X_AP_.inverse() * f.bearings.X_AT().translation());
  f.wanted_z = number == 0 ? tip_P.z() : fingers_[0].wanted_z;
  if (number == 0) at_P_ = tip_P;
}

void PalpatingMind::feel(Finger& f, const Hand::Senses& senses) {
  const Pose X_PD = X_AP_.inverse() * f.bearings.X_DA().inverse();
  f.tip_P = alongTop(top_, X_PD * (senses.X_DE * X_ET_).translation());
  const Vec3 f_P = X_PD.linear() * senses.f_fingers_D;
  const double along = top_.flat() ? f_P.z() : f_P.dot(normalOf(top_, f.tip_P.x(), f.tip_P.y()));
  f.felt_N += kSharp * (-along - f.felt_N);
}

/// It points into the top along its normal.
Pose PalpatingMind::toolOver(const Vec3& along, const Vec3& trembling) const {
  const Mat3 down = Eigen::AngleAxisd(std::numbers::pi, Vec3::UnitX()).toRotationMatrix();
  if (top_.flat()) return makePose(down, along + trembling);
  return makePose(turnToNormal(normalOf(top_, along.x(), along.y())) * down,
                  fromTop(top_, along) + trembling);
}

/// It is thought when the first finger has felt; what the second felt is then of a thought before.
Hand::Action PalpatingMind::act(std::size_t number, const Hand::Senses& senses, double dt) {
  Finger& f = fingers_[number];
  look(number, senses, dt);
  if (!f.bearings.taken()) return {senses.X_DE, 0, 0, {}};
  if (senses.now_ns >= f.next_feeling_ns) {
    f.next_feeling_ns = senses.now_ns + kThink_ns;
    feel(f, senses);
    if (number == 0) think(senses);
  }
  const Vec3 at_P = at_P_ + static_cast<double>(number) * search_.apart();
  Hand::Action action;
  action.X_DH = f.bearings.X_DA() * X_AP_ *
                toolOver(Vec3(at_P.x(), at_P.y(), f.wanted_z), f.tremor.next(dt)) * X_TE_;
  if (number > 0) return action;
  action.buttons = step_ == PalpationStep::mark ? 1u : 0u;
  const bool says_now = word_.kind == Hand::WordKind::done ? step_ == PalpationStep::travel
                                                           : step_ == PalpationStep::release;
  if (says_now && word_.kind != Hand::WordKind::none) std::swap(action.says, word_);
  return action;
}

}  // namespace

std::vector<std::unique_ptr<Hand>> palpatingFingers(const PalpatingSkill& skill,
                                                    const VisiblePhantom& phantom, const Pose& X_ET,
                                                    int fingers, std::uint64_t seed) {
  const auto count = static_cast<std::size_t>(fingers);
  const auto mind = std::make_shared<PalpatingMind>(skill, phantom, X_ET, count, seed);
  return fingersOf(mind, skill.grip, count);
}

}  // namespace palpa::twin
