#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "anatomy/base/random.h"
#include "apps/twin/beat_sense.h"
#include "apps/twin/feeling_hands.h"
#include "apps/twin/upright_tool.h"

namespace palpa::twin {
namespace {

using Question = runtime::Displayed::Question;

constexpr double kPulseHover = 0.006;  // m above the surface: where the hand moves in the air
constexpr double kPulseComes_s = 0.8, kNextPlace_s = 0.35, kPulseLifts_s = 0.25, kPulseWord_s = 0.5,
                 kSettles_s = 0.9, kHoldsButton_s = 0.3;
constexpr double kPulseDown = 0.01, kPulseDeepest = 0.012;  // m/s; m: who feels nothing stops there
// m/(N s): how fast a wrong pressure is corrected, at first and while a pulse is listened for
constexpr double kPressesAtOnce = 0.01, kPressesOn = 0.001;
constexpr double kTriedPressures[] = {0.8, 1.0, 1.25, 1.5};  // times the first one

/// A place where beats were waited for, m across, and how strong they were, N.
struct FeltPlace {
  double x = 0, beat_N = 0;
};

/// Where they were strongest: the middle of all places with more than half of the most, weighted by
/// the squares of what was felt, since no single place is sure.
double strongestPlace(const std::vector<FeltPlace>& places) {
  double most = 0, sum = 0, weight = 0;
  for (const FeltPlace& place : places) most = std::max(most, place.beat_N);
  for (const FeltPlace& place : places) {
    if (place.beat_N <= 0.5 * most) continue;
    weight += place.beat_N * place.beat_N;
    sum += place.beat_N * place.beat_N * place.x;
  }
  return weight > 0 ? sum / weight : 0;
}

/// Places from the middle outward, to either side in turn, m.
std::vector<double> placesAcross(double step, double reach) {
  std::vector<double> places{0};
  for (double d = step; d <= reach + 1e-9; d += step) {
    places.push_back(d);
    places.push_back(-d);
  }
  return places;
}

class PulseHand final : public Hand {
 public:
  PulseHand(const PulseSkill& skill, const Pose& X_AP, const Pose& X_ET, std::uint64_t seed)
      : skill_(skill),
        tool_(X_AP, X_ET, skill.look_sd, RandomStream(seed, "pulse.noise"),
              Tremor(skill.tremor_rms, RandomStream(seed, "pulse.tremor"))),
        places_(placesAcross(skill.step, skill.reach)),
        judgement_(seed, "pulse.judgement"),
        sense_(skill.beat, RandomStream(seed, "pulse.sense")) {}

  Action act(const Senses& senses, double dt) override {
    if (!tool_.look(senses, dt, step_ == PulseStep::rest || step_ == PulseStep::come))
      return {senses.X_DE, 0, 0, {}};
    if (tool_.thinks(senses)) think(senses);
    Action action;
    action.X_DH = tool_.wanted(dt);
    action.buttons = step_ == PulseStep::mark ? 1 : 0;
    std::swap(action.says, word_);
    return action;
  }
  const HandGrip& grip() const override { return skill_.grip; }

 private:
  enum class PulseStep { rest, come, down, settle, listen, lift, mark, wait, count, number, done };
  /// What it goes down for: to find the pulse, to find the pressure, to count.
  enum class PulseAim { place, pressure, count };

  void go(PulseStep step, double now_s) {
    step_ = step;
    tool_.begin(now_s);
  }
  double pressed() const { return -tool_.felt_P().z() - air_N_; }
  void press(double gain) {
    tool_.at_P.z() = std::max(
        tool_.at_P.z() + gain * (pressed() - want_N_) * UprightTool::kThinks_s, -kPulseDeepest);
  }

  void begin(int trial, double now_s) {
    trial_ = trial;
    aim_ = PulseAim::place;
    at_place_ = 0;
    x_ = places_.front();
    want_N_ = best_N_ = skill_.press;
    best_beat_N_ = 0;
    felt_.clear();
    tried_ = 0;
    counted_ = 0;
    beats_s_.clear();
    go(PulseStep::come, now_s);
  }

  void think(const Senses& senses) {
    if (!senses.seen) return;
    const double now_s = 1e-9 * static_cast<double>(senses.now_ns);
    const runtime::Displayed& seen = *senses.seen;
    if (seen.running && seen.trial != trial_) return begin(seen.trial, now_s);
    if (!seen.running) return leave(now_s);
    if (step_ == PulseStep::rest || step_ == PulseStep::done)  // after a pause
      go(PulseStep::come, now_s);
    step(seen, now_s);
  }

  /// The trial is over, or paused: off the surface.
  void leave(double now_s) {
    if (step_ == PulseStep::rest) return;
    if (step_ != PulseStep::done) go(PulseStep::done, now_s);
    if (tool_.moved(now_s, kPulseLifts_s, {tool_.from_P.x(), tool_.from_P.y(), kPulseHover}))
      step_ = PulseStep::rest;
  }

  void step(const runtime::Displayed& seen, double now_s) {
    switch (step_) {
      case PulseStep::rest:
        return;
      case PulseStep::come:
        if (!tool_.moved(now_s, at_place_ == 0 ? kPulseComes_s : kNextPlace_s,
                         {x_, 0, kPulseHover}))
          return;
        air_N_ = -tool_.felt_P().z();
        return go(seen.question == Question::pulse_number || seen.question == Question::pulse_rhythm
                      ? PulseStep::number
                      : PulseStep::down,
                  now_s);
      case PulseStep::down:
        tool_.at_P.z() -= kPulseDown * UprightTool::kThinks_s;
        if (pressed() >= want_N_ || tool_.at_P.z() <= -kPulseDeepest) go(PulseStep::settle, now_s);
        return;
      case PulseStep::settle:
        press(kPressesAtOnce);
        if (now_s - tool_.since_s < kSettles_s) return;
        sense_.begin();
        return go(aim_ == PulseAim::count ? PulseStep::mark : PulseStep::listen, now_s);
      case PulseStep::listen:
        press(kPressesOn);
        sense_.feel(pressed());
        if (now_s - tool_.since_s >= skill_.listens_s) heard(now_s);
        return;
      case PulseStep::lift:
        if (tool_.moved(now_s, kPulseLifts_s, {tool_.from_P.x(), tool_.from_P.y(), kPulseHover}))
          go(PulseStep::come, now_s);
        return;
      case PulseStep::mark:
        press(kPressesOn);
        sense_.feel(pressed());
        if (now_s - tool_.since_s < kHoldsButton_s) return;
        return go(PulseStep::wait, now_s);
      case PulseStep::wait:  // then "now I count"
        press(kPressesOn);
        sense_.feel(pressed());
        if (seen.question == Question::pulse_count) return go(PulseStep::count, now_s);
        if (now_s - tool_.since_s < kPulseWord_s) return;
        word_.kind = WordKind::done;
        tool_.since_s = now_s;
        return;
      case PulseStep::count:
        press(kPressesOn);
        if (seen.question != Question::pulse_count) return go(PulseStep::number, now_s);
        if (sense_.feel(pressed())) count(now_s);
        return;
      case PulseStep::number:
        if (tool_.moved(now_s, kPulseLifts_s, {tool_.from_P.x(), tool_.from_P.y(), kPulseHover}) &&
            now_s - tool_.since_s >= kPulseWord_s)
          say(seen, now_s);
        return;
      case PulseStep::done:
        return;
    }
  }

  /// What a place or a pressure felt like; then the next, or on with the best.
  void heard(double now_s) {
    const double beat_N = sense_.usual();
    if (aim_ == PulseAim::place) {
      felt_.push_back({x_, beat_N});
      if (++at_place_ < places_.size()) {
        x_ = places_[at_place_];
        return go(PulseStep::lift, now_s);
      }
      x_ = strongestPlace(felt_);
      aim_ = skill_.adjusts ? PulseAim::pressure : PulseAim::count;
      want_N_ = skill_.adjusts ? kTriedPressures[0] * skill_.press : skill_.press;
      return go(PulseStep::lift, now_s);
    }
    if (beat_N > best_beat_N_) {
      best_beat_N_ = beat_N;
      best_N_ = want_N_;
    }
    if (++tried_ < std::size(kTriedPressures)) {
      want_N_ = kTriedPressures[tried_] * skill_.press;
      return go(PulseStep::settle, now_s);
    }
    aim_ = PulseAim::count;
    want_N_ = best_N_;
    go(PulseStep::settle, now_s);
  }

  /// A beat that is lost in counting is lost; one is counted twice as often.
  void count(double now_s) {
    const double slip = judgement_.uniform();
    counted_ += slip < 0.5 * skill_.slips ? 0 : slip < skill_.slips ? 2 : 1;
    beats_s_.push_back(now_s);
  }

  void say(const runtime::Displayed& seen, double now_s) {
    if (seen.question == Question::pulse_number) {
      const bool digit_said = counted_ < 10 && typed_trial_ == trial_;
      word_.kind = digit_said ? WordKind::done : WordKind::chooses;  // a digit is not all of it
      word_.choice = counted_;
      typed_trial_ = trial_;
    } else if (seen.question == Question::pulse_rhythm) {
      word_.kind = WordKind::chooses;
      word_.choice = rhythmBy(remembered());
    }
    go(PulseStep::number, now_s);
  }

  std::vector<double> remembered() {
    std::vector<double> intervals;
    for (std::size_t i = 1; i < beats_s_.size(); ++i)
      intervals.push_back((beats_s_[i] - beats_s_[i - 1]) *
                          (1 + skill_.rhythm_sd * judgement_.normal()));
    return intervals;
  }

  PulseSkill skill_;
  UprightTool tool_;
  std::vector<double> places_;  ///< m across, where it is looked for
  RandomStream judgement_;
  BeatSense sense_;
  double speed_ = 0, air_N_ = 0;
  PulseStep step_ = PulseStep::rest;
  PulseAim aim_ = PulseAim::place;
  int trial_ = 0, typed_trial_ = 0;
  std::size_t at_place_ = 0, tried_ = 0;
  double x_ = 0;  ///< m, across: where it presses
  std::vector<FeltPlace> felt_;
  double want_N_ = 0, best_N_ = 0;  ///< pressures
  double best_beat_N_ = 0;          ///< the strongest so far
  int counted_ = 0;
  std::vector<double> beats_s_;  ///< when they were felt while counting
  Word word_;
};

}  // namespace

std::unique_ptr<Hand> pulseHand(const PulseSkill& skill, const Pose& X_AP, const Pose& X_ET,
                                std::uint64_t seed) {
  return std::make_unique<PulseHand>(skill, X_AP, X_ET, seed);
}

}  // namespace palpa::twin
