#include "apps/twin/feeling_hands.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "anatomy/base/random.h"
#include "anatomy/geometry/pose.h"
#include "apps/twin/fingers.h"
#include "apps/twin/hand_motion.h"
#include "apps/twin/hand_senses.h"

namespace palpa::twin {
namespace {

constexpr std::int64_t kThought_ns = 10'000'000, kLook_ns = 100'000'000;  // 100 Hz, 10 Hz
constexpr double kThought_s = 0.01;
constexpr double kFingertip = 0.3;  // touch is not sharper than about 25 ms
constexpr double kOpen = 0.012,
                 kLifted = 0.025;  // m: of each finger beside the object; above its stand
constexpr double kMoves_s = 0.8, kWeighs_s = 0.5, kPause_s = 0.5;
constexpr double kFarthestIn = 0.014;  // m: a finger that feels nothing stops there

}  // namespace

/// The person behind both fingers.
class SqueezingMind {
 public:
  SqueezingMind(const SqueezingSkill& skill, const VisibleObject& object, const Pose& X_ET,
                std::uint64_t seed)
      : skill_(skill),
        object_(object),
        X_ET_(X_ET),
        judgement_(seed, "squeezing.judgement"),
        noise_(seed, "squeezing.noise"),
        tremors_{Tremor(skill.tremor_rms, RandomStream(seed, "squeezing.tremor.0")),
                 Tremor(skill.tremor_rms, RandomStream(seed, "squeezing.tremor.1"))},
        in_(object.half + kOpen) {}

  Hand::Action act(std::size_t finger, const Hand::Senses& senses, double dt) {
    Finger& f = fingers_[finger];
    look(finger, f, senses, dt);
    if (!f.bearings.taken()) return {senses.X_DE, 0, 0, {}};
    if (finger == 0 && senses.now_ns >= next_thought_ns_) {
      next_thought_ns_ = senses.now_ns + kThought_ns;
      think(senses);
    }
    const double side = finger == 0 ? 1 : -1;
    const Vec3 p_O = Vec3(side * in_, 0, up_) + tremors_[finger].next(dt);
    Hand::Action action;
    action.X_DH = f.bearings.X_DA() * object_.X_AO *
                  makePose(rotationWithZ(Vec3(-side, 0, 0)), p_O) * X_ET_.inverse();
    if (finger == 0) std::swap(action.says, word_);
    return action;
  }

 private:
  enum class SqueezeStep { rest, come, close, lift, weigh, squeeze, relax, lower, open, think };
  /// What one thing felt like.
  struct Felt {
    double weight = 0, stiffness = 0;  ///< N; N/m
  };
  struct Finger {
    Bearings bearings;
    std::int64_t last_look_ns = -kLook_ns;
    Vec3 p_last_D = Vec3::Zero(), tip_O = Vec3::Zero();
    double speed = 0, pushes_N = 0, carries_N = 0;  ///< inward, up
  };

  void look(std::size_t finger, Finger& f, const Hand::Senses& senses, double dt) {
    const Vec3 p_D = senses.X_DE.translation();
    f.speed += ((p_D - f.p_last_D).norm() / dt - f.speed) * std::min(1.0, dt / 0.05);
    f.p_last_D = p_D;
    if (senses.seen && (senses.now_ns - f.last_look_ns >= kLook_ns || !f.bearings.taken())) {
      f.last_look_ns = senses.now_ns;
      f.bearings.look(finger == 0 ? senses.seen->X_AT : senses.seen->second_X_AT,
                      senses.X_DE * X_ET_, skill_.look_sd, f.speed, noise_);
    }
    if (!f.bearings.taken()) return;
    const Pose X_OD = (f.bearings.X_DA() * object_.X_AO).inverse();
    const Vec3 of_finger_O = X_OD.rotation() * senses.f_fingers_D;
    const double sharp = kFingertip * dt / kThought_s;
    f.tip_O = X_OD * (senses.X_DE * X_ET_).translation();
    f.pushes_N += sharp * ((finger == 0 ? -1 : 1) * of_finger_O.x() - f.pushes_N);
    f.carries_N += sharp * (of_finger_O.z() - f.carries_N);
  }

  double pushes() const { return 0.5 * (fingers_[0].pushes_N + fingers_[1].pushes_N) - air_N_; }
  double carries() const { return fingers_[0].carries_N + fingers_[1].carries_N; }
  double apart() const { return 0.5 * (fingers_[0].tip_O.x() - fingers_[1].tip_O.x()); }

  void begin(int trial, double now_s) {
    trial_ = trial;
    thing_ = 0;
    felt_ = {};
    go(SqueezeStep::come, now_s);
  }
  void go(SqueezeStep step, double now_s) {
    step_ = step;
    since_s_ = now_s;
    from_in_ = in_;
    from_up_ = up_;
  }
  /// Minimum jerk between where a step began and where it ends.
  bool moved(double now_s, double in, double up) {
    const double s = std::clamp((now_s - since_s_) / kMoves_s, 0.0, 1.0),
                 part = s * s * s * (10 - 15 * s + 6 * s * s);
    in_ = from_in_ + part * (in - from_in_);
    up_ = from_up_ + part * (up - from_up_);
    return s >= 1;
  }
  bool closed(double enough_N) {
    if (pushes() >= enough_N || in_ < object_.half - kFarthestIn) return true;
    in_ -= skill_.close_speed * kThought_s;
    return false;
  }
  Felt& now() { return felt_[static_cast<std::size_t>(thing_)]; }

  void think(const Hand::Senses& senses) {
    const double now_s = 1e-9 * static_cast<double>(senses.now_ns);
    if (!senses.seen) return;
    if (senses.seen->running && senses.seen->trial != trial_)
      return begin(senses.seen->trial, now_s);
    if (!senses.seen->running) return letGo(senses.seen->trial, now_s);
    step(*senses.seen, now_s);
  }

  /// The trial is over, or paused.
  void letGo(int trial, double now_s) {
    if (step_ != SqueezeStep::rest && step_ != SqueezeStep::open) {
      go(SqueezeStep::open, now_s);
      trial_ = trial;
    }
    if (step_ == SqueezeStep::open && moved(now_s, object_.half + kOpen, 0))
      step_ = SqueezeStep::rest;
  }

  void step(const runtime::Displayed& seen, double now_s) {
    switch (step_) {
      case SqueezeStep::rest:
        return;
      case SqueezeStep::come:
        air_N_ = 0;
        if (!moved(now_s, object_.half + kOpen, 0)) return;
        air_N_ = pushes();
        return go(SqueezeStep::close, now_s);
      case SqueezeStep::close:
        if (!closed(skill_.hold)) return;
        held_N_ = pushes();
        held_apart_ = apart();
        return go(SqueezeStep::lift, now_s);
      case SqueezeStep::lift:
        if (!moved(now_s, from_in_, kLifted)) return;
        weight_sum_ = weight_count_ = 0;
        return go(SqueezeStep::weigh, now_s);
      case SqueezeStep::weigh:
        weight_sum_ += carries();
        weight_count_ += 1;
        if (now_s - since_s_ < kWeighs_s) return;
        now().weight =
            weight_sum_ / weight_count_ * std::exp(skill_.weber_weight * judgement_.normal());
        held_N_ = pushes();
        held_apart_ = apart();
        return go(SqueezeStep::squeeze, now_s);
      case SqueezeStep::squeeze:
        if (!closed(skill_.squeeze)) return;
        now().stiffness = (pushes() - held_N_) / std::max(held_apart_ - apart(), 1e-4) *
                          std::exp(skill_.weber_stiffness * judgement_.normal());
        return go(SqueezeStep::relax, now_s);
      case SqueezeStep::relax:
        if (!moved(now_s, heldHalf(), from_up_)) return;
        return go(SqueezeStep::lower, now_s);
      case SqueezeStep::lower:
        if (!moved(now_s, from_in_, 0)) return;
        return go(SqueezeStep::open, now_s);
      case SqueezeStep::open:
        if (!moved(now_s, object_.half + kOpen, 0)) return;
        if (thing_ == 0) word_.kind = Hand::WordKind::done;  // the other one
        return go(SqueezeStep::think, now_s);
      case SqueezeStep::think:
        if (now_s - since_s_ < kPause_s) return;
        if (thing_ == 0) {
          thing_ = 1;
          return go(SqueezeStep::come, now_s);
        }
        say(seen.question == runtime::Displayed::Question::heavier);
        step_ = SqueezeStep::rest;
        return;
    }
  }

  double heldHalf() const { return std::min(object_.half, held_apart_); }

  void say(bool heavier) {
    const bool second =
        heavier ? felt_[1].weight > felt_[0].weight : felt_[1].stiffness > felt_[0].stiffness;
    word_.kind = Hand::WordKind::grade;
    word_.hardness = second ? 2 : 1;
  }

  SqueezingSkill skill_;
  VisibleObject object_;
  Pose X_ET_;
  RandomStream judgement_, noise_;
  std::array<Tremor, 2> tremors_;
  std::array<Finger, 2> fingers_;
  std::int64_t next_thought_ns_ = 0;
  SqueezeStep step_ = SqueezeStep::rest;
  int trial_ = 0, thing_ = 0;
  double in_,
      up_ = 0;  ///< of each finger's tip from the object's middle; above where it rests: wanted, m
  double from_in_ = 0, from_up_ = 0, since_s_ = 0;
  double air_N_ = 0, held_N_ = 0, held_apart_ = 0, weight_sum_ = 0, weight_count_ = 0;
  std::array<Felt, 2> felt_;
  Hand::Word word_;
};

std::array<std::unique_ptr<Hand>, 2> squeezingHands(const SqueezingSkill& skill,
                                                    const VisibleObject& object, const Pose& X_ET,
                                                    std::uint64_t seed) {
  const auto mind = std::make_shared<SqueezingMind>(skill, object, X_ET, seed);
  auto fingers = fingersOf(mind, skill.grip, 2);
  return {std::move(fingers[0]), std::move(fingers[1])};
}

}  // namespace palpa::twin
