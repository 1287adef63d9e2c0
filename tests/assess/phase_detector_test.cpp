#include "apps/assess/needle/phases.h"

#include <gtest/gtest.h>

#include "tests/assess/motions.h"

namespace palpa::assess::test {
namespace {

using P = ProcedurePhase;

std::vector<P> sequence(const std::vector<TrialSample>& samples) {
  std::vector<P> order;
  for (const P phase : detectPhases(samples).phases)
    if (order.empty() || order.back() != phase) order.push_back(phase);
  return order;
}

/// Hand tremor as a 10 Hz ellipse: amplitude 140 um (100 um rms an axis) and 0.7 degrees (0.5 rms).
std::vector<TrialSample> trembling(std::vector<TrialSample> samples, double angle = 0.7 * kDeg) {
  for (TrialSample& s : samples) {
    const double c = std::cos(2 * M_PI * 10 * s.t_s), n = std::sin(2 * M_PI * 10 * s.t_s);
    s.tip_A += 140e-6 * Vec3(c, n, 0.7 * c);
    s.depth += 140e-6 * n;
    s.axis_A = (s.axis_A + angle * Vec3(n, 0.5 * c, c)).normalized();
  }
  return samples;
}

TEST(PhaseDetector, TextbookTrialGoesThroughAllPhasesOnce) {
  EXPECT_EQ(sequence(textbook().samples()),
            (std::vector<P>{P::approach, P::puncture, P::reorient, P::advance}));
}

TEST(PhaseDetector, KeepsTheDepthBeforeTheTurnAndTheDirectionOfTheAdvance) {
  const PhaseHistory h = detectPhases(textbook().samples());
  ASSERT_EQ(h.passes.size(), 1u);
  const Pass& pass = h.passes[0];
  EXPECT_NEAR(pass.end_of_phase_1.depth, 0.008, 1e-9);  // the turn is about the tip
  EXPECT_LT(angleBetween(pass.start_of_phase_2.axis_A, taughtPath().direction_L), 1e-9);
  // 2 mm along the needle, seen through 0.1 s of smoothing at 10 mm/s: 3 mm, one tick of rounding.
  EXPECT_NEAR(pass.start_of_phase_2.depth, 0.008 + 0.003, 0.0001);
}

TEST(PhaseDetector, TremorAndJitterChangeNothing) {
  const PhaseHistory still = detectPhases(textbook().samples());
  const PhaseHistory shaken = detectPhases(trembling(textbook().samples()));
  EXPECT_EQ(sequence(trembling(textbook().samples())), sequence(textbook().samples()));
  EXPECT_NEAR(shaken.passes[0].end_of_phase_1.depth, still.passes[0].end_of_phase_1.depth, 2e-4);
  EXPECT_NEAR(shaken.passes[0].start_of_phase_2.t_s, still.passes[0].start_of_phase_2.t_s, 0.1);
}

TEST(PhaseDetector, TremorWhileHoldingStillNeverStartsPhase2) {
  Motion m;
  m.push(0.010).puncture().push(0.008).hold(5).turnTo(taughtPath().direction_L).hold(20);
  EXPECT_EQ(sequence(trembling(m.samples())),
            (std::vector<P>{P::approach, P::puncture, P::reorient}));
}

TEST(PhaseDetector, TiltingAboutTheTipIsNoAdvanceThoughTheInsertedLengthGrows) {
  Motion m;
  m.push(0.010).puncture().push(0.010);
  m.turnTo(direction_L(20 * kDeg, 0), 10 * kDeg);
  for (TrialSample& s : m.samples())
    if (s.phase == haptics::NeedlePhase::inserted)
      s.depth /= s.axis_A.y();  // length below a plane skin: 10 mm upright, 29 mm at 20 degrees
  EXPECT_EQ(sequence(m.samples()), (std::vector<P>{P::approach, P::puncture, P::reorient}));
}

TEST(PhaseDetector, TurningBackIsPunctureAgainAndTheLaterTurnCounts) {
  Motion m;
  m.push(0.010).puncture().push(0.004).turnTo(direction_L(80 * kDeg, 0)).hold(0.5);
  m.turnTo(Vec3::UnitY()).push(0.004).turnTo(taughtPath().direction_L).push(0.01);
  EXPECT_EQ(sequence(m.samples()), (std::vector<P>{P::approach, P::puncture, P::reorient,
                                                   P::puncture, P::reorient, P::advance}));
  EXPECT_NEAR(detectPhases(m.samples()).passes[0].end_of_phase_1.depth, 0.008, 1e-9);
}

TEST(PhaseDetector, StraightOnWithoutTurningIsPhase2After25Millimetres) {
  Motion m;
  m.push(0.010).puncture().push(0.040);
  const Pass pass = detectPhases(m.samples()).passes.at(0);
  EXPECT_TRUE(pass.advanced);
  EXPECT_FALSE(pass.reoriented);
  EXPECT_NEAR(pass.start_of_phase_2.depth, 0.026, 0.0002);  // 0.1 s of smoothing at 10 mm/s
}

TEST(PhaseDetector, StraightAdvanceDrawnBackAndTurnedStartsPhase2Afresh) {
  Motion m;
  m.push(0.010).puncture().push(0.030).push(-0.022).turnTo(taughtPath().direction_L).push(0.02);
  const Pass pass = detectPhases(m.samples()).passes.at(0);
  EXPECT_TRUE(pass.advanced);
  EXPECT_TRUE(pass.reoriented);
  EXPECT_LT(angleBetween(pass.start_of_phase_2.axis_A, taughtPath().direction_L), 1e-6);
  EXPECT_NEAR(pass.end_of_phase_1.depth, 0.008, 1e-6);
}

TEST(PhaseDetector, StraightAdvanceStaysOneWhenTheNeedleIsDrawnOutStraight) {
  Motion m;
  m.push(0.010).puncture().push(0.030).withdraw().hold(0.1);
  EXPECT_EQ(sequence(m.samples()),
            (std::vector<P>{P::approach, P::puncture, P::advance, P::approach}));
}

TEST(PhaseDetector, DriftOfTheHandOnTheWayInIsNotTheEndOfPhase1) {
  // 7 degrees of drift over the first 4 mm, then 4 mm more, then the turn.
  Motion m;
  m.push(0.010).puncture().turnTo(direction_L(83 * kDeg, 0), 7 * kDeg, 0.004).push(0.004);
  m.hold(0.5).turnTo(taughtPath().direction_L).push(0.02);
  const Pass pass = detectPhases(m.samples()).passes.at(0);
  EXPECT_TRUE(pass.reoriented);
  EXPECT_NEAR(pass.end_of_phase_1.depth, 0.008, 1e-9);
}

TEST(PhaseDetector, DriftAloneIsNoReorientation) {
  Motion m;
  m.push(0.010).puncture().turnTo(direction_L(83 * kDeg, 0), 7 * kDeg, 0.004).push(0.030);
  const Pass pass = detectPhases(m.samples()).passes.at(0);
  EXPECT_TRUE(pass.advanced);
  EXPECT_FALSE(pass.reoriented);
}

TEST(PhaseDetector, LumenOfTheVeinIsAlwaysPhase2) {
  Motion m;
  m.push(0.010).puncture().push(0.018).in(Tissue::vein_lumen).hold(0.1);
  const Pass pass = detectPhases(m.samples()).passes.at(0);
  EXPECT_TRUE(pass.advanced);
  EXPECT_FALSE(pass.reoriented);
}

TEST(PhaseDetector, AdvancingWhileTurningWaitsForASettledDirection) {
  Motion m;
  m.push(0.010).puncture().push(0.004);
  m.turnTo(taughtPath().direction_L, 20 * kDeg, 0.008).push(0.01);
  const Pass pass = detectPhases(m.samples()).passes.at(0);
  ASSERT_TRUE(pass.advanced);
  EXPECT_LT(angleBetween(pass.start_of_phase_2.axis_A, taughtPath().direction_L), 5 * kDeg);
  // Turning at 20 deg/s shows after 0.2 s (1.5 degrees between the two smoothings); 2.5 mm/s
  // deeper.
  EXPECT_NEAR(pass.end_of_phase_1.depth, 0.004, 0.0006);
}

TEST(PhaseDetector, WithdrawalStartsASecondPass) {
  Motion m;
  m.push(0.010).puncture().push(0.008).turnTo(direction_L(60 * kDeg, 0)).push(0.010);
  m.withdraw().hold(0.5).turnTo(Vec3::UnitY()).hold(0.2).puncture();
  m.push(0.006).turnTo(taughtPath().direction_L).push(0.010);
  EXPECT_EQ(sequence(m.samples()),
            (std::vector<P>{P::approach, P::puncture, P::reorient, P::advance, P::approach,
                            P::puncture, P::reorient, P::advance}));
  const PhaseHistory h = detectPhases(m.samples());
  ASSERT_EQ(h.passes.size(), 2u);
  EXPECT_NEAR(h.passes[1].end_of_phase_1.depth, 0.006, 1e-9);
  EXPECT_EQ(scoredPass(h.passes, true), &h.passes[1]);
}

TEST(PhaseDetector, WithoutSuccessThePassThatReachedPhase2IsScored) {
  Motion m;
  m.push(0.010).puncture().push(0.008).turnTo(taughtPath().direction_L).push(0.010);
  m.withdraw().turnTo(Vec3::UnitY()).puncture().push(0.002);
  const PhaseHistory h = detectPhases(m.samples());
  ASSERT_EQ(h.passes.size(), 2u);
  EXPECT_EQ(scoredPass(h.passes, false), &h.passes[0]);
  EXPECT_EQ(scoredPass(h.passes, true), &h.passes[1]);
}

TEST(PhaseDetector, OnlineAndOfflineAgreeSampleBySample) {
  const std::vector<TrialSample> samples = trembling(textbook().samples());
  const PhaseHistory offline = detectPhases(samples);
  PhaseDetector online;
  for (std::size_t i = 0; i < samples.size(); ++i) {
    online.add(samples[i]);
    ASSERT_EQ(online.phase(), offline.phases[i]) << "at " << samples[i].t_s << " s";
  }
  EXPECT_EQ(online.startOfPhase2().t_s, offline.passes.back().start_of_phase_2.t_s);
  EXPECT_EQ(online.endOfPhase1().t_s, offline.passes.back().end_of_phase_1.t_s);
}

TEST(PhaseDetector, SlowRecordingsTellTheSameStory) {
  for (const double rate : {20.0, 60.0, 250.0}) {
    const std::vector<TrialSample> samples = textbook(rate).samples();
    EXPECT_EQ(sequence(samples), sequence(textbook().samples())) << rate << " Hz";
    const Pass pass = detectPhases(samples).passes[0];
    EXPECT_NEAR(pass.end_of_phase_1.depth, 0.008, 1e-9) << rate << " Hz";
  }
}

}  // namespace
}  // namespace palpa::assess::test
