#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "apps/twin/feeling_hands.h"

namespace palpa::twin {
namespace {

using Question = runtime::Displayed::Question;

/// Surfaces of known friction under a hand that is where it wants to be; the device rubs in the
/// air, too.
class StrokedWorld {
 public:
  explicit StrokedWorld(std::vector<double> mu, double weber = 0) : mu_(std::move(mu)) {
    skill_.press = 0.5;
    skill_.stroke_speed = 0.03;
    skill_.stroke_length = 0.02;
    skill_.strokes = 2;
    skill_.weber_friction = weber;
    hand_ = strokingHand(skill_, Pose::Identity(), Pose::Identity(), 3);
    seen_.running = true;
    seen_.trial = 1;
    seen_.things = static_cast<int>(mu_.size());
    seen_.question = mu_.size() > 2 ? Question::order : Question::rougher;
    at_.translation() = Vec3(0, 0, 0.05);
  }

  void run(double seconds) {
    for (int i = 0; i < static_cast<int>(1000 * seconds); ++i) step();
  }
  void step() {
    constexpr double kStep = 1e-3, kStiff = 200, kDeviceRubs = 0.08;  // s, N/m, N
    const double n = std::max(-kStiff * at_.translation().z(), 0.0), way = moved_.x() > 1e-9    ? 1
                                                                           : moved_.x() < -1e-9 ? -1
                                                                                                : 0;
    most_N_ = std::max(most_N_, n);
    seen_.X_AT = at_;
    Hand::Senses senses;
    senses.now_ns = now_ns_ += 1'000'000;
    senses.X_DE = at_;
    senses.seen = &seen_;
    senses.f_fingers_D = Vec3(way * (mu_[thing_] * n + kDeviceRubs), 0, -n);
    const Hand::Action action = hand_->act(senses, kStep);
    moved_ = action.X_DH.translation() - at_.translation();
    at_ = action.X_DH;
    if (action.says.kind == Hand::WordKind::done) {
      EXPECT_EQ(n, 0) << "the surface changes under the hand";
      thing_ = (thing_ + 1) % mu_.size();
    }
    if (action.says.kind == Hand::WordKind::chooses) says_.push_back(action.says.choice);
  }

  runtime::Displayed seen_;
  double most_N_ = 0;
  std::vector<int> says_;

 private:
  std::vector<double> mu_;
  StrokingSkill skill_;
  std::unique_ptr<Hand> hand_;
  Pose at_ = Pose::Identity();
  Vec3 moved_ = Vec3::Zero();
  std::int64_t now_ns_ = 0;
  std::size_t thing_ = 0;
};

TEST(StrokingHand, SaysWhichIsRougherWhicheverComesFirst) {
  for (const bool second : {false, true}) {
    StrokedWorld world(second ? std::vector<double>{0.30, 0.33} : std::vector<double>{0.33, 0.30});
    world.run(30);
    EXPECT_EQ(world.says_, std::vector<int>{second ? 2 : 1});
    EXPECT_NEAR(world.most_N_, 0.5, 0.15);
  }
}

TEST(StrokingHand, PutsSeveralInOrderFromTheSmoothest) {
  StrokedWorld world({0.4, 0.2, 0.8, 0.3});
  world.run(60);
  EXPECT_EQ(world.says_, (std::vector<int>{2, 4, 1, 3}));
}

/// What was felt before a pause is not taken for the next surface.
TEST(StrokingHand, GoesOnAfterAPause) {
  for (const double until : {2.0, 4.0, 5.5, 7.0, 9.0}) {
    StrokedWorld world({0.4, 0.2, 0.8, 0.3});
    world.run(until);
    world.seen_.running = false;
    world.run(2);
    world.seen_.running = true;
    world.run(60);
    EXPECT_EQ(world.says_, (std::vector<int>{2, 4, 1, 3})) << until;
  }
}

TEST(StrokingHand, WithoutATrialItStaysAway) {
  StrokedWorld world({0.4, 0.2});
  world.seen_.running = false;
  world.run(5);
  EXPECT_EQ(world.most_N_, 0);
  EXPECT_TRUE(world.says_.empty());
}

}  // namespace
}  // namespace palpa::twin
