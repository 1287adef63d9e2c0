#include <gtest/gtest.h>

#include "apps/report/comparison/comparison_report.h"
#include "apps/training/trial_words.h"
#include "tests/support/files.h"
#include "well_formed.h"

namespace palpa::report {
namespace {

assess::ComparisonTrial answered(int trial, assess::ComparedProperty property, double second,
                                 int said) {
  assess::ComparisonTrial t;
  t.trial = trial;
  t.role = training::Role::scored;
  t.outcome = training::Outcome::done;
  t.property = property;
  t.factors = {1, second};
  t.said = said;
  t.peak_N = 0.9;
  t.seconds = 14.2;
  t.touches = {1, 1};
  return t;
}

ComparisonReport someAnswers() {
  ComparisonReport report;
  report.title = "Which is <harder>?";
  report.trainee = "T007";
  report.too_hard_N = 2;
  int trial = 0;
  for (int i = 0; i < 6; ++i) {
    report.trials.push_back(
        answered(++trial, assess::ComparedProperty::stiffness, 1.5, i == 0 ? 1 : 2));
    report.trials.push_back(
        answered(++trial, assess::ComparedProperty::stiffness, 0.8, i < 2 ? 2 : 1));
  }
  report.trials.push_back(answered(++trial, assess::ComparedProperty::weight, 2, 2));
  report.trials.back().peak_N = 2.5;
  return report;
}

std::string pageOf(const ComparisonReport& report) {
  const std::filesystem::path file =
      palpa::test::freshFolder("report", "comparison") / "report.html";
  writeComparisonReport(report, file);
  std::string page = palpa::test::slurp(file);
  EXPECT_EQ(test::faultOf(page), "");
  return page;
}

bool saysPage(const std::string& page, const std::string& words) {
  return page.find(words) != std::string::npos;
}

TEST(ComparisonPage, SaysWhatWasToldApart) {
  const std::string page = pageOf(someAnswers());
  for (const char* words :
       {"Answers right: 9 of 12", "Three of four answers are right from a difference of about",
        "Answers right: 1 of 1", "Wrong: the second one was harder, by 50 %", "2.5 N: too hard",
        "Which is &lt;harder&gt;?"})
    EXPECT_TRUE(saysPage(page, words)) << words;
  EXPECT_FALSE(saysPage(page, "SIMULATED"));
}

TEST(ComparisonPage, AThresholdFarAboveWhatWasAskedIsNotGivenAsAFigure) {
  ComparisonReport report = someAnswers();
  report.trials.clear();
  for (int i = 0; i < 40; ++i)
    report.trials.push_back(
        answered(i + 1, assess::ComparedProperty::stiffness, 1.2, i < 22 ? 2 : 1));
  const std::string page = pageOf(report);
  EXPECT_TRUE(saysPage(page, "only from a difference well above those asked"));
  EXPECT_FALSE(saysPage(page, "answers are right from a difference of about"));
}

TEST(ComparisonPage, SimulatedIsSaidOnTopAndVoidIsNotCounted) {
  ComparisonReport report = someAnswers();
  for (assess::ComparisonTrial& trial : report.trials) trial.outcome = training::Outcome::voided;
  report.simulated = true;
  const std::string page = pageOf(report);
  EXPECT_TRUE(saysPage(page, "SIMULATED"));
  EXPECT_TRUE(saysPage(page, "No trial counts"));
  EXPECT_TRUE(saysPage(page, "(not counted)"));
}

TEST(ComparisonCsv, ARowATrial) {
  const std::filesystem::path file =
      palpa::test::freshFolder("report", "comparison_csv") / "trials.csv";
  writeComparisonCsv("T,7", {answered(3, assess::ComparedProperty::weight, 1.43, 2)}, file);
  EXPECT_EQ(palpa::test::slurp(file),
            "USER_ID,TRIAL,SEED,SIMULATED,FF,OUTCOME,PROPERTY,FIRST,SECOND,SAID,RIGHT,PEAK_N,TIME_"
            "S,GRIPS_FIRST,GRIPS_SECOND\n\"T,7\",3,0,0,1,done,weight,1,1.43,2,1,0.9,14.2,1,1\n");
}

assess::ComparisonTrial ordered(int trial, std::vector<int> order) {
  assess::ComparisonTrial t = answered(trial, assess::ComparedProperty::friction, 2, 0);
  t.factors = {1, 0.5, 2.8, 1.4};
  t.touches = {1, 1, 2, 1};
  t.order = std::move(order);
  return t;
}

TEST(ComparisonPage, OrdersStandBesideTheTrueOnes) {
  ComparisonReport report = someAnswers();
  report.trials = {ordered(1, {2, 1, 4, 3}), ordered(2, {1, 2, 4, 3}), ordered(3, {})};
  report.trials[2].outcome = training::Outcome::time;
  const std::string page = pageOf(report);
  for (const char* words :
       {"Orders right: 1 of 2. They agreed with the true ones by 0.83 on average",
        "2 (50 %), 1 (100 %), 4 (140 %), 3 (280 %)", "1, 2, 4, 3", "0.67", "<td>5</td>",
        "The time was over before something was said.", "M. G. Kendall"})
    EXPECT_TRUE(saysPage(page, words)) << words;
  EXPECT_FALSE(saysPage(page, "Every answer"));
}

TEST(ComparisonPage, FrictionIsStrokedAndNotHeld) {
  ComparisonReport report = someAnswers();
  report.trials = {answered(1, assess::ComparedProperty::friction, 1.4, 2)};
  const std::string page = pageOf(report);
  for (const char* words : {"Which one is rougher?", "Touches", "Pressed up to",
                            "Right: the second one was rougher, by 40 %."})
    EXPECT_TRUE(saysPage(page, words)) << words;
  EXPECT_FALSE(saysPage(page, "Squeezed up to"));
}

TEST(ComparisonCsv, OrdersAreLists) {
  const std::filesystem::path file = palpa::test::freshFolder("report", "order_csv") / "trials.csv";
  assess::ComparisonTrial voided = ordered(2, {});
  voided.outcome = training::Outcome::voided;
  assess::ComparisonTrial late = ordered(3, {2});
  late.outcome = training::Outcome::time;
  writeComparisonCsv("T7", {ordered(1, {2, 1, 4, 3}), voided, late}, file);
  EXPECT_EQ(palpa::test::slurp(file),
            "USER_ID,TRIAL,SEED,SIMULATED,FF,OUTCOME,PROPERTY,FACTORS,ORDER,TRUE_ORDER,RIGHT,TAU,"
            "PEAK_N,TIME_S,TOUCHES\n"
            "T7,1,0,0,1,done,friction,1 0.5 2.8 1.4,2 1 4 3,2 1 4 3,1,1,0.9,14.2,1 1 2 1\n"
            "T7,3,0,0,1,time,friction,1 0.5 2.8 1.4,2,2 1 4 3,0,,0.9,14.2,1 1 2 1\n");
}

}  // namespace
}  // namespace palpa::report
