#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "csv_rows.h"
#include "program.h"
#include "tests/support/counts.h"

/// Pulses that are not there, found, counted and named, as an educator runs it.
namespace palpa::cli_test {
namespace {

std::vector<Row> examined(const std::string& who, int trials, const Folder& here,
                          std::vector<std::string> more = {}) {
  more.insert(more.begin(), {"pulse", "--operator", who, "--seed", "1", "--trials",
                             std::to_string(trials), "--out", who});
  const Outcome outcome = palpa(quickly(more), here.path());
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  return outcome.exit_code == 0 ? rowsOf(contentOf(here / (who + "/trials.csv")))
                                : std::vector<Row>{};
}

template <class Holds>
double shareOf(const std::vector<Row>& rows, Holds holds) {
  return static_cast<double>(std::count_if(rows.begin(), rows.end(), holds)) /
         static_cast<double>(rows.size());
}
bool isFound(const Row& row) { return row.at("FOUND") == "1"; }
bool isTold(const Row& row) { return row.at("RHYTHM_TOLD") == "1"; }
bool isRight(const Row& row) { return row.at("RIGHT") == "1"; }
bool isCounted(const Row& row) {
  return !row.at("ERROR_PER_MIN").empty() && std::abs(std::stod(row.at("ERROR_PER_MIN"))) <= 3;
}

TEST(Pulse, ExpertsFindCountAndNameItAndNovicesLessWell) {
  const Folder here;
  const int trials = test::counted(3, 200);
  const std::vector<Row> expert = examined("expert", trials, here),
                         novice = examined("novice", trials, here);
  ASSERT_EQ(expert.size(), static_cast<std::size_t>(trials));
  ASSERT_EQ(novice.size(), static_cast<std::size_t>(trials));
  for (const Row& row : expert) {
    EXPECT_EQ(row.at("SIMULATED"), "1");
    EXPECT_EQ(row.at("OUTCOME"), "done");
    EXPECT_LT(std::stod(row.at("PEAK_N")), 2);
  }
  if (!test::fullCounts()) {
    EXPECT_GE(shareOf(expert, isFound), 0.6);
    return;
  }
  EXPECT_GE(shareOf(expert, isFound), 0.95);
  EXPECT_GE(shareOf(expert, isCounted), 0.95);
  EXPECT_GE(shareOf(expert, isTold), 0.9);
  // Two shares of equally many: z = (p - q) / sqrt((p (1-p) + q (1-q)) / n), one-sided 1 %: 2.33
  for (const auto& holds : {isFound, isCounted, isRight}) {
    const double p = shareOf(expert, holds), q = shareOf(novice, holds);
    EXPECT_GT(p - q, 2.33 * std::sqrt((p * (1 - p) + q * (1 - q)) / trials));
  }
}

/// Without force nothing beats: nobody finds what is not there.
TEST(Pulse, WithoutForceFeedbackNothingBeats) {
  const Folder here;
  const std::vector<Row> rows =
      examined("expert", test::counted(1, 12), here, {"--force-feedback", "off"});
  for (const Row& row : rows) {
    EXPECT_EQ(row.at("FF"), "0");
    EXPECT_FALSE(isRight(row));
  }
}

TEST(Pulse, IsReplayedBitForBitAndScoredTheSame) {
  const Folder here;
  ASSERT_EQ(examined("expert", 2, here).size(), 2u);
  const Outcome replayed = palpa({"replay", "expert/session.palpa"}, here.path());
  ASSERT_EQ(replayed.exit_code, 0) << replayed.err;
  EXPECT_TRUE(says(replayed.out, ": 0 differ")) << replayed.out;
  EXPECT_TRUE(says(replayed.out, "The replay equals the record")) << replayed.out;
  const std::string page = contentOf(here / "expert/report.html");
  EXPECT_TRUE(says(page, "What a good examiner does"));
  EXPECT_TRUE(says(page, "imulated"));
}

}  // namespace
}  // namespace palpa::cli_test
