#include <gtest/gtest.h>

#include <memory>
#include <string>

#include "fault_judge.h"
#include "haptics/loop/tick.h"
#include "tests/support/counts.h"

/// Random faults on the whole tick, one after the other and one into the other, while a tool is
/// pushed into tissue and bone. A judge that sees only the inputs says when there must be no force.
namespace palpa::haptics {
namespace {

constexpr int kFaultsInEpisode = 20;

struct Episode {
  FaultyWorld world;
  TickState state;
  FaultJudge& judge;
  FlightRecord last;

  void step(Fault fault) {
    world.advance(fault);
    last = tick(world.config, state, world.reading, world.offers ? &world.offered : nullptr,
                world.commands, world.now, world.sensed, world.floor());
    judge.judge(world, state, last);
  }
  void steps(Fault fault, int count) {
    for (int i = 0; i < count; ++i) step(fault);
  }
  /// Nothing that was sent may stay in the state: a sound world gives a sound force again.
  void recover() {
    world.target = -0.001;
    world.cues = false;
    steps(Fault::none, 1000);
    step(Fault::disarmed);
    step(Fault::trial_changes);
    world.target = 0.0022;
    steps(Fault::none, 400);
    EXPECT_GT(unpack(last.f_command_D).norm(), 0.03)
        << "after the faults; cause " << name(last.safety);
  }
};

int lengthOf(Fault fault, Dice& dice) {
  if (fault == Fault::no_snapshots || fault == Fault::snapshot_damaged)
    return 1 + dice.below(dice.chance(0.1) ? 800 : 40);
  return 1 + dice.below(dice.chance(0.1) ? 100 : 12);
}

void runEpisode(Dice& dice, ContactMode contact_mode, bool cues, FaultJudge& sum) {
  FaultJudge judge;
  auto e = std::make_unique<Episode>(Episode{FaultyWorld(dice, contact_mode, cues), {}, judge, {}});
  e->steps(Fault::none, 100);
  for (int k = 0; k < kFaultsInEpisode; ++k) {
    const auto fault = static_cast<Fault>(1 + dice.below(kFaultCount - 1));
    e->world.target = dice.uniform(-0.001, 0.012);
    e->world.begin(fault);
    e->steps(fault, lengthOf(fault, dice));
    e->world.end();
    e->steps(Fault::none, dice.below(60));
    if (dice.chance(0.5)) e->step(Fault::disarmed);  // a stop would else last to the end
  }
  e->recover();
  for (int c = 0; c < kSafetyCauseCount; ++c) sum.seen[c] += judge.seen[c];
  sum.taken_away += judge.taken_away;
  sum.pushed += judge.pushed;
}

bool mayHappen(SafetyCause cause, ContactMode contact_mode) {
  if (cause == SafetyCause::stale_geometry || cause == SafetyCause::corrupt_geometry)
    return contact_mode == ContactMode::needle || contact_mode == ContactMode::probe;
  return cause != SafetyCause::no_sensor || contact_mode == ContactMode::sensed_object;
}

void campaign(ContactMode contact_mode, std::uint64_t seed, bool cues = false) {
  // A sanitizer takes seventy times as long over them.
  const int faults = test::counted(test::kSanitized ? 6'000 : 20'000, 100'000) / 2;
  Dice dice(seed);
  FaultJudge sum;
  for (int i = 0; i < faults / kFaultsInEpisode; ++i) {
    runEpisode(dice, contact_mode, cues, sum);
    if (testing::Test::HasFailure()) FAIL() << "in episode " << i;
  }
  EXPECT_GT(sum.pushed, 5 * faults) << "a campaign without force proves nothing";
  EXPECT_GT(sum.taken_away, faults / 10);
  for (int c = 0; c < kSafetyCauseCount; ++c) {
    const auto cause = static_cast<SafetyCause>(c);
    EXPECT_EQ(sum.seen[c] > 20, mayHappen(cause, contact_mode))
        << name(cause) << ": " << sum.seen[c];
  }
}

TEST(FaultCampaign, TheNeedlesForceStaysWithinItsLimitsWhateverComesIn) {
  campaign(ContactMode::needle, 20'260'101);
}

TEST(FaultCampaign, TheProbesForceStaysWithinItsLimitsWhateverComesIn) {
  campaign(ContactMode::probe, 20'260'102);
}

TEST(FaultCampaign, TheForceAddedToARealThingStaysWithinItsLimitsWhateverComesIn) {
  campaign(ContactMode::sensed_object, 20'260'103);
}

/// Cues are no exception: every limit, every fault, every cause holds with all of them on, strong
/// and stiff as a task's file may say.
TEST(FaultCampaign, TheNeedlesForceWithEveryCueStaysWithinItsLimits) {
  campaign(ContactMode::needle, 20'260'104, true);
}
TEST(FaultCampaign, TheForceAddedToARealThingWithEveryCueStaysWithinItsLimits) {
  campaign(ContactMode::sensed_object, 20'260'105, true);
}
TEST(FaultCampaign, TheFloorsForceWithEveryCueStaysWithinItsLimits) {
  campaign(ContactMode::floor, 20'260'106, true);
}

}  // namespace
}  // namespace palpa::haptics
