#include "apps/assess/needle/aspiration.h"

#include <gtest/gtest.h>

#include "apps/assess/needle/needle_metrics.h"
#include "tests/assess/motions.h"

/// What comes into the syringe, when it is asked what that is, and what waiting does to a score.
namespace palpa::assess::test {
namespace {

TrialSample in(Tissue tissue, double plunger, double t_s = 0) {
  TrialSample s;
  s.tissue = tissue;
  s.plunger = plunger;
  s.t_s = t_s;
  return s;
}

TEST(Aspirate, ComesFromWhereTheTipIsWhileThePlungerIsDrawn) {
  const ScoringRules rules;
  for (const Tissue gives : {Tissue::vein_lumen, Tissue::artery_lumen, Tissue::lung}) {
    EXPECT_EQ(aspiratedFrom(in(gives, 0.5), rules), gives);
    EXPECT_EQ(aspiratedFrom(in(gives, 0.2), rules), Tissue::air);
  }
  for (const Tissue dry : {Tissue::muscle, Tissue::fat, Tissue::connective, Tissue::bone})
    EXPECT_EQ(aspiratedFrom(in(dry, 1), rules), Tissue::air);
}

/// Largest and smallest rate of filling in two seconds, in millilitres' share a second.
std::pair<double, double> ratesOf(Tissue tissue) {
  Syringe syringe;
  double least = 1e9, most = 0, before = 0;
  for (int i = 1; i <= 2000; ++i) {
    syringe.add(in(tissue, 1, 1e-3 * i), tissue, 1e-3 * (i - 1));
    const double rate = 1e3 * (syringe.blood() - before);
    before = syringe.blood();
    least = std::min(least, rate), most = std::max(most, rate);
  }
  EXPECT_EQ(syringe.of(), tissue);
  return {least, most};
}

TEST(Syringe, FillsSteadilyFromAVeinAndInPulsesFromAnArtery) {
  const auto [vein_least, vein_most] = ratesOf(Tissue::vein_lumen);
  EXPECT_NEAR(vein_least, 0.25, 1e-6);
  EXPECT_NEAR(vein_most, 0.25, 1e-6);
  const auto [artery_least, artery_most] = ratesOf(Tissue::artery_lumen);
  EXPECT_LT(artery_least, 0.01);
  EXPECT_GT(artery_most, 3 * vein_most);
  EXPECT_EQ(ratesOf(Tissue::lung).second, 0) << "air fills nothing";
}

TEST(Syringe, HoldsNoMoreThanIsDrawnAndNoBubblesAfterwards) {
  Syringe syringe;
  syringe.add(in(Tissue::vein_lumen, 0.3, 10), Tissue::vein_lumen, 0);
  EXPECT_EQ(syringe.blood(), 0.3);
  syringe.add(in(Tissue::lung, 0.3, 10.1), Tissue::lung, 10);
  EXPECT_EQ(syringe.of(), Tissue::lung);
  syringe.add(in(Tissue::fat, 0.3, 10.2), Tissue::air, 10.1);
  EXPECT_EQ(syringe.of(), Tissue::air);
}

/// Milliseconds until it is asked; -1: not within 5 s.
int askedAfter(AspirationQuestion& question, Tissue from, int ms = 5000) {
  ScoringRules rules;
  rules.told_within_s = 10;
  for (int i = 1; i <= ms; ++i) {
    question.add(from, 1e-3, rules);
    if (question.asked()) return i;
  }
  return -1;
}

TEST(Question, IsAskedAfterTheDwellOnceForEachPlace) {
  AspirationQuestion question;
  EXPECT_EQ(askedAfter(question, Tissue::air), -1);
  EXPECT_NEAR(askedAfter(question, Tissue::artery_lumen), 1000, 1);
  EXPECT_EQ(question.about(), Tissue::artery_lumen);
  question.answered();
  EXPECT_EQ(askedAfter(question, Tissue::artery_lumen), -1) << "it was told";
  EXPECT_EQ(askedAfter(question, Tissue::air, 200), -1);
  EXPECT_EQ(askedAfter(question, Tissue::artery_lumen, 2000), -1) << "tremor is no new place";
  EXPECT_EQ(askedAfter(question, Tissue::air, 600), -1);
  EXPECT_NEAR(askedAfter(question, Tissue::artery_lumen), 1000, 1) << "left, and come back";
  question.answered();
  EXPECT_NEAR(askedAfter(question, Tissue::vein_lumen), 1000, 1) << "something else comes";
}

TEST(Question, AnInterruptedFlowBeginsAgain) {
  AspirationQuestion question;
  EXPECT_EQ(askedAfter(question, Tissue::vein_lumen, 900), -1);
  EXPECT_EQ(askedAfter(question, Tissue::air, 50), -1);
  EXPECT_NEAR(askedAfter(question, Tissue::vein_lumen), 1000, 1);
}

TEST(Question, OnlyTheRightWordIsRight) {
  EXPECT_TRUE(isRight(Taken::vein, Tissue::vein_lumen));
  EXPECT_TRUE(isRight(Taken::artery, Tissue::artery_lumen));
  EXPECT_TRUE(isRight(Taken::neither, Tissue::lung));
  EXPECT_FALSE(isRight(Taken::vein, Tissue::artery_lumen));
  EXPECT_FALSE(isRight(Taken::artery, Tissue::vein_lumen));
  EXPECT_FALSE(isRight(Taken::vein, Tissue::lung));
  EXPECT_FALSE(isRight(Taken::neither, Tissue::vein_lumen));
}

double metricOf(const TrialAssessment& a, const std::string& name) {
  for (const metrics::MetricValue& m : a.metrics)
    if (m.name == name) return m.value;
  return -1;
}

TEST(Waiting, IsNotInTime) {
  ScoringRules rules;
  rules.told_within_s = 10;
  std::vector<TrialSample> samples = textbook().samples();
  EXPECT_EQ(metricOf(assess(samples), "aspirate_told"), -1) << "these rules do not ask";
  const TrialAssessment swift = assess(samples, "success", rules);
  EXPECT_TRUE(std::isnan(metricOf(swift, "aspirate_told"))) << "nobody asked";
  const double end = samples.back().t_s;
  for (int i = 0; i < 4000; ++i) {  // in the vein, until it is said
    samples.push_back(samples.back());
    samples.back().t_s += 1e-3;
    samples.back().waiting = true;
  }
  const TrialAssessment told = assess(samples, "success", rules);
  EXPECT_EQ(told.values.time_ms, swift.values.time_ms);
  EXPECT_EQ(metricOf(told, "aspirate_told"), 1);
  const TrialAssessment silent = assess(samples, "mistaken", rules);
  EXPECT_NEAR(silent.values.time_ms, 1000 * end, 2);
  EXPECT_EQ(metricOf(silent, "aspirate_told"), 0);
  EXPECT_NE(silent.summary.find("not recognised"), std::string::npos) << silent.summary;
}

}  // namespace
}  // namespace palpa::assess::test
