#include <gtest/gtest.h>

#include "apps/report/practice/progress_words.h"
#include "apps/training/engine.h"
#include "apps/training/trial_words.h"
#include "synthetic_practice.h"
#include "tests/support/files.h"
#include "well_formed.h"

namespace palpa::report {
namespace {

template <class Write>
std::string practicePage(const char* name, Write write) {
  const std::filesystem::path file = palpa::test::freshFolder("report", name) / "page.html";
  write(file);
  std::string page = palpa::test::slurp(file);
  EXPECT_EQ(test::faultOf(page), "");
  return page;
}

std::string traineePage(const TraineeReport& report) {
  return practicePage("trainee", [&](const auto& file) { writeTraineeReport(report, file); });
}
std::string cohortPage(const CohortReport& report) {
  return practicePage("cohort", [&](const auto& file) { writeCohortReport(report, file); });
}

bool tells(const std::string& page, const std::string& words) {
  return page.find(words) != std::string::npos;
}

std::size_t occurrences(const std::string& page, const std::string& words) {
  std::size_t count = 0;
  for (std::size_t at = page.find(words); at != std::string::npos; at = page.find(words, at + 1))
    ++count;
  return count;
}

TEST(TraineePage, SaysInShortWhatAnEducatorAsks) {
  const std::string page = traineePage(test::madeUpTrainee(30));
  for (const char* words :
       {"Trainee T&lt;7&gt;", "30 scored trials in 6 sessions, 2027-01-10 to 2027-07-15",
        "time, from 56.1 s to ", "95 % interval", "Costs most now:", "points a trial",
        "Nearest misses:", "mm from the pleura in trial ", "Recurring:", "Practise next:",
        "none is established for this procedure", "exponential curve", "bootstrap"})
    EXPECT_TRUE(tells(page, words)) << words;
  EXPECT_FALSE(tells(page, "SIMULATED"));
  EXPECT_FALSE(tells(page, "<script"));
  EXPECT_FALSE(tells(page, "http-equiv"));
}

TEST(TraineePage, EveryPlotHasATableAndTwoDrawings) {
  const std::string page = traineePage(test::madeUpTrainee(30));
  const std::size_t wide = occurrences(page, "class=\"chart wide\"");
  EXPECT_EQ(wide, 4u);  // total, time, success, CUSUM
  EXPECT_EQ(occurrences(page, "class=\"chart narrow\""), wide);
  EXPECT_EQ(occurrences(page, "The figures of this plot"), wide);
}

TEST(TraineePage, FewTrialsCertifyNobody) {
  const std::string page = traineePage(test::madeUpTrainee(5));
  EXPECT_TRUE(tells(page,
                    "So few trials cannot certify anybody: with these rates it takes at least 13, "
                    "all without failure"));
  EXPECT_TRUE(tells(page, "no curve is fitted"));
  EXPECT_TRUE(tells(page, "too few trials to say what changed"));
  EXPECT_TRUE(tells(page, "once it is reached"));
  EXPECT_FALSE(tells(page, "class=\"curve fitted\""));
}

TEST(TraineePage, OfOtherRatesTheShortestCleanRunIsTheirs) {
  TraineeReport report = test::madeUpTrainee(5);
  report.rates = {0.05, 0.10};
  EXPECT_TRUE(tells(traineePage(report), "at least 41, all without failure"));
}

TEST(TraineePage, CompetenceProposesTestsAndAPauseShowsItsCost) {
  TraineeReport report = test::madeUpTrainee(30);
  for (progress::PracticeTrial& trial : report.trials) {
    trial.figures.set("success", 1);
    trial.figures.set("needle_passes", 1);
    trial.figures.set("col_lung", 0);
  }
  const std::string page = traineePage(report);
  EXPECT_TRUE(tells(page, "accepted at trial 13 (2027-01-12)"));
  EXPECT_TRUE(tells(page, "Test again on 2027-07-12 and 2028-01-12"));
  EXPECT_TRUE(tells(page, ">182<"));
}

TEST(TraineePage, KindsOfTrialsAreKeptApartAndNamed) {
  TraineeReport report = test::madeUpTrainee(24);
  for (std::size_t i = 0; i < report.trials.size(); ++i) {
    if (i % 3 == 1) report.trials[i].simulated = true;
    if (i % 3 == 2) report.trials[i].force_feedback = false;
  }
  report.trials[0].role = training::Role::familiarisation;
  report.trials[3].outcome = training::Outcome::voided;
  const std::string page = traineePage(report);
  EXPECT_TRUE(tells(page, "SIMULATED"));
  EXPECT_EQ(occurrences(page, "class=\"card series\""), 3u);
  EXPECT_TRUE(tells(page, "Subclavian access, force feedback off"));
  EXPECT_TRUE(tells(page, "Subclavian access, simulated"));
  EXPECT_TRUE(tells(page, "Left out of every figure: 1 familiarisation, 1 void."));
}

TEST(TraineePage, PalpationIsLockedBelowEightCases) {
  TraineeReport report;
  report.trainee = "P";
  for (int i = 1; i <= 7; ++i) {
    progress::PracticeTrial t;
    t.trainee = "P";
    t.task = "palpation";
    t.engine = training::Engine::palpation;
    t.number = i;
    t.role = training::Role::scored;
    t.outcome = training::Outcome::done;
    t.figures = {{"success", 1},
                 {"time_s", 100.0 + i},
                 {"sensitivity_pct", 80.0 + i},
                 {"specificity_pct", 100},
                 {"false_alarms", 0},
                 {"presses", 40},
                 {"coverage_deep_pct", 97},
                 {"coverage_light_pct", 99}};
    report.trials.push_back(t);
  }
  const std::string locked = traineePage(report);
  EXPECT_TRUE(
      tells(locked, "Nobody passes or fails by fewer than eight cases; so far there are 7"));
  EXPECT_FALSE(tells(locked, "CUSUM"));
  report.trials.push_back(report.trials.back());
  EXPECT_TRUE(tells(traineePage(report), "CUSUM"));
}

TEST(TraineePage, WithoutTrialsItSaysSo) {
  EXPECT_TRUE(tells(traineePage({}), "No trial counts yet"));
}

TEST(CohortPage, SaysWhoNeedsAttentionAndWhatIsCommon) {
  const std::string page = cohortPage(test::madeUpCohort(6, 12));
  for (const char* words :
       {"Group: novice", "6 trainees, 72 scored trials",
        "Needs attention:", "T003: the pleura was touched in", "of a trainee&#39;s trials",
        "ICC(3,k)", "bootstrap over trainees", "Fewer than 13 trials cannot certify anybody"})
    EXPECT_TRUE(tells(page, words)) << words;
  EXPECT_EQ(occurrences(page, "class=\"chart wide\""), occurrences(page, "class=\"chart narrow\""));
  EXPECT_EQ(occurrences(page, "class=\"chart wide\""),
            occurrences(page, "The figures of this plot"));
  EXPECT_FALSE(tells(page, "SIMULATED"));
}

TEST(CohortPage, SimulatedAndPeopleNeverShareAFigure) {
  CohortReport report = test::madeUpCohort(6, 12);
  for (progress::PracticeTrial& trial : report.trials) trial.simulated = trial.trainee > "T003";
  const std::string page = cohortPage(report);
  EXPECT_TRUE(tells(page, "SIMULATED"));
  const std::size_t second =
      page.find("class=\"card series\"", page.find("class=\"card series\"") + 1);
  ASSERT_NE(second, std::string::npos);
  const std::string one = page.substr(0, second), other = page.substr(second);
  EXPECT_NE(one.find(">T001<") == std::string::npos, other.find(">T001<") == std::string::npos);
  EXPECT_NE(one.find(">T005<") == std::string::npos, other.find(">T005<") == std::string::npos);
  EXPECT_NE(one.find(">T001<") == std::string::npos, one.find(">T005<") == std::string::npos);
}

TEST(CohortPage, FewerThanEightCasesHaveNoReliability) {
  EXPECT_TRUE(tells(cohortPage(test::madeUpCohort(4, 7)),
                    "nobody should pass or fail by these figures alone"));
}

TEST(ProgressWords, FiguresHaveTheirUnits) {
  EXPECT_EQ(figureOf("time_s", 21.53), "21.5 s");
  EXPECT_EQ(figureOf("success", 0.8), "80 %");
  EXPECT_EQ(figureOf("coverage_deep_pct", 94.99),
            "94.9 %");  // never as the standard that it misses
  EXPECT_EQ(figureOf("total", 913.24), "913 points");
  EXPECT_EQ(figureOf("needle_passes", 2), "2");
  EXPECT_EQ(intervalWords("time_s", std::pair(1.0, 2.5)), " (95 % interval 1 s to 2.5 s)");
  EXPECT_EQ(intervalWords("time_s", std::nullopt), "");
  EXPECT_EQ(fieldOf("success", 1), "yes");
  progress::Change change{"time_s", 3,   40,  20,
                          -20,      -28, -12, progress::Change::ChangeVerdict::better};
  EXPECT_EQ(changeWords(change),
            "time, from 40 s to 20 s (means of the first and the last 3 trials), 20 s less (95 % "
            "interval 12 s to 28 s)");
  change = {"closest_pleura_mm", 3, 5, 6, 1, -2, 4, progress::Change::ChangeVerdict::unclear};
  EXPECT_EQ(changeWords(change),
            "closest to the pleura, from 5 mm to 6 mm (means of the first and the last 3 trials); "
            "the difference's 95 % interval is −2 mm to 4 mm");
}

TEST(Example, PagesOfPracticeToLookAt) {
  const auto folder = palpa::test::freshFolder("report", "practice");
  writeTraineeReport(test::madeUpTrainee(30), folder / "trainee.html");
  writeTraineeReport(test::madeUpTrainee(5), folder / "few.html");
  writeCohortReport(test::madeUpCohort(12, 12), folder / "cohort.html");
  EXPECT_LT(std::filesystem::file_size(folder / "trainee.html"), 400'000u);
}

}  // namespace
}  // namespace palpa::report
