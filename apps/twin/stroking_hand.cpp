#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>

#include "anatomy/base/random.h"
#include "apps/twin/feeling_hands.h"
#include "apps/twin/upright_tool.h"

namespace palpa::twin {
namespace {

constexpr double kHover = 0.008;  // m above the surface: where the hand moves in the air
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
        tool_(X_AP, X_ET, skill.look_sd, RandomStream(seed, "stroking.noise"),
              Tremor(skill.tremor_rms, RandomStream(seed, "stroking.tremor"))),
        judgement_(seed, "stroking.judgement") {}

  Action act(const Senses& senses, double dt) override {
    if (!tool_.look(senses, dt, true)) return {senses.X_DE, 0, 0, {}};
    if (tool_.thinks(senses)) think(senses);
    Action action;
    action.X_DH = tool_.wanted(dt);
    std::swap(action.says, word_);
    return action;
  }
  const HandGrip& grip() const override { return skill_.grip; }

 private:
  enum class StrokingStep { rest, come, air, down, stroke, lift, between, say };

  void go(StrokingStep step, double now_s) {
    step_ = step;
    tool_.begin(now_s);
  }
  Vec3 start() const { return {-skill_.stroke_length / 2, 0, kHover}; }

  /// To and fro along x, and what that feels like where it slides evenly; true: it was enough.
  bool stroked(double now_s, int strokes, FeltStrokes* felt) {
    const double each_s = skill_.stroke_length / skill_.stroke_speed, t = now_s - tool_.since_s;
    const int number = std::min(static_cast<int>(t / each_s), strokes - 1);
    const double u = std::clamp(t / each_s - number, 0.0, 1.0), way = number % 2 == 0 ? 1 : -1;
    const double s = u * u * u * (10 + u * (6 * u - 15));
    tool_.at_P.x() = way * (s - 0.5) * skill_.stroke_length;
    if (u >= kFrom && u <= kTo) {
      felt->along_N += way * tool_.felt_P().x();
      felt->pressed_N -= tool_.felt_P().z();
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
    if (step_ == StrokingStep::lift &&
        tool_.moved(now_s, kLifts_s, {tool_.from_P.x(), tool_.from_P.y(), kHover}))
      step_ = StrokingStep::rest;
  }

  void step(const runtime::Displayed& seen, double now_s) {
    switch (step_) {
      case StrokingStep::rest:
        return;
      case StrokingStep::come:
        if (!tool_.moved(now_s, kComes_s, start())) return;
        return go(air_.count == 0 ? StrokingStep::air : StrokingStep::down, now_s);
      case StrokingStep::air:  // what it takes to move the tool is not the surface's
        if (stroked(now_s, kAirStrokes, &air_)) go(StrokingStep::down, now_s);
        return;
      case StrokingStep::down:
        tool_.at_P = Vec3(start().x(), 0, tool_.at_P.z() - kDownSpeed * UprightTool::kThinks_s);
        if (pressed() < skill_.press && tool_.at_P.z() > -kFarthestDown) return;
        strokes_ = {};
        return go(StrokingStep::stroke, now_s);
      case StrokingStep::stroke:
        tool_.at_P.z() = std::max(
            tool_.at_P.z() + kPressCorrection * (pressed() - skill_.press) * UprightTool::kThinks_s,
            -kFarthestDown);
        if (!stroked(now_s, skill_.strokes, &strokes_)) return;
        judged_.resize(thing_ + 1);
        judged_[thing_] = judged();
        return go(StrokingStep::lift, now_s);
      case StrokingStep::lift:
        if (tool_.moved(now_s, kLifts_s, {tool_.from_P.x(), tool_.from_P.y(), kHover}))
          next(seen, now_s);
        return;
      case StrokingStep::between:
        if (now_s - tool_.since_s >= kBetween_s) go(StrokingStep::come, now_s);
        return;
      case StrokingStep::say:
        return say(now_s);
    }
  }

  double pressed() const { return -tool_.felt_P().z() - air_.pressed(); }

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
    if (now_s - tool_.since_s < kWord_s) return;
    word_.kind = WordKind::chooses;
    word_.choice = says_.front();
    says_.erase(says_.begin());
    answered_ = says_.empty();
    go(answered_ ? StrokingStep::rest : StrokingStep::say, now_s);
  }

  StrokingSkill skill_;
  UprightTool tool_;
  RandomStream judgement_;
  StrokingStep step_ = StrokingStep::rest;
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
