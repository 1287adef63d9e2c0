#include "apps/task_palpation/sensor_check.h"

#include <gtest/gtest.h>

#include <cmath>

namespace palpa::task_palpation {
namespace {

const haptics::HuntCrossley kSilicone{900, 0, 1.4};

haptics::TickConfig checkedConfig() {
  haptics::TickConfig c;
  c.touch.tip_radius = 0.008;
  c.touch.surface.contact.real = kSilicone;
  c.touch.surface.contact.least_contact = 0.1;
  c.X_DP =
      pack(makePose(Eigen::AngleAxisd(0.5, Vec3::UnitX()).toRotationMatrix(), Vec3(0.1, 0, 0)));
  return c;
}

/// Presses of 6 mm, one a second, from 5 mm over the top; what the sensor makes of them.
template <class Shown>
std::string heardOf(const Shown& shown, int presses) {
  const haptics::TickConfig config = checkedConfig();
  SensorCheck check(config);
  for (int i = 0; i < 1000 * presses; ++i) {
    const double height = -5e-4 + 5.5e-3 * std::cos(2 * 3.14159265 * i * 1e-3);
    haptics::FlightRecord r;
    r.t_ns = 1'000'000LL * i;
    const Pose X_DP = unpack(config.X_DP);
    r.sensed = {pack(Vec3(X_DP.linear() *
                          Vec3(0.01, 0, shown(haptics::forceOf(kSilicone, -height, 0), 1e-3 * i)))),
                pack(Vec3(X_DP * Vec3(0, 0, height + 0.008))),
                haptics::SensorState::valid,
                {}};
    if (std::string words = check.add(r); !words.empty()) return words;
  }
  return "";
}

bool names(const std::string& words, const char* what) {
  return words.find(what) != std::string::npos;
}

TEST(SensorCheck, ASensorThatTellsTheTruthIsBelieved) {
  EXPECT_EQ(heardOf([](double f, double) { return f; }, 30), "");
  EXPECT_EQ(heardOf([](double f, double) { return 1.4 * f + 0.05; }, 30), "")
      << "a millimetre more, a zero that is a little off";
}

TEST(SensorCheck, WhatCannotBeMeantIsNamed) {
  EXPECT_TRUE(names(heardOf([](double f, double t) { return f + 0.02 * t; }, 30), "drifted"));
  EXPECT_TRUE(names(heardOf([](double f, double t) { return f - 0.02 * t; }, 30), "drifted"));
  EXPECT_TRUE(names(heardOf([](double f, double) { return -f; }, 2), "sign is wrong"));
  EXPECT_TRUE(names(heardOf([](double f, double) { return 0.3 * f; }, 8), "0.3 times"));
  EXPECT_TRUE(names(heardOf([](double f, double) { return 3 * f; }, 8), "3.0 times"));
  EXPECT_TRUE(names(heardOf([](double, double) { return 0.0; }, 8), "another phantom"))
      << "nothing lies there";
}

TEST(SensorCheck, OnePressIsNoReason) {
  EXPECT_EQ(heardOf([](double f, double t) { return t < 1 ? 3 * f : f; }, 12), "");
}

}  // namespace
}  // namespace palpa::task_palpation
