#include <gtest/gtest.h>

#include <vector>

#include "apps/runtime/clock.h"
#include "apps/twin/virtual_bench.h"

/// Who looks at an old picture waits for a new one.
namespace palpa::twin {
namespace {

using runtime::kMillisecond;

/// Goes to the right with its own time, 1 m/s, and says so.
class GoingHand final : public Hand {
 public:
  explicit GoingHand(std::vector<std::int64_t>& times) : times_(times) {}
  Action act(const Senses& senses, double) override {
    times_.push_back(senses.now_ns);
    Action action;
    action.X_DH.translation().x() = 1e-9 * static_cast<double>(senses.now_ns);
    action.buttons = 1;
    action.says.kind = WordKind::done;
    return action;
  }
  const HandGrip& grip() const override { return grip_; }

 private:
  std::vector<std::int64_t>& times_;
  HandGrip grip_;
};

struct WaitingHand : testing::Test {
  /// A millisecond of the bench, with the picture of `seen_ns`; negative: none yet.
  Hand::Action step(std::int64_t now_ns, std::int64_t seen_ns) {
    runtime::Displayed seen;
    seen.t_ns = seen_ns;
    return tool.act(seen_ns < 0 ? nullptr : &seen, now_ns, 1e-3);
  }

  std::vector<std::int64_t> times;  ///< at which the hand acted, its own
  runtime::ChannelDevice device{{}, runtime::TimeMode::real};
  HeldTool tool{HeldToolSetup{.hand = std::make_unique<GoingHand>(times),
                              .truth = {},
                              .X_WD = Pose::Identity(),
                              .X_ET = Pose::Identity(),
                              .X_DE_start = Pose::Identity(),
                              .device = &device,
                              .faults = {}}};
};

TEST_F(WaitingHand, ActsInEveryStepOnPicturesAsOldAsInVirtualTime) {
  constexpr std::int64_t kFrame = 33'333'333, kShown = 33'000'000;
  for (std::int64_t now = 0; now < 500 * kMillisecond; now += kMillisecond)
    step(now, now < kShown ? -1 : (now - kShown) / kFrame * kFrame);
  ASSERT_EQ(times.size(), 500u);
  for (std::size_t i = 0; i < times.size(); ++i)
    ASSERT_EQ(times[i], static_cast<std::int64_t>(i) * kMillisecond) << "the session's time";
}

TEST_F(WaitingHand, HoldsStillAndIsSilentUntilANewPictureComesAndGoesOnWhereItWas) {
  std::int64_t now = 0;
  for (; now <= HeldTool::kOldPicture_ns; now += kMillisecond) step(now, 0);
  const std::size_t before = times.size();
  const double held = 1e-9 * static_cast<double>(times.back());
  for (; now < 3000 * kMillisecond; now += kMillisecond) {
    const Hand::Action action = step(now, 0);
    ASSERT_EQ(action.X_DH.translation().x(), held);
    ASSERT_EQ(action.buttons, 1u) << "what is held is held";
    ASSERT_EQ(action.says.kind, Hand::WordKind::none) << "nothing is said twice";
  }
  EXPECT_EQ(times.size(), before);
  const Hand::Action next = step(now, now - 33 * kMillisecond);
  EXPECT_EQ(times.back(), times[before - 1] + kMillisecond) << "no time has passed for the hand";
  EXPECT_NEAR(next.X_DH.translation().x(), held + 1e-3, 1e-9);
}

TEST_F(WaitingHand, DoesNotJumpAfterAComputerThatStoodStill) {
  step(0, 0);
  step(kMillisecond, 0);
  step(2000 * kMillisecond, 1999 * kMillisecond);  // no step for two seconds
  EXPECT_LE(times.back(), 6 * kMillisecond) << "as far as the mechanics have gone";
  step(2001 * kMillisecond, 1999 * kMillisecond);
  EXPECT_EQ(times[3], times[2] + kMillisecond);
}

}  // namespace
}  // namespace palpa::twin
