#include <gtest/gtest.h>

#include "apps/assess/needle/contacts.h"
#include "tests/assess/motions.h"

namespace palpa::assess::test {
namespace {

/// The textbook trial with something touched over [from, to) seconds, before the vein is reached.
template <class Touch>
std::vector<TrialSample> touching(double from_s, double to_s, Touch touch) {
  std::vector<TrialSample> samples = textbook().samples();
  for (TrialSample& s : samples)
    if (s.t_s >= from_s - 1e-9 && s.t_s < to_s - 1e-9) touch(s);
  return samples;
}

void lung(TrialSample& s) { s.tissue = Tissue::lung; }
void pleura(TrialSample& s) { s.wall = Organ::lung; }
void arteryWall(TrialSample& s) { s.wall = Organ::artery; }
void arteryLumen(TrialSample& s) { s.tissue = Tissue::artery_lumen; }
void rib(TrialSample& s) { s.bone = Organ::rib, s.bone_force = 0.1; }
void veinWall(TrialSample& s) { s.wall = Organ::vein; }

TEST(Collisions, TextbookTrialHasNone) {
  const TrialAssessment a = assess(textbook().samples());
  EXPECT_EQ(a.values.col_lung, 0);
  EXPECT_EQ(a.values.col_rib, 0);
  EXPECT_EQ(a.values.col_art, 0);
  EXPECT_EQ(a.values.col_vein, 0);  // wall, entry and dwell are the successful entry
  EXPECT_TRUE(a.values.success);
}

TEST(Collisions, CountSamplesAtTwentyHertz) {
  // 2.00 to 2.40 s holds the sample times 2.00, 2.05, ... 2.35: eight.
  EXPECT_EQ(assess(touching(2.0, 2.4, lung)).values.col_lung, 8);
  EXPECT_EQ(assess(touching(2.0, 2.4, pleura)).values.col_lung, 8);
  EXPECT_EQ(assess(touching(2.0, 2.4, arteryWall)).values.col_art, 8);
  EXPECT_EQ(assess(touching(2.0, 2.4, arteryLumen)).values.col_art, 8);
  EXPECT_EQ(assess(touching(2.0, 2.4, rib)).values.col_rib, 8);
  EXPECT_EQ(assess(touching(2.0, 2.4, veinWall)).values.col_vein, 8);
}

TEST(Collisions, OneMoreSampleInTheLungCostsFiveHundred) {
  const TrialAssessment one = assess(touching(2.0, 2.001, lung));
  const TrialAssessment two = assess(touching(2.0, 2.051, lung));
  EXPECT_EQ(one.values.col_lung, 1);
  EXPECT_EQ(two.values.col_lung, 2);
  EXPECT_NEAR(two.total - one.total, 500, 1e-9);
}

TEST(Collisions, ContactBetweenTwoSamplesIsToldThoughNotCounted) {
  const TrialAssessment a = assess(touching(2.01, 2.03, lung));
  EXPECT_EQ(a.values.col_lung, 0);
  EXPECT_NE(penalty(a, "COL_LUNG").sentence.find("Too short to be counted"), std::string::npos);
  EXPECT_EQ(a.summary.find("no injury"), std::string::npos) << a.summary;
}

/// By contacts: one, and one more for each full second that it lasts.
TEST(Collisions, BoneByContactsDoesNotSwampTheScore) {
  ScoringRules rules;
  rules.bone_unit = BoneUnit::contacts;
  const auto count = [&](const std::vector<TrialSample>& samples) {
    const TrialAssessment a = assess(samples, "success", rules);
    EXPECT_EQ(penalty(a, "COL_RIB").unit, "contacts");
    EXPECT_EQ(penalty(a, "COL_RIB").sentence.find("Too short"), std::string::npos);
    return a.values.col_rib;
  };
  EXPECT_EQ(count(textbook().samples()), 0);
  EXPECT_EQ(count(touching(2.01, 2.03, rib)), 1) << "between two samples, too";
  EXPECT_EQ(count(touching(2.0, 2.4, rib)), 1);
  EXPECT_EQ(count(touching(1.2, 2.21, rib)), 2);
  EXPECT_EQ(count(touching(1.2, 3.3, rib)), 3);
  std::vector<TrialSample> twice = touching(2.0, 2.1, rib);
  for (TrialSample& s : twice)
    if (s.t_s >= 2.5 && s.t_s < 2.6) rib(s);
  EXPECT_EQ(count(twice), 2);
}

TEST(Collisions, NoLineIsAboutAnOrganThatThePatientLacks) {
  const TrialAssessment a = assessTrial(facts(), textbook().samples(), landmarksOnly(),
                                        OrganDistance(nowhere), taughtPath(), {});
  EXPECT_EQ(a.not_judged, (std::vector<std::string>{"lung", "artery"}));
  for (const Penalty& p : a.penalties) {
    EXPECT_NE(p.code, "COL_LUNG");
    EXPECT_NE(p.code, "COL_ART");
  }
  EXPECT_EQ(assess(textbook().samples()).not_judged, std::vector<std::string>{});
}

TEST(Collisions, GuidingContactWithTheClavicleIsFree) {
  const auto press = [](double force) {
    return [force](TrialSample& s) { s.bone = Organ::clavicle, s.bone_force = force; };
  };
  EXPECT_EQ(assess(touching(2.0, 2.4, press(2.9))).values.col_rib, 0);
  EXPECT_EQ(assess(touching(2.0, 2.4, press(3.0))).values.col_rib, 0);
  EXPECT_EQ(assess(touching(2.0, 2.4, press(3.1))).values.col_rib, 8);
  ScoringRules strict;
  strict.clavicle_guide_N = 1;
  EXPECT_EQ(assess(touching(2.0, 2.4, press(2.9)), "success", strict).values.col_rib, 8);
}

TEST(Collisions, CountsDoNotDependOnTheRecordingRate) {
  // Touched from the wall on: without success everything at the vein counts, whatever the rate.
  const double at_1000 = assess(textbook(1000).samples(), "aborted").values.col_vein;
  for (const double rate : {100.0, 200.0, 500.0})
    EXPECT_NEAR(assess(textbook(rate).samples(), "aborted").values.col_vein, at_1000, 1) << rate;
  EXPECT_NEAR(at_1000, 20 * (0.2 + 0.2 + 1.0), 1);  // wall, 2 mm at 10 mm/s, dwell
}

Motion twoEntries() {
  Motion m;
  m.push(0.010).puncture().push(0.008).turnTo(taughtPath().direction_L).push(0.028);
  m.in(Tissue::connective, Organ::vein).hold(0.2).in(Tissue::vein_lumen).hold(0.3);
  m.in(Tissue::connective).push(-0.004).push(0.004);
  m.in(Tissue::connective, Organ::vein).hold(0.2).in(Tissue::vein_lumen).hold(0.3);
  m.now().plunger = 0.5;
  m.hold(1.001);
  return m;
}

TEST(Collisions, OnlyTheEntryThatSucceedsIsFree) {
  // 0.5 s of the first stay at 20 Hz; the stay may begin between two sample times.
  EXPECT_NEAR(assess(twoEntries().samples()).values.col_vein, 10, 1);
}

TEST(Collisions, TremorAtTheWallDoesNotSplitTheEntry) {
  std::vector<TrialSample> samples = textbook().samples();
  int flickers = 0;
  for (TrialSample& s : samples)  // on and off the wall at 10 Hz
    if (s.wall == Organ::vein && std::fmod(s.t_s, 0.1) < 0.05) s.wall = Organ::none, ++flickers;
  ASSERT_GT(flickers, 0);
  EXPECT_EQ(assess(samples).values.col_vein, 0);
}

TEST(Collisions, BackWallCountsEvenInTheSuccessfulEntry) {
  Motion m;
  m.push(0.010).puncture().push(0.008).turnTo(taughtPath().direction_L).push(0.028);
  m.in(Tissue::vein_lumen).hold(0.2).in(Tissue::vein_lumen, Organ::vein);
  m.now().wall_leaving = true;
  m.hold(0.5).in(Tissue::vein_lumen);
  m.now().wall_leaving = false;
  m.now().plunger = 0.5;
  m.hold(1.001);
  const TrialAssessment a = assess(m.samples());
  EXPECT_NEAR(a.values.col_vein, 10, 1);
  EXPECT_NE(penalty(a, "COL_VEIN").sentence.find("back wall"), std::string::npos);
}

TEST(Collisions, WhatComesAfterSuccessIsNotScored) {
  Motion m = textbook();
  const TrialAssessment before = assess(m.samples());
  m.in(Tissue::lung).hold(1);
  const TrialAssessment after = assess(m.samples());
  EXPECT_EQ(after.values.col_lung, 0);
  EXPECT_EQ(after.total, before.total);
}

TEST(ScoringSamples, TakeTheNewestNotLaterThanEachTime) {
  std::vector<TrialSample> samples(3);
  samples[0].t_s = 0.01, samples[1].t_s = 0.10, samples[2].t_s = 0.19;
  // 0: none yet; 0.05: first; 0.10, 0.15: second.
  EXPECT_EQ(scoringSamples(samples, 20), (std::vector<std::size_t>{0, 1, 1}));
  EXPECT_TRUE(scoringSamples({}, 20).empty());
}

}  // namespace
}  // namespace palpa::assess::test
