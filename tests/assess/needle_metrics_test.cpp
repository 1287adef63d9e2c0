#include "apps/assess/needle/needle_metrics.h"

#include <gtest/gtest.h>

#include <set>

#include "tests/assess/motions.h"

namespace palpa::assess::test {
namespace {

double metric(const TrialAssessment& a, const std::string& name) {
  for (const metrics::MetricValue& m : a.metrics)
    if (m.name == name) return m.value;
  ADD_FAILURE() << "no figure " << name;
  return 0;
}

TEST(MetricTable, NamesEveryFigureOnceWithItsUnit) {
  std::set<std::string> names;
  for (const metrics::MetricDefinition& d : metrics::metricTable()) {
    EXPECT_TRUE(names.insert(d.name).second) << d.name;
    for (const char* text : {d.title, d.unit, d.tasks, d.definition})
      EXPECT_NE(std::string(text), "") << d.name;
    EXPECT_EQ(metrics::metricNamed(d.name), &d);
    EXPECT_NE(metrics::metricsAsMarkdown().find("| " + std::string(d.name) + " |"),
              std::string::npos);
  }
  EXPECT_EQ(metrics::metricNamed("unheard_of"), nullptr);
}

TEST(MetricTable, ANeedleTrialHasAllOfANeedlesFiguresAndNoOther) {
  ScoringRules rules;
  rules.told_within_s = 10;
  const TrialAssessment a = assess(textbook().samples(), "success", rules);
  std::set<std::string> has, wanted;
  for (const metrics::MetricValue& m : a.metrics) EXPECT_TRUE(has.insert(m.name).second) << m.name;
  for (const metrics::MetricDefinition& d : metrics::metricTable())
    if (metrics::belongsTo(d, "needle")) wanted.insert(d.name);
  EXPECT_EQ(has, wanted);
}

TEST(NeedleMetrics, TheBevelIsJudgedAsTheAdvanceBegins) {
  std::vector<TrialSample> samples = textbook().samples();
  EXPECT_LT(metric(assess(samples), "bevel_off_deg"), 20);
  for (TrialSample& s : samples) s.bevel_A = Eigen::AngleAxisd(1.5, s.axis_A) * s.bevel_A;
  EXPECT_NEAR(metric(assess(samples), "bevel_off_deg"), 1.5 * 180 / M_PI, 20);
  for (TrialSample& s : samples) s.bevel_A = Vec3::Zero();
  EXPECT_TRUE(std::isnan(metric(assess(samples), "bevel_off_deg"))) << "not known";
}

// 10 mm to the skin, 8 mm in, a turn about the tip by 65 degrees (20 degrees/s), 30 mm on.
TEST(NeedleMetrics, OfATextbookTrial) {
  const TrialAssessment a = assess(textbook().samples());
  EXPECT_EQ(metric(a, "success"), 1);
  EXPECT_EQ(metric(a, "time_s"), a.values.time_ms / 1000);
  EXPECT_EQ(metric(a, "total"), a.total);
  EXPECT_NEAR(metric(a, "path_length_mm"), 48, 0.3);
  EXPECT_NEAR(metric(a, "tissue_path_mm"), 38, 0.5);
  EXPECT_NEAR(metric(a, "tissue_time_s"), metric(a, "time_s") - 1, 0.05);
  EXPECT_NEAR(metric(a, "rotation_total_deg"), 65, 0.5);
  EXPECT_NEAR(metric(a, "tissue_damage_mm2"), 0.5 * 8 * 8 * 65 * kDeg,
              0.4);  // the shaft inside sweeps a sector
  EXPECT_EQ(metric(a, "skin_punctures"), 1);
  EXPECT_EQ(metric(a, "needle_passes"), 1);
  EXPECT_EQ(metric(a, "redirections"), 0);
  EXPECT_EQ(metric(a, "first_pass_success"), 1);
  EXPECT_EQ(metric(a, "aspirations"), 1);
  EXPECT_EQ(metric(a, "back_wall_punctures"), 0);
  EXPECT_EQ(metric(a, "translational_actions"), 0);  // never faster than 10 mm/s
  EXPECT_LT(metric(a, "frechet_mm"), 0.2);
  EXPECT_LT(metric(a, "hausdorff_mm"), 0.2);
  EXPECT_LT(metric(a, "warped_mm"), 0.2);
  EXPECT_NEAR(metric(a, "phase_1_mm"), a.values.phase_1, 0);
}

TEST(NeedleMetrics, ASecondPassIsNoFirstPassSuccess) {
  Motion m;
  m.push(0.010)
      .puncture()
      .push(0.008)
      .withdraw()
      .push(-0.005)
      .push(0.005)
      .puncture()
      .push(0.008)
      .turnTo(taughtPath().direction_L)
      .push(0.028);
  m.in(Tissue::vein_lumen).push(0.002);
  m.now().plunger = 0.5;
  m.hold(1.001);
  const TrialAssessment a = assess(m.samples());
  EXPECT_EQ(metric(a, "success"), 1);
  EXPECT_EQ(metric(a, "skin_punctures"), 2);
  EXPECT_EQ(metric(a, "needle_passes"), 2);
  EXPECT_EQ(metric(a, "first_pass_success"), 0);
}

TEST(NeedleMetrics, RedirectionsArePasses) {
  Motion m;
  m.push(0.010)
      .puncture()
      .push(0.008)
      .turnTo(taughtPath().direction_L)
      .push(0.020)
      .push(-0.010)
      .turnTo(direction_L(35 * kDeg, 15 * kDeg))
      .push(0.012);
  const TrialAssessment a = assess(m.samples(), "time");
  EXPECT_EQ(metric(a, "redirections"), 1);
  EXPECT_EQ(metric(a, "needle_passes"), 2);
  EXPECT_EQ(metric(a, "success"), 0);
  EXPECT_GT(metric(a, "frechet_mm"), 1);
}

TEST(NeedleMetrics, SpeedAndFarWallOfTheVein) {
  Motion m;
  m.push(0.010)
      .puncture()
      .push(0.008)
      .turnTo(taughtPath().direction_L)
      .push(0.028, 0.003)
      .in(Tissue::vein_lumen)
      .push(0.004, 0.003);
  m.in(Tissue::connective, Organ::vein).hold(0.1);
  m.samples().back().events |= haptics::kWallPunctured;
  m.samples().back().wall_leaving = true;
  const TrialAssessment a = assess(m.samples(), "time");
  EXPECT_NEAR(metric(a, "speed_at_vein_mm_s"), 3, 0.1);
  EXPECT_EQ(metric(a, "back_wall_punctures"), 1);
}

TEST(NeedleMetrics, ForceOnBoneAndOnTheHand) {
  Motion m;
  m.push(0.010)
      .puncture()
      .push(0.008)
      .bone(Organ::clavicle, 2.5)
      .hold(1)
      .bone(Organ::clavicle, 5)
      .hold(0.5)
      .bone(Organ::none, 0);
  m.now().f_contact = 1.5;
  m.hold(1);
  const TrialAssessment a = assess(m.samples(), "time");
  EXPECT_EQ(metric(a, "bone_force_peak_N"), 5);
  EXPECT_NEAR(metric(a, "over_force_s"), 0.5, 0.003);
  EXPECT_NEAR(metric(a, "mean_force_N"), 1.5, 0.02);
  EXPECT_NEAR(metric(a, "peak_force_N"), 1.5, 1e-9);
}

TEST(NeedleMetrics, AForceThatGrowsEvenlyHasItsSlopeAsUnsteadiness) {
  Motion m;
  m.push(0.010).puncture();
  for (int i = 0; i < 1000; ++i) {
    m.now().f_contact = 0.1 + 0.004 * i;
    m.hold(0.001);
  }
  EXPECT_NEAR(metric(assess(m.samples(), "time"), "force_jerk_N_s"), 4,
              0.15);  // the first step of 20 ms comes from nothing
}

TEST(NeedleMetrics, WhatDoesNotApplyIsNoNumber) {
  const TrialAssessment a = assess(Motion().hold(2).samples(), "time");
  for (const char* name :
       {"closest_pleura_mm", "closest_pleura_at_s", "closest_artery_mm", "speed_at_vein_mm_s",
        "frechet_mm", "mean_force_N", "smoothness_sparc", "path_inefficiency_pct"})
    EXPECT_TRUE(std::isnan(metric(a, name))) << name;
  EXPECT_EQ(metric(a, "skin_punctures"), 0);
  EXPECT_EQ(metric(a, "first_pass_success"), 0);
  EXPECT_EQ(metric(a, "tissue_path_mm"), 0);
}

/// 20 scoring samples a second: what is touched for 0.5 s counts 10 times.
TEST(NeedleMetrics, CollisionsByKind) {
  Motion m;
  m.push(0.010).puncture().push(0.008).turnTo(taughtPath().direction_L).push(0.010);
  m.in(Tissue::lung)
      .hold(0.5)
      .in(Tissue::artery_lumen)
      .hold(0.4)
      .in(Tissue::vein_lumen)
      .hold(0.3)
      .in(Tissue::connective)
      .bone(Organ::rib, 1)
      .hold(0.2);
  const TrialAssessment a = assess(m.samples(), "time");
  EXPECT_NEAR(metric(a, "col_lung"), 10, 1);
  EXPECT_NEAR(metric(a, "col_artery"), 8, 1);
  EXPECT_NEAR(metric(a, "col_vein"), 6, 1);  // in vain: there was no success
  EXPECT_NEAR(metric(a, "col_rib"), 4, 1);
}

/// An advance parallel to the taught line, 3 mm beside it, led sideways nowhere; 9 degrees off
/// where 6 are acceptable.
TEST(NeedleMetrics, DirectionAndDistanceFromTheLine) {
  Motion beside;
  beside.now().tip_A += 0.003 * taughtPath().direction_L.cross(Vec3::UnitY()).normalized();
  beside.push(0.010).puncture().push(0.008).turnTo(taughtPath().direction_L).push(0.028);
  EXPECT_NEAR(metric(assess(beside.samples(), "time"), "econ_mean_mm"), 3, 0.01);
  EXPECT_NEAR(metric(assess(beside.samples(), "time"), "econ_var_mm2"), 0, 1e-6);
  EXPECT_NEAR(metric(assess(beside.samples(), "time"), "phase_2"), 0, 1);
  Motion steep;
  steep.push(0.010).puncture().push(0.008).turnTo(direction_L(34 * kDeg, 15 * kDeg)).push(0.028);
  EXPECT_NEAR(metric(assess(steep.samples(), "time"), "phase_2"), 1500, 1);
}

/// 10 mm back and 20 mm aside in air: a flat box, and with 30 mm up a full one.
TEST(NeedleMetrics, RoomTurnsAndJerk) {
  Motion m;
  const Vec3 start = m.now().tip_A;
  m.push(0.010).turnTo(Vec3::UnitX(), 90 * kDeg);
  m.push(0.020).turnTo(Vec3::UnitZ(), 90 * kDeg).push(0.030);
  const TrialAssessment a = assess(m.samples(), "time");
  const Vec3 edges = (m.samples().back().tip_A - start).cwiseAbs();
  EXPECT_NEAR(metric(a, "bounding_box_mm3"), 1e9 * edges.prod(), 0.02 * 1e9 * edges.prod());
  EXPECT_NEAR(metric(a, "bounding_box_mm3"), 10 * 20 * 30, 0.02 * 6000);
  EXPECT_EQ(metric(a, "rotational_actions"), 2);  // 90 degrees a second, a second each
  // Still, then at 10 mm/s: steps of the speed between samples of 20 ms, which a hand does not
  // make; a hold has none.
  EXPECT_GT(metric(a, "integrated_jerk"), 1);
  EXPECT_NEAR(metric(assess(Motion().hold(2).samples(), "time"), "integrated_jerk"), 0, 1e-9);
}

TEST(NeedleMetrics, TheArterysMomentIsTheClosest) {
  const auto artery = [](Organ organ, const Vec3& p) {
    return organ == Organ::artery ? (p - Motion::toA(taughtPath().line_to_L)).norm() - 0.004
                                  : std::numeric_limits<double>::infinity();
  };
  Motion m;
  m.push(0.010)
      .puncture()
      .push(0.008)
      .turnTo(taughtPath().direction_L)
      .push(0.020)
      .hold(0.5)
      .push(-0.020);
  const TrialAssessment a = assessTrial(facts("time"), m.samples(), landmarksOnly(),
                                        OrganDistance(artery), taughtPath(), {});
  EXPECT_NEAR(metric(a, "closest_artery_mm"), 10 - 4, 0.1);  // 20 of the line's 30 mm
  EXPECT_NEAR(metric(a, "closest_artery_at_s"), m.time() - 2.25,
              0.3);  // in the hold before the 2 s of drawing back
}

TEST(NeedleMetrics, ClosestPointAndItsMoment) {
  // A lung whose surface lies 50 mm behind the origin of A: distance of the tip along y.
  const auto lung = [](Organ organ, const Vec3& p) {
    return organ == Organ::lung ? 0.050 - p.y() : std::numeric_limits<double>::infinity();
  };
  Motion m = textbook();
  const TrialAssessment a =
      assessTrial(facts(), m.samples(), landmarksOnly(), OrganDistance(lung), taughtPath(), {});
  EXPECT_NEAR(metric(a, "closest_pleura_mm"), 1e3 * (0.050 - m.samples().back().tip_A.y()), 0.01);
  EXPECT_EQ(metric(a, "closest_pleura_at_s"), a.closest_pleura_s);
  EXPECT_TRUE(std::isnan(metric(a, "closest_artery_mm")));
}

}  // namespace
}  // namespace palpa::assess::test
