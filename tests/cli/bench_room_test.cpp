#include <gtest/gtest.h>
#include <unistd.h>

#include <map>
#include <nlohmann/json.hpp>

#include "program.h"

/// What arrives in a room, and which lines there are; how late a tick is is not judged here.
namespace palpa::cli_test {
namespace {

constexpr char kStations[] = "3";

TEST(BenchRoom, EveryRecordedEventArrivesOnceThoughStationsAndBrokerAreKilled) {
  if (::access("/usr/sbin/mosquitto", X_OK) != 0) GTEST_SKIP() << "mosquitto is not installed";
  const Folder here;
  const Outcome outcome = palpa({"bench", "room", "--stations", kStations, "--blocks", "1",
                                 "--seconds", "4", "--records", "records.sqlite"},
                                here.path());
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  std::map<std::string, double> values;
  nlohmann::json params;
  for (const nlohmann::json& metric : jsonLines(outcome)) {
    values[metric["metric"]] = metric["value"].is_number() ? metric["value"].get<double>() : -1;
    if (metric["metric"] == "events_recorded") params = metric["params"];
  }
  EXPECT_EQ(params["stations_killed"], std::stoi(kStations));
  EXPECT_EQ(params["computers_switched_off"], 1);
  EXPECT_EQ(params["broker_killed"], 1);
  EXPECT_GE(params["session_files"], 4);
  EXPECT_GT(values["events_recorded"], 20);
  EXPECT_EQ(values["events_arrived"], values["events_recorded"]);
  for (const char* none :
       {"events_missing", "events_doubled", "events_out_of_order", "events_changed"})
    EXPECT_EQ(values[none], 0) << none;
  EXPECT_GT(values["trials_in_records"], 0);
  for (const char* there :
       {"lateness_p99", "lateness_ratio_p99", "lateness_ratio_p99_low", "lateness_ratio_p99_high"})
    EXPECT_GT(values[there], 0) << there;
}

TEST(BenchRoom, ADatabaseThatHoldsSomebodyIsLeftAlone) {
  const Folder here;
  ASSERT_EQ(palpa({"records", "trainee", "add", "--id", "T007", "--records", "records.sqlite"},
                  here.path())
                .exit_code,
            0);
  const Outcome outcome = palpa({"bench", "room", "--records", "records.sqlite"}, here.path());
  EXPECT_EQ(outcome.exit_code, 2);
  EXPECT_TRUE(says(outcome.err, "holds records already")) << outcome.err;
}

}  // namespace
}  // namespace palpa::cli_test
