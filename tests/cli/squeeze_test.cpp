#include <gtest/gtest.h>

#include <algorithm>

#include "csv_rows.h"
#include "guide_script.h"
#include "program.h"
#include "tests/support/counts.h"

/// A comparison of two things in the hand, as an educator runs it.
namespace palpa::cli_test {
namespace {

Outcome squeeze(std::vector<std::string> more, const Folder& here) {
  more.insert(more.begin(), "squeeze");
  return palpa(quickly(more), here.path());
}

int rightIn(const std::vector<Row>& rows) {
  return static_cast<int>(std::count_if(rows.begin(), rows.end(),
                                        [](const Row& row) { return row.at("RIGHT") == "1"; }));
}

std::vector<Row> compared(const std::string& who, int trials, const Folder& here,
                          std::vector<std::string> more = {}) {
  more.insert(more.end(),
              {"--operator", who, "--seed", "1", "--trials", std::to_string(trials), "--out", who});
  const Outcome outcome = squeeze(more, here);
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  return outcome.exit_code == 0 ? rowsOf(contentOf(here / (who + "/trials.csv")))
                                : std::vector<Row>{};
}

TEST(Squeeze, ExpertsTellThingsApartAndNovicesLessWell) {
  const Folder here;
  const int trials = test::counted(6, 64);
  const std::vector<Row> expert = compared("expert", trials, here),
                         novice = compared("novice", trials, here);
  ASSERT_EQ(expert.size(), static_cast<std::size_t>(trials));
  EXPECT_GE(rightIn(expert), 0.85 * trials);
  EXPECT_GE(rightIn(novice), 0.5 * trials);
  if (test::fullCounts()) {
    EXPECT_LE(rightIn(novice), rightIn(expert) - 0.1 * trials);
  }
  for (const Row& row : expert) {
    EXPECT_EQ(row.at("SIMULATED"), "1");
    EXPECT_EQ(row.at("OUTCOME"), "done");
    EXPECT_GE(std::stoi(row.at("GRIPS_FIRST")), 1);
    EXPECT_GE(std::stoi(row.at("GRIPS_SECOND")), 1);
    EXPECT_LT(std::stod(row.at("PEAK_N")), 2);
  }
}

/// Without force both are the real thing: no answer is better than another.
TEST(Squeeze, WithoutForceFeedbackItIsGuessing) {
  const Folder here;
  if (!test::fullCounts()) GTEST_SKIP() << "of few answers nothing follows: with PALPA_FULL=1";
  constexpr int trials = 16;
  const std::vector<Row> rows = compared("expert", trials, here, {"--force-feedback", "off"});
  ASSERT_EQ(rows.size(), static_cast<std::size_t>(trials));
  EXPECT_GE(rightIn(rows), trials / 8);
  EXPECT_LE(rightIn(rows), trials - trials / 8);
}

TEST(Squeeze, ReplayJudgesItAgainAndForcesAddUp) {
  const Folder here;
  ASSERT_EQ(squeeze({"--operator", "expert", "--trials", "2", "--out", "A"}, here).exit_code, 0);
  const Outcome outcome = palpa({"replay", "A/session.palpa"}, here.path());
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err << outcome.out;
  EXPECT_TRUE(says(outcome.out, ": 0 differ")) << outcome.out;
  EXPECT_TRUE(says(outcome.out, "The replay equals the record"));
  const std::string words = "add up to m a: within ";
  const std::size_t at = outcome.out.find(words);
  ASSERT_NE(at, std::string::npos) << outcome.out;
  EXPECT_LE(std::stod(outcome.out.substr(at + words.size())), 0.05);
}

/// Whoever has the export can compute what was added.
TEST(Squeeze, TheGuidesScriptComputesEveryAddedForceAgain) {
  if (!pythonIsThere()) GTEST_SKIP() << "no Python (Debian: python3)";
  const Folder here;
  ASSERT_EQ(squeeze({"--operator", "expert", "--trials", "2", "--out", "A"}, here).exit_code, 0);
  ASSERT_EQ(palpa({"export", "A/session.palpa", "--out", "ticks.csv"}, here.path()).exit_code, 0);
  const ScriptVerdict verdict = checkedBy("check_touch.py", here, 30000);
  EXPECT_GT(verdict.ticks, 5000);
  EXPECT_LT(verdict.worst_mN, 1);
}

TEST(Squeeze, ViewsChangeNothingAndTheReportSaysWhatItIs) {
  const Folder here;
  ASSERT_EQ(squeeze({"--operator", "expert", "--trials", "1", "--seed", "3", "--out", "A"}, here)
                .exit_code,
            0);
  ASSERT_EQ(palpa({"train", "--task", std::string(PALPA_SOURCE_DIR) + "/assets/tasks/squeeze.json",
                   "--fast", "--quiet", "--operator", "expert", "--trials", "1", "--seed", "3",
                   "--out", "B"},
                  here.path())
                .exit_code,
            0);
  EXPECT_EQ(contentOf(here / "A/trials.csv"), contentOf(here / "B/trials.csv"));
  const std::string page = contentOf(here / "B/report.html");
  for (const char* words :
       {"SIMULATED", "Where this task stands", "another stiffness and weight", "Every answer"})
    EXPECT_TRUE(says(page, words)) << words;
  bool pictures = false;
  for (const std::string& file : here.files()) pictures = pictures || says(file, "-held.png");
  EXPECT_TRUE(pictures);
}

TEST(Squeeze, WrongUsageIsNamed) {
  const Folder here;
  const Outcome person = squeeze({"--operator", "person"}, here);
  EXPECT_EQ(person.exit_code, 2);
  const Outcome station =
      squeeze({"--operator", "expert", "--station",
               std::string(PALPA_SOURCE_DIR) + "/assets/stations/virtual_bench.json"},
              here);
  EXPECT_EQ(station.exit_code, 2);
  EXPECT_TRUE(says(station.err, "sample")) << station.err;
  const Outcome needle =
      squeeze({"--operator", "expert", "--task",
               std::string(PALPA_SOURCE_DIR) + "/assets/tasks/paracentesis.json"},
              here);
  EXPECT_EQ(needle.exit_code, 2);
  EXPECT_TRUE(says(needle.err, "engine")) << needle.err;
}

}  // namespace
}  // namespace palpa::cli_test
