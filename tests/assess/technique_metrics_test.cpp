// Figures of technique on motions made by hand.
#include "apps/assess/needle/needle_metrics.h"

#include <gtest/gtest.h>

#include "tests/assess/motions.h"

namespace palpa::assess::test {
namespace {

double figure(const TrialAssessment& a, const std::string& name) {
  for (const metrics::MetricValue& m : a.metrics)
    if (m.name == name) return m.value;
  ADD_FAILURE() << "no figure " << name;
  return 0;
}

TEST(TechniqueMetrics, PlaceAndAimByParts) {
  Motion m;
  m.now().tip_A += Vec3(0.004, 0, -0.003);
  m.push(0.010)
      .puncture()
      .push(0.008)
      .turnTo(direction_L(32 * kDeg, 15 * kDeg + 6 * kDeg / std::cos(32 * kDeg)))
      .push(0.028);
  const TrialAssessment a = assess(m.samples(), "time");
  EXPECT_NEAR(figure(a, "entry_along_mm"), 4, 1e-6);
  EXPECT_NEAR(figure(a, "entry_across_mm"), -3, 1e-6);
  EXPECT_NEAR(figure(a, "aim_steeper_deg"), 7, 0.01);
  EXPECT_NEAR(figure(a, "aim_cephalad_deg"), 6, 0.01);
}

TEST(TechniqueMetrics, SuctionIsAShareOfTheWay) {
  Motion m;
  // An advance is noticed after 2 mm, 0.1 s late because of the smoothing: 9 mm without suction,
  // then 10 mm with it.
  const double share = 100 * 10.0 / 19;
  m.push(0.010).puncture().push(0.008).turnTo(taughtPath().direction_L).push(0.012);
  m.now().plunger = 0.4;
  m.push(0.010);
  EXPECT_NEAR(figure(assess(m.samples(), "time"), "aspirated_advance_pct"), share, 1);
  m.push(-0.010).push(0.010);  // the same way again is no advance
  EXPECT_NEAR(figure(assess(m.samples(), "time"), "aspirated_advance_pct"), share, 1);
  m.now().plunger = 0;
  m.in(Tissue::vein_lumen).push(0.010);  // nor is what follows in the vein
  EXPECT_NEAR(figure(assess(m.samples(), "time"), "aspirated_advance_pct"), share, 1);
}

TEST(TechniqueMetrics, ATurnWhileDrawnBackIsFannedOut) {
  Motion straight;
  straight.push(0.010).puncture().push(0.008).turnTo(taughtPath().direction_L).push(0.025);
  EXPECT_TRUE(std::isnan(
      figure(assess(straight.samples(), "time"), "withdrawal_turn_deg")));  // never drawn back
  straight.push(-0.012);
  EXPECT_NEAR(figure(assess(straight.samples(), "time"), "withdrawal_turn_deg"), 0, 0.01);
  Motion fanned;
  fanned.push(0.010)
      .puncture()
      .push(0.008)
      .turnTo(taughtPath().direction_L)
      .push(0.025)
      .turnTo(direction_L(37 * kDeg, 15 * kDeg), 8 * kDeg, -0.012);
  EXPECT_NEAR(figure(assess(fanned.samples(), "time"), "withdrawal_turn_deg"), 12, 0.1);
  Motion after;  // drawn back in its line, then turned and advanced
  after.push(0.010)
      .puncture()
      .push(0.008)
      .turnTo(taughtPath().direction_L)
      .push(0.025)
      .push(-0.012)
      .turnTo(direction_L(40 * kDeg, 15 * kDeg))
      .push(0.010);
  EXPECT_LT(figure(assess(after.samples(), "time"), "withdrawal_turn_deg"), 1);
}

TEST(TechniqueMetrics, InjuriesByNumber) {
  Motion m;
  m.push(0.010).puncture().push(0.008).turnTo(taughtPath().direction_L).push(0.010);
  m.in(Tissue::connective, Organ::lung)
      .hold(0.3)
      .in(Tissue::connective)
      .hold(0.5)
      .in(Tissue::connective, Organ::lung)
      .hold(0.1)
      .in(Tissue::lung)
      .hold(0.2)
      .in(Tissue::connective)
      .hold(0.5);
  m.in(Tissue::artery_lumen)
      .hold(0.3)
      .in(Tissue::connective)
      .hold(0.5)
      .in(Tissue::connective, Organ::artery)
      .hold(0.1)
      .in(Tissue::connective)
      .hold(0.5);
  m.bone(Organ::rib, 2)
      .hold(0.4)
      .bone(Organ::none, 0)
      .hold(0.4)
      .bone(Organ::sternum, 1)
      .hold(0.4)
      .bone(Organ::none, 0)
      .hold(0.1);
  const TrialAssessment a = assess(m.samples(), "time");
  EXPECT_EQ(figure(a, "pleural_contacts"), 2);
  EXPECT_EQ(figure(a, "pleural_punctures"), 1);
  EXPECT_EQ(figure(a, "arterial_contacts"), 2);
  EXPECT_EQ(figure(a, "arterial_punctures"), 1);
  EXPECT_EQ(figure(a, "rib_contacts"), 2);
}

TEST(TechniqueMetrics, APunctureShorterThanAScoringSampleCounts) {
  Motion m;
  m.push(0.010)
      .puncture()
      .push(0.008)
      .turnTo(taughtPath().direction_L)
      .push(0.0101)
      .in(Tissue::lung)
      .hold(0.005)
      .in(Tissue::connective)
      .hold(0.5);
  EXPECT_EQ(figure(assess(m.samples(), "time"), "pleural_punctures"), 1);
}

}  // namespace
}  // namespace palpa::assess::test
