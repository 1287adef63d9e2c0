#include <gtest/gtest.h>

#include <fstream>
#include <map>
#include <nlohmann/json.hpp>

#include "program.h"
#include "tests/support/counts.h"

/// What the tracker promises, measured as anyone can; in short with pictures of three quarters the
/// size, in which it has it harder. Costs are no promises: they are not looked at here.
namespace palpa::cli_test {
namespace {

TEST(BenchTracking, HoldsWhatIsPromised) {
  const Folder here;
  std::vector<std::string> arguments{"bench", "tracking"};
  if (!test::fullCounts())
    arguments.insert(arguments.end(), {"--quick", "--width", "480", "--height", "360"});
  const Outcome outcome = palpa(arguments, here.path());
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  std::map<std::string, double> value;
  for (const nlohmann::json& metric : jsonLines(outcome)) {
    value[metric["metric"]] = metric["value"];
    EXPECT_EQ(metric["params"]["data"], "simulated");
    EXPECT_TRUE(metric["params"].contains("resolution"));
  }
  EXPECT_LE(value.at("pose_rmse_over_crlb"), 1.2);
  EXPECT_LE(value.at("still_jitter_mm"), 0.05);
  EXPECT_LE(std::abs(value.at("motion_lag_ms")), 8);
  EXPECT_LE(value.at("overlay_error_px"), 1.0);
  EXPECT_LE(value.at("overlay_error_mm"), 0.5);
  EXPECT_LE(value.at("recovery_frames"), 2);
  EXPECT_EQ(value.at("false_poses"), 0);
  EXPECT_EQ(value.at("flip_rate"), 0);
  EXPECT_TRUE(value.contains("roi_speedup"));  // a cost: shown, not judged here
}

/// The tracking model: its figures as lines and as a file that a station can name, and then the
/// model beside pictures.
TEST(BenchTracking, MeasuresTheTrackingModelAndComparesIt) {
  const Folder here;
  Outcome outcome = palpa({"bench", "tracking", "--fit", "figures.json", "--quick"}, here.path());
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  std::map<std::string, int> lines;
  for (const nlohmann::json& line : jsonLines(outcome)) {
    ++lines[line.at("metric").get<std::string>()];
    EXPECT_EQ(line["params"]["data"], "simulated");
  }
  EXPECT_EQ(lines["tracking_model.corner_sigma"], 2);
  EXPECT_EQ(lines["tracking_model.width_spread"], 1);
  nlohmann::json station = nlohmann::json::parse(
      std::ifstream(std::string(PALPA_SOURCE_DIR) + "/assets/stations/virtual_bench.json"));
  station["twin"]["tracking_figures"] = "figures.json";
  std::ofstream(here.path() / "station.json") << station;
  outcome = palpa({"bench", "tracking", "--model", "--sessions", "1", "--station", "station.json"},
                  here.path());
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  for (const char* metric : {"shift_rms", "turn_rms", "filtered_shift_rms", "filtered_turn_rms",
                             "tags_missed", "poses_missed", "autocorrelation_difference"})
    EXPECT_NE(outcome.out.find("tracking_model." + std::string(metric)), std::string::npos)
        << metric;
}

}  // namespace
}  // namespace palpa::cli_test
