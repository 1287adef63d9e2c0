#include <gtest/gtest.h>

#include <algorithm>

#include "anatomy/base/error.h"
#include "apps/training/trial_words.h"
#include "tests/assess/motions.h"

namespace palpa::assess::test {
namespace {

std::vector<std::string> kindsOf(const TrialAssessment& a) {
  std::vector<std::string> kinds;
  for (const Moment& m : a.moments) kinds.push_back(m.kind);
  return kinds;
}

const Span* spanOf(const TrialAssessment& a, const std::string& label) {
  for (const Span& s : a.spans)
    if (s.label == label) return &s;
  return nullptr;
}

TEST(Assessment, TextbookTrial) {
  const TrialAssessment a = assess(textbook().samples());
  EXPECT_EQ(a.outcome, training::Outcome::success);
  EXPECT_EQ(a.skin_punctures, 1);
  EXPECT_EQ(a.redirections, 0);
  // 1 s to the skin, 0.8 s deep, the turn, 2.8 s to the wall, 0.2 s, 0.2 s, 1 s of blood.
  const double turn_s = std::acos(taughtPath().direction_L.y()) / (20 * kDeg);
  EXPECT_NEAR(a.values.time_ms, 1000 * (6.0 + turn_s), 2);
  EXPECT_NEAR(a.total, 0.01 * a.values.time_ms, 1e-4);
  EXPECT_EQ(a.summary, "Vein reached in 9.3 s with no injury. Largest penalty: time (93 points).");
}

TEST(Assessment, LinesAddUpToTheTotalInThePapersOrder) {
  std::vector<TrialSample> samples = textbook().samples();
  for (TrialSample& s : samples)
    if (s.t_s > 2 && s.t_s < 2.3) s.wall = Organ::lung, s.bone = Organ::rib;
  const TrialAssessment a = assess(samples);
  const char* codes[] = {"COL_LUNG", "COL_RIB",   "COL_ART",  "COL_VEIN", "PHASE_1",
                         "PHASE_2",  "ECON_MEAN", "ECON_VAR", "TIME"};
  ASSERT_EQ(a.penalties.size(), 9u);
  double sum = 0;
  for (std::size_t i = 0; i < 9; ++i) {
    EXPECT_EQ(a.penalties[i].code, codes[i]);
    EXPECT_FALSE(a.penalties[i].sentence.empty());
    EXPECT_DOUBLE_EQ(a.penalties[i].points, a.penalties[i].weight * a.penalties[i].value);
    sum += a.penalties[i].points;
  }
  EXPECT_NEAR(sum, a.total, 1e-9);
}

TEST(Assessment, MomentsTellTheStoryInOrder) {
  const TrialAssessment a = assess(textbook().samples());
  EXPECT_EQ(kindsOf(a), (std::vector<std::string>{"puncture", "reorient", "advance", "vein",
                                                  "flash", "success"}));
  EXPECT_NEAR(a.moments[0].t_s, 1.0, 1e-9);
}

TEST(Assessment, SpansCoverTheTrialAndNameTheVein) {
  const TrialAssessment a = assess(textbook().samples());
  double end = 0;
  for (const Span& s : a.spans)
    if (s.kind == SpanKind::phase) {
      EXPECT_EQ(s.from_s, end);
      end = s.to_s;
    }
  EXPECT_NEAR(end, a.values.time_ms / 1000, 1e-12);
  const Span* vein = spanOf(a, "in the vein");
  ASSERT_TRUE(vein);
  EXPECT_EQ(vein->kind, SpanKind::good);
  EXPECT_NEAR(vein->to_s - vein->from_s, 1.2, 0.002);
}

TEST(Assessment, ClavicleIsAGuideBelowTheLimitAndBadAbove) {
  std::vector<TrialSample> samples = textbook().samples();
  for (TrialSample& s : samples) {
    if (s.t_s > 2.0 && s.t_s < 3.0) s.bone = Organ::clavicle, s.bone_force = 1.5;
    if (s.t_s > 2.6 && s.t_s < 2.8) s.bone_force = 5;
  }
  const TrialAssessment a = assess(samples);
  EXPECT_EQ(spanOf(a, "clavicle guides")->kind, SpanKind::guide);
  ASSERT_TRUE(spanOf(a, "clavicle above 3.0 N"));
  EXPECT_NEAR(spanOf(a, "clavicle above 3.0 N")->from_s, 2.6, 0.002);
  EXPECT_NE(penalty(a, "COL_RIB").sentence.find("for 0.2 s at 2.6 s (up to 5.0 N)"),
            std::string::npos)
      << penalty(a, "COL_RIB").sentence;
  const auto kinds = kindsOf(a);
  EXPECT_EQ(std::count(kinds.begin(), kinds.end(), "bone"), 1);
}

TEST(Assessment, LungSentenceSaysHowLongWhenAndHowDeep) {
  std::vector<TrialSample> samples = textbook().samples();
  for (TrialSample& s : samples)
    if (s.t_s > 4.9995 && s.t_s < 5.3995) s.tissue = Tissue::lung;
  const OrganDistance pleura = [](Organ organ, const Vec3&) {
    return organ == Organ::lung ? -0.0031 : 0.02;
  };
  const TrialAssessment a =
      assessTrial(facts(), samples, landmarksOnly(), pleura, taughtPath(), {});
  EXPECT_EQ(penalty(a, "COL_LUNG").sentence,
            "The needle was in the lung for 0.4 s at 5.0 s, up to 3.1 mm past the pleura: "
            "risk of pneumothorax.");
  EXPECT_EQ(penalty(a, "COL_LUNG").value, 8);
  ASSERT_EQ(penalty(a, "COL_LUNG").moments_s.size(), 1u);
  EXPECT_NEAR(penalty(a, "COL_LUNG").moments_s[0], 5.0, 1e-9);
  EXPECT_NE(a.summary.find("but the lung was punctured."), std::string::npos) << a.summary;
}

TEST(Assessment, CleanLinesPraiseBriefly) {
  const TrialAssessment a = assess(textbook().samples());
  EXPECT_EQ(penalty(a, "COL_LUNG").sentence, "No contact with the lung.");
  EXPECT_EQ(penalty(a, "COL_ART").sentence, "No contact with an artery.");
  EXPECT_EQ(penalty(a, "COL_VEIN").sentence, "The vein was touched only to enter it.");
}

TEST(Assessment, NearMissIsTheClosestSampleWhileInserted) {
  // A sphere of 10 mm radius whose surface the tip passes; it is nearer before the puncture.
  const Vec3 centre = Motion::toA(taughtPath().entry_L) - Vec3(0, 0.020, 0);
  const OrganDistance sphere = [&](Organ organ, const Vec3& p) {
    return organ == Organ::lung ? (p - centre).norm() - 0.010 : 0.015;
  };
  const TrialAssessment a =
      assessTrial(facts(), textbook().samples(), landmarksOnly(), sphere, taughtPath(), {});
  EXPECT_NEAR(a.closest_pleura_mm, 10, 0.02);  // at the puncture; the tip moves 0.01 mm a tick
  EXPECT_NEAR(a.closest_pleura_s, 1.0, 0.05);
  EXPECT_NEAR(a.closest_artery_mm, 15, 1e-9);
}

TEST(Assessment, NeverInsertedHasNoNearMiss) {
  Motion m;
  m.push(0.005);
  const OrganDistance near = [](Organ, const Vec3&) { return 0.001; };
  const TrialAssessment a =
      assessTrial(facts("aborted"), m.samples(), landmarksOnly(), near, taughtPath(), {});
  EXPECT_TRUE(std::isinf(a.closest_pleura_mm));
  EXPECT_EQ(a.closest_pleura_s, -1);
  EXPECT_EQ(a.skin_punctures, 0);
  EXPECT_EQ(a.summary.rfind(
                "Stopped after 0.5 s, vein not reached. No injury. The skin was not punctured.", 0),
            0u)
      << a.summary;
}

TEST(Assessment, SecondPunctureIsCountedAndTold) {
  Motion m;
  m.push(0.010).puncture().push(0.008).withdraw().hold(0.3).puncture().push(0.008);
  m.turnTo(taughtPath().direction_L).push(0.01);
  const TrialAssessment a = assess(m.samples(), "aborted");
  EXPECT_EQ(a.skin_punctures, 2);
  const auto kinds = kindsOf(a);
  EXPECT_EQ(std::count(kinds.begin(), kinds.end(), "withdrawn"), 1);
}

TEST(Assessment, EmptyTrialIsScoredWithoutCrashing) {
  const TrialAssessment a = assess({}, "aborted");
  EXPECT_EQ(a.values.time_ms, 0);
  EXPECT_EQ(a.values.phase_1, 58);
  EXPECT_EQ(a.values.phase_2, 5000);
  EXPECT_FALSE(assess({}, "success").values.success);
}

TEST(Assessment, DamagedRecordsAreRefused) {
  std::vector<TrialSample> samples = textbook().samples();
  samples[100].tip_A.x() = std::nan("");
  EXPECT_THROW(assess(samples), Error);
  samples = textbook().samples();
  samples[100].axis_A *= 2;
  EXPECT_THROW(assess(samples), Error);
  samples = textbook().samples();
  std::swap(samples[100], samples[200]);
  EXPECT_THROW(assess(samples), Error);
}

TEST(Assessment, SameRecordSameBits) {
  const std::vector<TrialSample> samples = textbook().samples();
  const TrialAssessment a = assess(samples), b = assess(samples);
  EXPECT_EQ(a.total, b.total);
  EXPECT_EQ(a.summary, b.summary);
}

}  // namespace
}  // namespace palpa::assess::test
