#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>

#include "anatomy/base/random.h"
#include "apps/twin/feeling_hands.h"
#include "apps/twin/hand_motion.h"
#include "apps/twin/hand_senses.h"

namespace palpa::twin {
namespace {

constexpr std::int64_t kConsider_ns = 10'000'000, kLooks_ns = 100'000'000;  // 100 Hz, 10 Hz
constexpr double kConsider_s = 0.01;
constexpr double kTouchSharp = 0.3;  // touch is not sharper than about 25 ms
constexpr double kHover = 0.008;     // m above the surface: where the hand moves in the air
constexpr double kComes_s = 0.8, kLifts_s = 0.4, kBetween_s = 0.5, kWord_s = 0.2;
constexpr double kDownSpeed = 0.01;     // m/s
constexpr double kFarthestDown = 0.01;  // m: a hand that feels nothing stops there
constexpr double kPressCorrection =
    0.01;  // m/(N s): how fast a wrong pressure is corrected [chosen]
constexpr double kFrom = 0.2, kTo = 0.8;  // of a stroke: between them it slides evenly
constexpr double kLeastRub = 0.01;        // of the pressure: less is felt as that
constexpr int kAirStrokes = 2;

/// What a number of strokes felt like.
struct FeltStrokes {
  double along_N = 0, pressed_N = 0;  ///< sums
  int count = 0;
  double along() const { return count > 0 ? along_N / count : 0; }
  double pressed() const { return count > 0 ? pressed_N / count : 0; }
};

class StrokingHand final : public Hand {
 public:
  StrokingHand(const StrokingSkill& skill, const Pose& X_AP, const Pose& X_ET, std::uint64_t seed)
      : skill_(skill),
        X_AP_(X_AP),
        X_ET_(X_ET),
        judgement_(seed, "stroking.judgement"),
        noise_(seed, "stroking.noise"),
        tremor_(skill.tremor_rms, RandomStream(seed, "stroking.tremor")) {}

  Action act(const Senses& senses, double dt) override {
    look(senses, dt);
    if (!bearings_.taken()) return {senses.X_DE, 0, 0, {}};
    if (senses.now_ns >= next_thought_ns_) {
      next_thought_ns_ = senses.now_ns + kConsider_ns;
      think(senses);
    }
    Action action;
    const Mat3 down = Eigen::AngleAxisd(std::numbers::pi, Vec3::UnitX()).toRotationMatrix();
    action.X_DH =
        bearings_.X_DA() * X_AP_ * makePose(down, at_P_ + tremor_.next(dt)) * X_ET_.inverse();
    std::swap(action.says, word_);
    return action;
  }
  const HandGrip& grip() const override { return skill_.grip; }

 private:
  enum class StrokingStep { rest, come, air, down, stroke, lift, between, say };

  void look(const Senses& senses, double dt) {
    const Vec3 p_D = senses.X_DE.translation();
    speed_ += ((p_D - p_last_D_).norm() / dt - speed_) * std::min(1.0, dt / 0.05);
    p_last_D_ = p_D;
    const bool first = !bearings_.taken();
    if (senses.seen && (first || senses.now_ns - last_look_ns_ >= kLooks_ns)) {
      last_look_ns_ = senses.now_ns;
      bearings_.look(senses.seen->X_AT, senses.X_DE * X_ET_, skill_.look_sd, speed_, noise_);
    }
    if (!bearings_.taken()) return;
    const Pose X_PD = (bearings_.X_DA() * X_AP_).inverse();
    if (first) at_P_ = X_PD * (senses.X_DE * X_ET_).translation();
    felt_P_ += kTouchSharp * dt / kConsider_s * (X_PD.rotation() * senses.f_fingers_D - felt_P_);
  }

  void go(StrokingStep step, double now_s) {
    step_ = step;
    since_s_ = now_s;
    from_P_ = at_P_;
  }
  /// Minimum jerk from where the step began; true: it is there.
  bool moved(double now_s, double seconds, const Vec3& to_P) {
    const MinJerk way(makePose(Mat3::Identity(), from_P_), makePose(Mat3::Identity(), to_P),
                      since_s_, seconds);
    at_P_ = way.at(now_s).translation();
    return way.done(now_s);
  }
  Vec3 start() const { return {-skill_.stroke_length / 2, 0, kHover}; }

  /// To and fro along x, and what that feels like where it slides evenly; true: it was enough.
  bool stroked(double now_s, int strokes, FeltStrokes* felt) {
    const double each_s = skill_.stroke_length / skill_.stroke_speed, t = now_s - since_s_;
    const int number = std::min(static_cast<int>(t / each_s), strokes - 1);
    const double u = std::clamp(t / each_s - number, 0.0, 1.0), way = number % 2 == 0 ? 1 : -1;
    const double s = u * u * u * (10 + u * (6 * u - 15));
    at_P_.x() = way * (s - 0.5) * skill_.stroke_length;
    if (u >= kFrom && u <= kTo) {
      felt->along_N += way * felt_P_.x();
      felt->pressed_N -= felt_P_.z();
      ++felt->count;
    }
    return t >= each_s * strokes;
  }

  void begin(int trial, double now_s) {
    trial_ = trial;
    answered_ = false;
    thing_ = 0;
    judged_.clear();
    says_.clear();
    air_ = {};
    go(StrokingStep::come, now_s);
  }

  void think(const Senses& senses) {
    if (!senses.seen) return;
    const double now_s = 1e-9 * static_cast<double>(senses.now_ns);
    const runtime::Displayed& seen = *senses.seen;
    if (seen.running && seen.trial != trial_) return begin(seen.trial, now_s);
    if (!seen.running) return leave(now_s);
    if (step_ == StrokingStep::rest && !answered_)  // after a pause
      go(says_.empty() ? StrokingStep::come : StrokingStep::say, now_s);
    step(seen, now_s);
  }

  /// The trial is over, or paused: off the surface.
  void leave(double now_s) {
    if (step_ != StrokingStep::rest && step_ != StrokingStep::lift) go(StrokingStep::lift, now_s);
    if (step_ == StrokingStep::lift && moved(now_s, kLifts_s, {from_P_.x(), from_P_.y(), kHover}))
      step_ = StrokingStep::rest;
  }

  void step(const runtime::Displayed& seen, double now_s) {
    switch (step_) {
      case StrokingStep::rest:
        return;
      case StrokingStep::come:
        if (!moved(now_s, kComes_s, start())) return;
        return go(air_.count == 0 ? StrokingStep::air : StrokingStep::down, now_s);
      case StrokingStep::air:  // what it takes to move the tool is not the surface's
        if (stroked(now_s, kAirStrokes, &air_)) go(StrokingStep::down, now_s);
        return;
      case StrokingStep::down:
        at_P_ = Vec3(start().x(), 0, at_P_.z() - kDownSpeed * kConsider_s);
        if (pressed() < skill_.press && at_P_.z() > -kFarthestDown) return;
        strokes_ = {};
        return go(StrokingStep::stroke, now_s);
      case StrokingStep::stroke:
        at_P_.z() =
            std::max(at_P_.z() + kPressCorrection * (pressed() - skill_.press) * kConsider_s,
                     -kFarthestDown);
        if (!stroked(now_s, skill_.strokes, &strokes_)) return;
        judged_.resize(thing_ + 1);
        judged_[thing_] = judged();
        return go(StrokingStep::lift, now_s);
      case StrokingStep::lift:
        if (moved(now_s, kLifts_s, {from_P_.x(), from_P_.y(), kHover})) next(seen, now_s);
        return;
      case StrokingStep::between:
        if (now_s - since_s_ >= kBetween_s) go(StrokingStep::come, now_s);
        return;
      case StrokingStep::say:
        return say(now_s);
    }
  }

  double pressed() const { return -felt_P_.z() - air_.pressed(); }

  /// Of what is felt, what rubs by what presses.
  double judged() {
    const double rubs = strokes_.along() - air_.along(),
                 presses = std::max(strokes_.pressed() - air_.pressed(), kLeastRub);
    return std::max(rubs / presses, kLeastRub) *
           std::exp(skill_.weber_friction * judgement_.normal());
  }

  void next(const runtime::Displayed& seen, double now_s) {
    if (judged_.size() <= thing_) return go(StrokingStep::come, now_s);  // it went on too soon
    if (static_cast<int>(thing_) + 1 < seen.things) {
      ++thing_;
      word_.kind = WordKind::done;  // the next one
      return go(StrokingStep::between, now_s);
    }
    says_.resize(judged_.size());
    std::iota(says_.begin(), says_.end(), 1);
    std::stable_sort(says_.begin(), says_.end(), [this](int a, int b) {
      return judged_[static_cast<std::size_t>(a - 1)] < judged_[static_cast<std::size_t>(b - 1)];
    });
    if (seen.question == runtime::Displayed::Question::rougher) says_ = {says_.back()};
    go(StrokingStep::say, now_s);
  }

  /// One number after the other.
  void say(double now_s) {
    if (now_s - since_s_ < kWord_s) return;
    word_.kind = WordKind::chooses;
    word_.choice = says_.front();
    says_.erase(says_.begin());
    answered_ = says_.empty();
    go(answered_ ? StrokingStep::rest : StrokingStep::say, now_s);
  }

  StrokingSkill skill_;
  Pose X_AP_, X_ET_;
  RandomStream judgement_, noise_;
  Tremor tremor_;
  Bearings bearings_;
  std::int64_t last_look_ns_ = -kLooks_ns, next_thought_ns_ = 0;
  Vec3 p_last_D_ = Vec3::Zero(), felt_P_ = Vec3::Zero();
  double speed_ = 0;
  StrokingStep step_ = StrokingStep::rest;
  double since_s_ = 0;
  Vec3 at_P_ = Vec3::Zero(), from_P_ = Vec3::Zero();  ///< where the tip is wanted; a step began
  int trial_ = 0;
  bool answered_ = false;
  FeltStrokes air_, strokes_;
  std::size_t thing_ = 0;       ///< which surface is felt
  std::vector<double> judged_;  ///< of each
  std::vector<int> says_;       ///< still to be said
  Word word_;
};

}  // namespace

std::unique_ptr<Hand> strokingHand(const StrokingSkill& skill, const Pose& X_AP, const Pose& X_ET,
                                   std::uint64_t seed) {
  return std::make_unique<StrokingHand>(skill, X_AP, X_ET, seed);
}

}  // namespace palpa::twin
