#include <cmath>

#include "calibration/clock_offset.h"
#include "calibration/force_sensor.h"
#include "calibration/registration.h"
#include "calibration/rotation.h"
#include "tests/support/complaint.h"

namespace palpa::calibration {
namespace {

using palpa::test::complaint;
using palpa::test::says;

Vec3 unsteady(double t) {
  return 0.03 * Vec3(std::sin(2.1 * t) + std::sin(5.3 * t + 1), std::cos(3.3 * t + 0.5),
                     std::sin(1.3 * t) * std::cos(4.1 * t));
}

template <class F>
std::vector<TimedPoint> recorded(F path, double from, double to, double step) {
  std::vector<TimedPoint> all;
  for (double t = from; t < to; t += step) all.push_back({t, path(t)});
  return all;
}

TEST(ClockOffset, OfPerfectRecordingsAtUnequalRatesIsExact) {
  const Pose X_CD = makePose(rotationOf(Vec3(1, 2, -0.5)), Vec3(0, 0, 0.5));
  for (const double offset : {0.0413, -0.7, 1.2}) {
    const auto camera =
        recorded([&](double t) -> Vec3 { return X_CD * unsteady(t + offset); }, 0.0, 15, 1 / 29.97);
    const auto device = recorded(unsteady, -2, 18, 0.001);
    const ClockOffset found = estimateClockOffset(camera, device);
    EXPECT_NEAR(found.offset, offset, 1e-6);
    EXPECT_NEAR(found.drift, 0, 1e-7);
    EXPECT_LT((found.X_CD.matrix() - X_CD.matrix()).norm(), 1e-4);
  }
}

TEST(ClockOffset, WhatTheRecordingsCannotTellIsNamed) {
  const auto device = recorded(unsteady, 0, 15, 0.002);
  const auto still = recorded([](double) -> Vec3 { return {0.1, 0.2, 0.3}; }, 0, 15, 1 / 30.0);
  EXPECT_TRUE(says(complaint([&] { estimateClockOffset(still, device); }), "hardly any motion"));
  const auto other = recorded(
      [](double t) -> Vec3 {
        return 0.05 * Vec3(std::sin(0.9 * t * t / 5), std::cos(1.7 * t), std::sin(7 * t));
      },
      0, 15, 1 / 30.0);
  EXPECT_TRUE(
      says(complaint([&] { estimateClockOffset(other, device); }), "did not see the same motion"))
      << complaint([&] { estimateClockOffset(other, device); });
  const auto swing = [](double t) -> Vec3 {
    return 0.05 * Vec3(std::sin(6 * t), 0.3 * std::cos(6 * t), 0);
  };
  EXPECT_TRUE(says(complaint([&] {
                     estimateClockOffset(recorded(swing, 3, 12, 1 / 30.0),
                                         recorded(swing, 0, 15, 0.002));
                   }),
                   "repeats itself"));
  EXPECT_TRUE(
      says(complaint([&] { estimateClockOffset(recorded(unsteady, 0, 1, 1 / 30.0), device); }),
           "too few"));
  auto backwards = recorded(unsteady, 0, 15, 1 / 30.0);
  std::swap(backwards[5], backwards[6]);
  EXPECT_TRUE(says(complaint([&] { estimateClockOffset(backwards, device); }), "backwards"));
  EXPECT_TRUE(
      says(complaint([&] { estimateClockOffset(recorded(unsteady, 100, 115, 1 / 30.0), device); }),
           "share too little time"));
}

StaticReading reading(const Mat3& R, double mass = 0.15) {
  const Vec3 w = 9.80665 * mass * R.transpose() * -Vec3::UnitZ();
  return {R, Vec3(0.3, -0.2, 0.5) + w,
          Vec3(0.01, 0.02, -0.005) + Vec3(0.002, -0.003, 0.06).cross(w)};
}
Mat3 turned(int i) { return rotationOf(Vec3(1.1 * i, std::sin(2.0 * i), 0.4 * i)); }

TEST(ForceSensor, OfPerfectReadingsIsExact) {
  std::vector<StaticReading> readings;
  for (int i = 0; i < 12; ++i) readings.push_back(reading(turned(i)));
  const ForceSensorCalibration found = calibrateForceSensor(readings, -Vec3::UnitZ());
  EXPECT_NEAR(found.mass, 0.15, 1e-9);
  EXPECT_LT((found.bias_f - Vec3(0.3, -0.2, 0.5)).norm(), 1e-9);
  EXPECT_LT((found.centre_S - Vec3(0.002, -0.003, 0.06)).norm(), 1e-8);
  EXPECT_FALSE(found.cross_talk_found);
}

TEST(ForceSensor, CrossTalkIsFound) {
  std::vector<StaticReading> readings;
  Mat3 talk = Mat3::Identity();
  talk(0, 2) = 0.08;
  for (int i = 0; i < 24; ++i) {
    readings.push_back(reading(turned(i)));
    readings.back().f_S = talk * readings.back().f_S;
  }
  EXPECT_TRUE(calibrateForceSensor(readings, -Vec3::UnitZ()).cross_talk_found);
}

TEST(ForceSensor, WhatTheReadingsCannotTellIsNamed) {
  const auto of = [](auto make) {
    std::vector<StaticReading> readings;
    for (int i = 0; i < 12; ++i) readings.push_back(make(i));
    return complaint([&] { calibrateForceSensor(readings, -Vec3::UnitZ()); });
  };
  EXPECT_TRUE(says(of([](int i) { return reading(rotationOf(Vec3(0, 0, 0.5 * i))); }),
                   "against the vertical"));
  EXPECT_TRUE(
      says(of([](int i) { return reading(rotationOf(Vec3(0.35 * std::sin(1.0 * i), 0, 0))); }),
           "small arc"));
  EXPECT_TRUE(says(of([](int i) { return reading(turned(i), -0.15); }), "less than nothing"));
  EXPECT_TRUE(says(of([](int i) { return reading(turned(i), 0); }), "feels no weight"));
  EXPECT_TRUE(says(of([](int i) {
                     auto r = reading(turned(i));
                     if (i == 4) r.f_S.x() = std::nan("");
                     return r;
                   }),
                   "not a number"));
}

std::vector<TouchedPoint> grid(double bend, int heights = 3) {
  std::vector<TouchedPoint> points;
  const Pose X_GD = makePose(rotationOf(Vec3(0.1, 0.2, 0.3)), Vec3(0.05, 0, 0));
  for (int i = 0; i < 5; ++i)
    for (int j = 0; j < 5; ++j)
      for (int k = 0; k < heights; ++k) {
        const Vec3 p(0.03 * i, 0.03 * j, 0.04 * k), q = p / 0.1;
        points.push_back({X_GD * Vec3(p + bend * Vec3(q.x() * q.y(), q.z() * q.z(), q.x())), p});
      }
  return points;
}

TEST(WorkspaceMap, CorrectsASmoothDistortionAndSaysByHowMuch) {
  const WorkspaceMap map = mapWorkspace(grid(2e-3));
  EXPECT_EQ(map.order, 2);
  EXPECT_GT(map.rms_before, 3e-4);
  EXPECT_LT(map.rms_after, 1e-8);
  EXPECT_LT(map.left_out_after, 1e-7);
}

TEST(WorkspaceMap, ADeviceThatIsRightIsLeftAsItIs) {
  auto points = grid(0);
  unsigned state = 5;
  for (TouchedPoint& p : points)
    for (int k = 0; k < 3; ++k)
      p.p_G[k] += 2e-4 * (((state = state * 1664525u + 1013904223u) >> 16) % 2001 / 1000.0 - 1);
  EXPECT_EQ(mapWorkspace(points).order, 0);
}

TEST(WorkspaceMap, WhatThePointsCannotTellIsNamed) {
  EXPECT_TRUE(says(complaint([] { mapWorkspace(grid(0, 1)); }), "in one plane"));
  auto millimetres = grid(0);
  for (TouchedPoint& p : millimetres) p.p_G *= 1000;
  EXPECT_TRUE(says(complaint([&] { mapWorkspace(millimetres); }), "another unit"));
  std::vector<TouchedPoint> few = grid(0);
  few.resize(6);
  EXPECT_TRUE(says(complaint([&] { mapWorkspace(few); }), "too few"));
}

}  // namespace
}  // namespace palpa::calibration
