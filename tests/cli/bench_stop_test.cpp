#include <gtest/gtest.h>

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
  std::set<std::string> stages;
  double shares = 0;
  for (const nlohmann::json& metric : jsonLines(outcome)) {
    EXPECT_GT(metric["value"], 0) << metric;
    EXPECT_EQ(metric["params"]["data"], "simulated");
    EXPECT_EQ(metric["params"]["tracking"], "images");
    if (metric["metric"] == "stage_share") {
      shares += metric["value"].get<double>();
      stages.insert(metric["params"]["stage"]);
    } else {
      metrics.insert(metric["metric"]);
    }
  }
  const std::multiset<std::string> expected{"start_seconds", "start_seconds", "times_real_time"};
  EXPECT_EQ(metrics, expected);
  EXPECT_NEAR(shares, 1, 1e-9);
  for (const char* stage : {"haptic", "bench", "geometry", "camera", "task", "scene", "recorder",
                            "drawing", "tracking", "rest"})
    EXPECT_EQ(stages.count(stage), 1u) << stage;
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
