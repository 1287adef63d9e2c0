#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "apps/twin/beat_sense.h"
#include "apps/twin/feeling_hands.h"

namespace palpa::twin {
namespace {

using Question = runtime::Displayed::Question;

/// A smooth beat: up within 0.1 s, down by 0.4 s.
double beatAt(double t) {
  if (t < 0 || t > 0.4) return 0;
  const double u = t < 0.1 ? 1 - t / 0.1 : (t - 0.1) / 0.3;
  return (1 - u * u) * (1 - u * u) * (1 - u * u);
}

/// A spring with a beating artery `beside` the middle, felt within some millimetres; the screen
/// leads through the trial as the task does.
class BeatingWorld {
 public:
  BeatingWorld(double beside, double interval, bool adjusts = true)
      : beside_(beside), interval_(interval) {
    skill_.press = 0.5;
    skill_.step = 0.003;
    skill_.reach = 0.015;
    skill_.listens_s = 2.8;
    skill_.beat = {0.01, 0.15, 0.1};
    skill_.adjusts = adjusts;
    hand_ = pulseHand(skill_, Pose::Identity(), Pose::Identity(), 3);
    seen_.running = true;
    seen_.trial = 1;
    seen_.question = Question::pulse_place;
    at_.translation() = Vec3(0, 0, 0.05);
  }
  void run(double seconds) {
    for (int i = 0; i < static_cast<int>(1000 * seconds); ++i) step();
  }

  runtime::Displayed seen_;
  double marked_ = 1e3, most_N_ = 0;
  int delivered_ = 0;
  std::vector<int> says_;

 private:
  void step() {
    constexpr double kStiff = 300;
    const double t = 1e-9 * static_cast<double>(now_ns_), phase = std::fmod(t, interval_);
    const double n = std::max(-kStiff * at_.translation().z(), 0.0);
    const double d = (at_.translation().x() - beside_) / 0.005;
    const double beat =
        n > 0.1 ? 0.15 / (1 + d * d) * beatAt(phase) * std::max(1 - std::abs(n / 0.6 - 1), 0.0) : 0;
    most_N_ = std::max(most_N_, n);
    const bool counting = seen_.question == Question::pulse_count;
    if (counting && phase < 1e-3) ++delivered_;
    seen_.X_AT = at_;
    Hand::Senses senses;
    senses.now_ns = now_ns_ += 1'000'000;
    senses.X_DE = at_;
    senses.seen = &seen_;
    senses.f_fingers_D = Vec3(0, 0, -n - beat);
    const Hand::Action action = hand_->act(senses, 1e-3);
    at_ = action.X_DH;
    if (action.buttons) marked_ = at_.translation().x();
    if (counting && t > count_until_s_) seen_.question = Question::pulse_number;
    if (action.says.kind == Hand::WordKind::done && seen_.question == Question::pulse_place) {
      seen_.question = Question::pulse_count;
      count_until_s_ = t + 30;
    }
    if (action.says.kind != Hand::WordKind::chooses) return;
    says_.push_back(action.says.choice);
    seen_.question =
        seen_.question == Question::pulse_number ? Question::pulse_rhythm : Question::none;
    if (says_.size() == 2) seen_.running = false;
  }

  double beside_, interval_;
  PulseSkill skill_;
  std::unique_ptr<Hand> hand_;
  Pose at_ = Pose::Identity();
  std::int64_t now_ns_ = 0;
  double count_until_s_ = 0;
};

TEST(PulseHand, FindsCountsAndNamesIt) {
  for (const double beside : {-0.007, 0.0, 0.01}) {
    BeatingWorld world(beside, 0.83);
    world.run(160);
    EXPECT_NEAR(world.marked_, beside, 0.004);
    ASSERT_EQ(world.says_.size(), 2u);
    EXPECT_NEAR(world.says_[0], world.delivered_, 1);
    EXPECT_EQ(world.says_[1], 1);
    EXPECT_LT(world.most_N_, 1.2);
  }
}

TEST(PulseHand, GoesOnAfterAPauseAndStaysAwayWithoutATrial) {
  BeatingWorld world(0.003, 0.7);
  world.run(20);
  world.seen_.running = false;
  world.run(3);
  world.seen_.running = true;
  world.run(170);
  EXPECT_EQ(world.says_.size(), 2u);
  BeatingWorld idle(0, 0.7);
  idle.seen_.running = false;
  idle.run(3);
  EXPECT_EQ(idle.most_N_, 0);
}

TEST(BeatSense, NoticesEveryBeatOnceAndNoTremor) {
  BeatSense sense({0.01, 0.15, 0}, RandomStream(1, "sense"));
  sense.begin();
  int felt = 0;
  for (int i = 0; i < 3000; ++i) {
    const double t = 0.01 * i, tremor = 0.01 * std::sin(2 * std::numbers::pi * 10 * t);
    felt += sense.feel(0.6 + tremor + 0.1 * beatAt(std::fmod(t, 0.75)));
  }
  EXPECT_NEAR(felt, 40, 1);
  sense.begin();
  felt = 0;
  for (int i = 0; i < 3000; ++i)
    felt += sense.feel(0.6 + 0.01 * std::sin(2 * std::numbers::pi * 0.1 * i));
  EXPECT_EQ(felt, 0);
}

TEST(BeatSense, ARhythmIsTakenForWhatItsIntervalsSay) {
  EXPECT_EQ(rhythmBy({0.8, 0.82, 0.79, 0.8, 0.81, 0.8, 0.78, 0.8}), 1);
  EXPECT_EQ(rhythmBy({0.8, 0.8, 0.5, 1.1, 0.8, 0.8, 0.8, 0.5, 1.1, 0.8}), 2);
  EXPECT_EQ(rhythmBy({0.8, 0.8, 1.6, 0.8, 0.8, 0.8, 1.6, 0.8}), 2);  // not felt
  EXPECT_EQ(rhythmBy({0.8, 0.5, 0.6, 1.2, 0.7, 1.0, 0.55, 0.9, 1.3, 0.75, 0.6}), 3);
  EXPECT_EQ(rhythmBy({}), 1);
}

}  // namespace
}  // namespace palpa::twin
