#include <gtest/gtest.h>

#include <cstdlib>
#include <fstream>
#include <functional>
#include <nlohmann/json.hpp>
#include <optional>

#include "program.h"

/// The doctor asked as an educator asks it.
namespace palpa::cli_test {
namespace {

struct Answer {
  int exit_code = -1;
  nlohmann::json json;
  std::string err;

  /// Of one subject; null where nothing was said of it.
  nlohmann::json of(const std::string& subject) const {
    for (const nlohmann::json& finding : json.at("findings"))
      if (finding.at("subject") == subject) return finding;
    return nullptr;
  }
};

/// Of this computer's own state only what a test is about.
void settle(const Folder& here) {
  ::setenv("LC_ALL", "C.UTF-8", 1);
  ::setenv("XDG_STATE_HOME", here.path().c_str(), 1);
}

Answer asked(const Folder& here, std::vector<std::string> more = {}) {
  settle(here);
  std::vector<std::string> arguments{"doctor", "--json", "--records", "records.sqlite"};
  arguments.insert(arguments.end(), more.begin(), more.end());
  const Outcome o = palpa(arguments, here.path());
  return {o.exit_code, nlohmann::json::parse(o.out), o.err};
}

std::string stationWith(const Folder& here, const std::function<void(nlohmann::json&)>& change) {
  std::ifstream stream(PALPA_SOURCE_DIR "/assets/stations/virtual_bench.json");
  nlohmann::json station = nlohmann::json::parse(stream);
  change(station);
  return here.file("station.json", station.dump());
}

TEST(Doctor, OfAHealthyBenchNothingIsNamed) {
  const Folder here;
  const Answer answer = asked(here);
  EXPECT_EQ(answer.exit_code, 0) << answer.err;
  EXPECT_EQ(answer.json["can_start"], true);
  EXPECT_GE(answer.json["findings"].size(), 12u);
  for (const nlohmann::json& finding : answer.json["findings"]) {
    EXPECT_TRUE(finding["state"] == "well" || finding["state"] == "none") << finding.dump();
    EXPECT_EQ(finding["fix"], "") << finding.dump();
  }
  EXPECT_TRUE(here.files().empty()) << "it changes nothing";
  const Outcome words = palpa({"doctor", "--records", "records.sqlite"}, here.path());
  EXPECT_EQ(words.exit_code, 0);
  EXPECT_TRUE(says(words.out, "The station is well.")) << words.out;
}

TEST(Doctor, WhatIsIllKeepsASessionFromStarting) {
  const Folder here;
  const Answer damaged = asked(here, {"--station", here.file("damaged.json", "{\"version\": 1,")});
  EXPECT_EQ(damaged.exit_code, 1);
  EXPECT_EQ(damaged.json["can_start"], false);
  EXPECT_EQ(damaged.of("station")["state"], "ill");
  EXPECT_TRUE(says(damaged.err, "station")) << damaged.err;

  const Answer no_camera = asked(here, {"--station", stationWith(here, [](nlohmann::json& s) {
                                          s["camera"]["driver"] = "webcam",
                                          s["camera"]["device"] = "/dev/video99",
                                          s["camera"]["exposure_ms"] = 10;
                                        })});
  EXPECT_EQ(no_camera.exit_code, 1);
  EXPECT_EQ(no_camera.of("camera")["state"], "ill") << no_camera.json.dump(1);
  EXPECT_TRUE(says(no_camera.of("camera")["verdict"], "/dev/video99")) << no_camera.json.dump(1);

  const Answer no_falcon =
      asked(here, {"--station", PALPA_SOURCE_DIR "/assets/stations/falcon.json"});
  EXPECT_EQ(no_falcon.of("haptic device")["state"], "ill") << no_falcon.json.dump(1);
  EXPECT_NE(no_falcon.of("haptic device")["fix"], "");
}

TEST(Doctor, WhatIsWorseButNotIllIsNoted) {
  const Folder here;
  here.file("records.sqlite", "this is no database, and long enough to be told from one");
  ::setenv("XR_RUNTIME_JSON", here.file("runtime.json", "{").c_str(), 1);
  const Answer answer = asked(here);
  ::unsetenv("XR_RUNTIME_JSON");
  EXPECT_EQ(answer.exit_code, 0) << answer.err;
  EXPECT_EQ(answer.of("records")["state"], "note") << answer.json.dump(1);
  EXPECT_EQ(answer.of("headset")["state"], "note") << answer.json.dump(1);
}

}  // namespace
}  // namespace palpa::cli_test
