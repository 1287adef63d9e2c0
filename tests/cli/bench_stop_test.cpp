#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <set>
#include <sstream>

#include "program.h"

/// Which lines there are; how many milliseconds is not judged here.
namespace palpa::cli_test {
namespace {

TEST(BenchStop, MeasuresEverySourceWithEveryHungPart) {
  const Folder here;
  const Outcome outcome = palpa({"bench", "stop", "--presses", "2"}, here.path());
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  std::set<std::string> metrics;
  std::istringstream lines(outcome.out);
  for (std::string line; std::getline(lines, line);) {
    const auto metric = nlohmann::json::parse(line);
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

}  // namespace
}  // namespace palpa::cli_test
