#include <gtest/gtest.h>

#include <map>
#include <nlohmann/json.hpp>
#include <set>

#include "program.h"

/// Which lines there are; how many milliseconds is not judged here.
namespace palpa::cli_test {
namespace {

TEST(BenchStop, MeasuresEverySourceWithEveryHungPart) {
  const Folder here;
  const Outcome outcome = palpa({"bench", "stop", "--presses", "2"}, here.path());
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  std::set<std::string> metrics;
  for (const nlohmann::json& metric : jsonLines(outcome)) {
    metrics.insert(metric["metric"]);
    EXPECT_EQ(metric["unit"], "ms");
    EXPECT_EQ(metric["params"]["presses"], 2);
    EXPECT_LE(metric["params"]["median_ms"], metric["params"]["max_ms"]);
  }
  std::set<std::string> expected;
  for (const std::string source : {"key", "signal", "console"})
    for (const std::string part : {"none", "scene", "task", "recorder", "camera"})
      expected.insert("stop." + source + "." + part);
  EXPECT_EQ(metrics, expected);
}

TEST(BenchSession, SaysHowSoonAndHowFastAndWhatEveryStageTakes) {
  const Folder here;
  const Outcome outcome = palpa({"bench", "session", "--trials", "1"}, here.path());
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  std::multiset<std::string> metrics;
  std::map<std::string, std::set<std::string>> stages;
  std::map<std::string, double> shares;
  for (const nlohmann::json& metric : jsonLines(outcome)) {
    EXPECT_GT(metric["value"], 0) << metric;
    EXPECT_EQ(metric["params"]["data"], "simulated");
    const std::string tracking = metric["params"]["tracking"];
    if (metric["metric"] == "stage_share") {
      shares[tracking] += metric["value"].get<double>();
      stages[tracking].insert(metric["params"]["stage"]);
    } else {
      metrics.insert(tracking + " " + metric["metric"].get<std::string>());
    }
  }
  const std::multiset<std::string> expected{"images start_seconds", "images start_seconds",
                                            "images times_real_time", "model start_seconds",
                                            "model times_real_time"};
  EXPECT_EQ(metrics, expected);
  EXPECT_NEAR(shares["images"], 1, 1e-9);
  EXPECT_NEAR(shares["model"], 1, 1e-9);
  std::set<std::string> both{"haptic", "bench",    "geometry", "camera", "task",
                             "scene",  "recorder", "progress", "watch",  "rest"};
  EXPECT_EQ(stages["model"], both);
  both.insert({"drawing", "tracking"});
  EXPECT_EQ(stages["images"], both);
}

TEST(BenchRecords, MeasuresPageAndExportOfDrawnTrials) {
  const Folder here;
  const Outcome outcome = palpa({"bench", "records", "--trials", "100"}, here.path());
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  std::multiset<std::string> metrics;
  for (const nlohmann::json& metric : jsonLines(outcome)) {
    EXPECT_GT(metric["value"], 0) << metric;
    EXPECT_EQ(metric["params"]["data"], "simulated");
    EXPECT_EQ(metric["params"]["store"], "sqlite");
    EXPECT_EQ(metric["params"]["trials"], 100);
    metrics.insert(metric["metric"]);
  }
  const std::multiset<std::string> expected{"cohort_peak_mb", "cohort_seconds", "export_peak_mb",
                                            "export_seconds"};
  EXPECT_EQ(metrics, expected);
}

}  // namespace
}  // namespace palpa::cli_test
