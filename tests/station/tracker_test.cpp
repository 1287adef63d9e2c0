#include "apps/station/station_sections.h"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <numbers>

#include "anatomy/base/error.h"

namespace palpa::station {
namespace {

using nlohmann::json;

json least() {
  const json at{{"position_mm", {10, 0, -20}}, {"rotation_vector_deg", {0, 0, 90}}};
  return {{"driver", "plus"}, {"transform", "ReferenceToCamera"}, {"X_CK", at}, {"X_RW", at}};
}

std::optional<TrackerSetup> read(const json& tracker) {
  return readTracker(JsonFile(json{{"tracker", tracker}}, "my_station.json"));
}

TEST(TrackerSection, LeastOfItIsEnough) {
  EXPECT_FALSE(readTracker(JsonFile(json::object(), "my_station.json")));
  const auto tracker = read(least());
  ASSERT_TRUE(tracker);
  EXPECT_EQ(tracker->host, "localhost");
  EXPECT_EQ(tracker->port, 18944) << "PLUS' own";
  EXPECT_EQ(tracker->ask_tdata_ms, 0);
  EXPECT_TRUE(tracker->X_CK.translation().isApprox(Vec3(0.01, 0, -0.02)));
  EXPECT_TRUE((tracker->X_RW.linear() * Vec3::UnitX()).isApprox(Vec3::UnitY(), 1e-12));
}

TEST(TrackerSection, MillisecondsMillimetresAndDegreesEndHere) {
  json all = least();
  all.update({{"host", "192.168.1.7"},
              {"port", 18945},
              {"latency_ms", 15},
              {"stale_ms", 200},
              {"sigma_mm", 0.5},
              {"sigma_deg", 1},
              {"ask_tdata_ms", 20}});
  const auto tracker = read(all);
  ASSERT_TRUE(tracker);
  EXPECT_EQ(tracker->host, "192.168.1.7");
  EXPECT_EQ(tracker->port, 18945);
  EXPECT_DOUBLE_EQ(tracker->latency_s, 0.015);
  EXPECT_DOUBLE_EQ(tracker->stale_s, 0.2);
  EXPECT_DOUBLE_EQ(tracker->sigma, 0.5e-3);
  EXPECT_DOUBLE_EQ(tracker->sigma_rad, std::numbers::pi / 180);
  EXPECT_EQ(tracker->ask_tdata_ms, 20);
}

TEST(TrackerSection, WhatIsWrongIsNamed) {
  const std::pair<const char*, json> wrong[] = {{"driver", "optical"},
                                                {"transform", "Camera"},
                                                {"transform", "ToCamera"},
                                                {"transform", "ReferenceTo"},
                                                {"port", 0},
                                                {"port", 65536},
                                                {"port", "18944"},
                                                {"latency_ms", -1},
                                                {"stale_ms", 0},
                                                {"sigma_mm", 0},
                                                {"sigma_deg", 90},
                                                {"ask_tdata_ms", 0},
                                                {"X_CK", 3},
                                                {"X_RW", json::object()},
                                                {"host", 7}};
  for (const auto& [field, value] : wrong) {
    json changed = least();
    changed[field] = value;
    try {
      read(changed);
      ADD_FAILURE() << field << " " << value << " was taken";
    } catch (const UsageError& e) {
      const std::string words = e.what();
      EXPECT_NE(words.find("my_station.json"), std::string::npos) << words;
      EXPECT_NE(words.find(std::string("tracker/") + field), std::string::npos) << words;
    }
  }
  for (const char* field : {"driver", "transform", "X_CK", "X_RW"}) {
    json without = least();
    without.erase(field);
    EXPECT_THROW(read(without), UsageError) << field;
  }
}

}  // namespace
}  // namespace palpa::station
