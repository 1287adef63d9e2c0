#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "anatomy/base/error.h"
#include "apps/station/station_sections.h"

namespace palpa::station {
namespace {

using nlohmann::json;

/// The section with this beside what it must have.
ForceSensorSetup sensorWith(const json& more) {
  json sensor{{"driver", "virtual"},
              {"name", "six axes"},
              {"max_force_N", {40, 40, 120}},
              {"X_ES", {{"position_mm", {0, 0, 80}}, {"rotation_vector_deg", {0, 0, 0}}}},
              {"tool", {{"mass_g", 12}, {"centre_mm", {0, 0, 15}}}},
              {"bias", {{"force_N", {0.2, -0.1, 0.4}}, {"torque_Nm", {0, 0, 0}}}}};
  sensor.update(more);
  return *readForceSensor(JsonFile(json{{"force_sensor", sensor}}, "my_station.json"));
}

std::string whySensorRefused(const json& more) {
  try {
    sensorWith(more);
  } catch (const UsageError& e) {
    return e.what();
  }
  return "";
}

TEST(ForceSensorSection, HasALowPassOrIfItsNoiseIsKnownAKalmanFilter) {
  const ForceSensorSetup low_passed = sensorWith({{"cutoff_Hz", 60}}),
                         kalman = sensorWith({{"noise_N", 0.005}});
  EXPECT_FALSE(low_passed.noise_N);
  EXPECT_EQ(low_passed.cutoff_Hz, 60);
  EXPECT_EQ(kalman.noise_N, 0.005);
  EXPECT_NEAR(kalman.tool.mass, 0.012, 1e-12);
  EXPECT_EQ(kalman.bias.f_S, (Packed3{0.2, -0.1, 0.4}));
}

TEST(ForceSensorSection, BothOrNeitherIsRefusedByName) {
  const std::string both = whySensorRefused({{"cutoff_Hz", 60}, {"noise_N", 0.005}}),
                    neither = whySensorRefused(json::object());
  EXPECT_NE(both.find("state one of the two"), std::string::npos) << both;
  EXPECT_NE(neither.find("state one of the two"), std::string::npos) << neither;
  EXPECT_NE(whySensorRefused({{"noise_N", 0}}).find("noise_N"), std::string::npos);
}

}  // namespace
}  // namespace palpa::station
