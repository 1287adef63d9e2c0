#include "apps/twin/learning_hand.h"

#include <gtest/gtest.h>

namespace palpa::twin {
namespace {

const std::filesystem::path kOperators = PALPA_SOURCE_DIR "/assets/operators";

/// Every figure that the two files tell apart is the other's at the other end, and half way in the
/// middle.
TEST(LearningHand, TakesEveryFigureFromOneToTheOther) {
  const OperatorSkill novice = readOperatorSkill(kOperators / "novice.json"),
                      expert = readOperatorSkill(kOperators / "expert.json");
  using S = OperatorSkill;
  for (double S::*figure : {&S::tremor_rms,    &S::turn_tremor_rms, &S::look_sd,
                            &S::depth_sd,      &S::entry_sd,        &S::normal_sd,
                            &S::direction_sd,  &S::travel_speed,    &S::push_speed,
                            &S::advance_speed, &S::withdraw_speed,  &S::turn_time,
                            &S::pause,         &S::reaction,        &S::notice_puncture_N,
                            &S::notice_bone_N, &S::redirect,        &S::redirect_sd,
                            &S::guide,         &S::first_depth,     &S::vein_distance,
                            &S::search_margin}) {
    EXPECT_DOUBLE_EQ(between(novice, expert, 0).*figure, novice.*figure);
    EXPECT_NEAR(between(novice, expert, 1).*figure, expert.*figure, 1e-15);
    EXPECT_NEAR(between(novice, expert, 0.5).*figure, (novice.*figure + expert.*figure) / 2, 1e-15);
  }
  EXPECT_DOUBLE_EQ(between(novice, expert, 1).grip.stiffness, expert.grip.stiffness);
  EXPECT_DOUBLE_EQ(between(novice, expert, 0.5).grip.damping,
                   (novice.grip.damping + expert.grip.damping) / 2);
  const SearchingSkill slow = readSearchingSkill(kOperators / "search_novice.json"),
                       quick = readSearchingSkill(kOperators / "search_expert.json");
  EXPECT_EQ(between(slow, quick, 1).rounds, quick.rounds);
  EXPECT_EQ(between(slow, quick, 0.5).rounds, (slow.rounds + quick.rounds) / 2);
  EXPECT_DOUBLE_EQ(between(slow, quick, 1).jolt.least, quick.jolt.least);
  EXPECT_DOUBLE_EQ(between(slow, quick, 0.25).weber_roughness,
                   0.75 * slow.weber_roughness + 0.25 * quick.weber_roughness);
}

class Marked final : public Hand {
 public:
  explicit Marked(int trial) { grip_.mass = trial; }
  Action act(const Senses& senses, double) override {
    return {senses.X_DE, 0.1 * grip_.mass, 0, {}};
  }
  const HandGrip& grip() const override { return grip_; }

 private:
  HandGrip grip_;
};

TEST(LearningHand, ChangesWhenATrialBeginsAndNotBefore) {
  int made = 0;
  LearningHand hand([&](int trial) {
    ++made;
    return std::make_unique<Marked>(trial);
  });
  runtime::Displayed shown;
  Hand::Senses senses;
  senses.seen = &shown;
  const auto trialOfHand = [&] {
    return static_cast<int>(std::lround(hand.act(senses, 0.001).plunger * 10));
  };
  EXPECT_EQ(trialOfHand(), 1);
  shown.trial = 1;
  shown.running = true;
  EXPECT_EQ(trialOfHand(), 1);
  shown.running = false;
  shown.trial = 2;
  EXPECT_EQ(trialOfHand(), 1);  // the first hand takes the needle out
  shown.running = true;
  EXPECT_EQ(trialOfHand(), 2);
  EXPECT_EQ(hand.grip().mass, 2);
  senses.seen = nullptr;
  EXPECT_EQ(trialOfHand(), 2);
  EXPECT_EQ(made, 2);
}

}  // namespace
}  // namespace palpa::twin
