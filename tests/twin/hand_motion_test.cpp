#include <gtest/gtest.h>

#include <cmath>
#include <complex>
#include <numbers>
#include <vector>

#include "apps/twin/hand_motion.h"

namespace palpa::twin {
namespace {

const Pose kFrom = makePose(Mat3::Identity(), {0.1, 0, 0});
const Pose kTo = makePose(rotationWithZ(Vec3(1, 0, 1).normalized()), {0.1, 0.2, -0.1});

TEST(MinJerk, BeginsAndEndsExactlyAndAtRest) {
  const MinJerk move(kFrom, kTo, 2.0, 1.5);
  EXPECT_EQ(Vec3(move.at(0).translation()), Vec3(kFrom.translation()));
  EXPECT_EQ(Vec3(move.at(2.0).translation()), Vec3(kFrom.translation()));
  for (const double t : {3.5, 4.0, 100.0}) {
    EXPECT_LT((move.at(t).translation() - kTo.translation()).norm(), 1e-16);
    EXPECT_LT((move.at(t).rotation() - kTo.rotation()).norm(), 1e-12);
  }
  // Speed and acceleration vanish at both ends: s(u) ~ 10 u^3.
  const double u = 1e-3;
  EXPECT_LT((move.at(2 + 1.5 * u).translation() - kFrom.translation()).norm(),
            10.01 * u * u * u * 0.2237);
  EXPECT_LT((move.at(2 + 1.5 * (1 - u)).translation() - kTo.translation()).norm(),
            10.01 * u * u * u * 0.2237);
}

TEST(MinJerk, PeakSpeedIs1875TimesTheMeanAndInTheMiddle) {
  const double duration = 0.8, h = 1e-4;
  const MinJerk move(kFrom, kTo, 0, duration);
  const double mean = (kTo.translation() - kFrom.translation()).norm() / duration;
  double peak = 0, when = 0;
  for (double t = h; t < duration; t += h) {
    const double v = (move.at(t + h).translation() - move.at(t - h).translation()).norm() / (2 * h);
    if (v > peak) peak = v, when = t;
  }
  EXPECT_NEAR(peak / mean, 1.875, 1e-5);  // central difference: h^2 s'''/6
  EXPECT_NEAR(when, duration / 2, 2 * h);
}

TEST(MinJerk, IsStraightAndSymmetric) {
  const MinJerk move(kFrom, kTo, 0, 1);
  const Vec3 along = (kTo.translation() - kFrom.translation()).normalized();
  for (double t = 0; t <= 1; t += 0.01) {
    const Vec3 d = move.at(t).translation() - kFrom.translation();
    EXPECT_LT((d - along * along.dot(d)).norm(), 1e-15);
    const Vec3 mirrored = kTo.translation() - move.at(1 - t).translation();
    EXPECT_LT((d - mirrored).norm(), 1e-15);
  }
  EXPECT_FALSE(move.done(0.999));
  EXPECT_TRUE(move.done(1.0));
}

TEST(MinJerk, WithoutDurationItJumpsAndDoesNotDivideByZero) {
  const MinJerk move(kFrom, kTo, 1, 0);
  EXPECT_TRUE(move.at(1).matrix().allFinite());
  EXPECT_LT((move.at(1.001).translation() - kTo.translation()).norm(), 1e-15);
}

/// 200 s of tremor at 1 kHz: of its variance 2 B T = 2 * 4.7 Hz * 200 s * 3 axes = 5,640 are
/// independent, so that the rms is known to 1 / sqrt(2 * 5640) = 0.9 %; the bound of 10 % is the
/// stated one.
constexpr double kRms = 60e-6;

std::vector<Vec3> tremor(double seconds, double dt) {
  Tremor source(kRms, RandomStream(11, "test.tremor"));
  for (int i = 0; i < static_cast<int>(1 / dt); ++i)
    source.next(dt);  // 1 s: ten time constants to settle
  std::vector<Vec3> path;
  for (int i = 0; i < static_cast<int>(seconds / dt); ++i) path.push_back(source.next(dt));
  return path;
}

TEST(Tremor, HasTheStatedRms) {
  const std::vector<Vec3> path = tremor(200, 0.001);
  for (int axis = 0; axis < 3; ++axis) {
    double squares = 0;
    for (const Vec3& x : path) squares += x[axis] * x[axis];
    EXPECT_NEAR(std::sqrt(squares / static_cast<double>(path.size())), kRms, 0.10 * kRms) << axis;
  }
}

/// Power of one axis between two frequencies: periodogram over windows of one second.
double power(const std::vector<Vec3>& path, int low_Hz, int high_Hz) {
  const std::size_t window = 1000;
  double sum = 0;
  for (std::size_t start = 0; start + window <= path.size(); start += window)
    for (int f = low_Hz; f <= high_Hz; ++f) {
      std::complex<double> bin = 0;
      for (std::size_t i = 0; i < window; ++i)
        bin += path[start + i].x() *
               std::polar(1.0, -2 * std::numbers::pi * f * static_cast<double>(i) / window);
      sum += std::norm(bin);
    }
  return sum;
}

TEST(Tremor, ItsPowerLiesBetween8And12Hz) {
  const std::vector<Vec3> path = tremor(30, 0.001);
  const double band = power(path, 8, 12), below = power(path, 1, 7), above = power(path, 13, 60);
  EXPECT_GT(band, 0.5 * (band + below + above));
  // Per hertz it is far above its neighbours: half power at 8.5 and 11.5 Hz.
  EXPECT_GT(band / 5, 4 * power(path, 2, 4) / 3);
  EXPECT_GT(band / 5, 10 * power(path, 18, 22) / 5);
}

TEST(Tremor, AxesAreIndependentAndTheSameSeedRepeats) {
  const std::vector<Vec3> a = tremor(20, 0.001), b = tremor(20, 0.001);
  double xy = 0, xx = 0;
  for (std::size_t i = 0; i < a.size(); ++i) {
    ASSERT_EQ(a[i], b[i]);
    xy += a[i].x() * a[i].y();
    xx += a[i].x() * a[i].x();
  }
  EXPECT_LT(std::abs(xy / xx), 0.36);  // 5 / sqrt(2 B T), 2 * 4.7 Hz * 20 s = 188
}

TEST(Tremor, WithoutAmplitudeTheHandIsStill) {
  Tremor still(0, RandomStream(1, "x"));
  for (int i = 0; i < 100; ++i) EXPECT_EQ(still.next(0.001), Vec3(Vec3::Zero()));
}

}  // namespace
}  // namespace palpa::twin
