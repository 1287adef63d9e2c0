#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "apps/session/session_facts.h"
#include "apps/session/session_options.h"
#include "apps/station/assets.h"
#include "apps/station/station_file.h"

namespace palpa::session {
namespace {

SessionOptions atAWindow() {
  SessionOptions options;
  options.display = scene::Display::window;
  return options;
}

SessionOptions with(bool SessionOptions::*field, bool value, SessionOptions options = atAWindow()) {
  options.*field = value;
  return options;
}

TEST(Heard, InRealTimeByWhoeverSeesIt) {
  EXPECT_TRUE(mayHear(atAWindow()));
  SessionOptions worn;
  worn.display = scene::Display::offscreen;
  EXPECT_FALSE(mayHear(worn)) << "nobody sees it";
  EXPECT_TRUE(mayHear(with(&SessionOptions::headset, true, worn)));
  EXPECT_FALSE(mayHear(with(&SessionOptions::sound, false)));
  EXPECT_FALSE(mayHear(with(&SessionOptions::fast, true)));
  EXPECT_FALSE(mayHear(with(&SessionOptions::no_views, true)));
}

std::string soundIn(const SessionOptions& options) {
  const station::Station bench =
      station::readStation(station::assetFile("stations") / "virtual_bench.json");
  for (const report::Fact& fact : headOf(options, "", {}, bench, true).station)
    if (fact.name == "Sound") return fact.value;
  return "";
}

TEST(Heard, IsAFactOfTheSession) {
  EXPECT_EQ(soundIn(atAWindow()), "on");
  EXPECT_EQ(soundIn(with(&SessionOptions::sound, false)), "off");
  SessionOptions offscreen;
  offscreen.display = scene::Display::offscreen;
  EXPECT_EQ(soundIn(offscreen), "") << "there is none to be turned off";
  for (const bool on : {true, false}) {
    const SessionOptions options = with(&SessionOptions::sound, on);
    const record::SessionInfo info =
        infoOf(options, headOf(options, "", {}, {}, false), R"({"id": "any"})");
    EXPECT_EQ(nlohmann::json::parse(info.session_json).at("sound"), on);
  }
}

}  // namespace
}  // namespace palpa::session
