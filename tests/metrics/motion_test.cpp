// Motions made by hand whose figures are known.
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <numbers>

#include "anatomy/base/error.h"
#include "apps/assess/metrics/curve_distance.h"
#include "apps/assess/metrics/motion.h"

namespace palpa::metrics {
namespace {

constexpr double kPi = std::numbers::pi;

/// A motion given as functions of time, at 1 kHz.
struct Hand {
  std::function<Vec3(double)> tip = [](double) { return Vec3(0, 0, 0); };
  std::function<Vec3(double)> axis = [](double) { return Vec3(0, 0, -1); };
  std::function<double(double)> inserted = [](double) { return 0.0; };
  std::function<double(double)> force = [](double) { return 0.0; };
  Motion over(double seconds) const {
    std::vector<RawSample> samples;
    for (int i = 0; i < std::lround(1000 * seconds); ++i) {
      const double t = 0.001 * i;
      samples.push_back({t, tip(t), axis(t), inserted(t), force(t)});
    }
    return motionOf(samples);
  }
};

/// 0 to 1 in `seconds`, minimum jerk (Flash and Hogan 1985), from `start`.
double minimumJerk(double t, double seconds, double start = 0) {
  const double u = std::clamp((t - start) / seconds, 0.0, 1.0);
  return u * u * u * (10 - 15 * u + 6 * u * u);
}

TEST(Motion, IsMeansOfTwentyMilliseconds) {
  Hand hand;
  hand.tip = [](double t) { return Vec3(t, 0, 0); };
  const Motion motion = hand.over(1);
  ASSERT_EQ(motion.size(), 50u);
  EXPECT_NEAR(motion.tip[0].x(), 0.0095, 1e-12);
  EXPECT_NEAR(motion.tip[49].x(), 0.9895, 1e-12);
  EXPECT_NEAR(motion.seconds(), 1, 1e-12);
  EXPECT_EQ(motionOf({}).size(), 0u);
}

TEST(Motion, AGapRepeatsWhatWasBefore) {
  const Motion motion = motionOf({{0, {1, 0, 0}}, {0.1, {2, 0, 0}}});
  ASSERT_EQ(motion.size(), 6u);
  for (std::size_t i = 0; i < 5; ++i) EXPECT_EQ(motion.tip[i].x(), 1);
  EXPECT_EQ(motion.tip[5].x(), 2);
}

TEST(Motion, RefusesDamagedRecordings) {
  EXPECT_THROW(motionOf({{1, {0, 0, 0}}, {0.5, {0, 0, 0}}}), Error);
  EXPECT_THROW(motionOf({{0, {NAN, 0, 0}}}), Error);
}

TEST(Motion, SensorNoiseDoesNotAddUpToPath) {
  Hand hand;
  int i = 0;
  hand.tip = [&](double) {
    return Vec3(1e-4 * (++i % 2), 0, 0);
  };  // 0.1 mm to and fro: 1 m in 10 s when summed tick by tick
  EXPECT_LT(pathLength(hand.over(10)), 1e-9);
}

// 80 mm straight in 2 s.
Hand straight() {
  Hand hand;
  hand.tip = [](double t) { return Vec3(0.08 * minimumJerk(t, 2), 0, 0); };
  return hand;
}

TEST(Kinematics, OfAStraightLine) {
  const Motion motion = straight().over(2);
  EXPECT_NEAR(pathLength(motion), 0.08, 1e-5);
  EXPECT_NEAR(pathInefficiency(motion), 0, 1e-9);
  EXPECT_NEAR(meanSpeed(motion), 0.04, 1e-3);
  EXPECT_EQ(boundingBoxVolume(motion), 0);
  EXPECT_EQ(rotationTotal(motion), 0);
}

TEST(Kinematics, OfAHalfCircle) {
  Hand hand;
  hand.tip = [](double t) {
    return Vec3(0.05 * Vec3(std::cos(kPi * t / 2), std::sin(kPi * t / 2), 0));
  };
  hand.axis = [](double t) { return Vec3(std::cos(kPi * t / 2), std::sin(kPi * t / 2), 0); };
  const Motion motion = hand.over(2);
  EXPECT_NEAR(pathLength(motion), 0.05 * 0.99 * kPi,
              1e-4);  // from the middle of the first step to that of the last
  EXPECT_NEAR(pathInefficiency(motion), 0.99 * kPi / 2 - 1, 5e-4);
  EXPECT_NEAR(rotationTotal(motion), 0.99 * kPi, 1e-3);
}

TEST(Kinematics, ABoxIsItsEdges) {
  Motion motion;
  motion.tip = {{0, 0, 0}, {0.02, 0, 0}, {0.02, 0.03, 0}, {0.02, 0.03, 0.05}};
  EXPECT_NEAR(boundingBoxVolume(motion), 0.02 * 0.03 * 0.05, 1e-15);
  EXPECT_NEAR(pathLength(motion), 0.10, 1e-15);
}

TEST(Kinematics, AToolThatReturnsHasNoLine) {
  Motion motion;
  motion.tip = {{0, 0, 0}, {0.05, 0, 0}, {0.009, 0, 0}};
  EXPECT_TRUE(std::isnan(pathInefficiency(motion)));
  EXPECT_TRUE(std::isnan(pathInefficiency(Motion{})));
  EXPECT_TRUE(std::isnan(meanSpeed(Motion{})));
}

TEST(Actions, ThreeMovementsAreThree) {
  Hand hand;  // 80 mm in 0.8 s each, a second's rest between
  hand.tip = [](double t) {
    return Vec3(0.08 * (minimumJerk(t, 0.8, 1) + minimumJerk(t, 0.8, 3) + minimumJerk(t, 0.8, 5)),
                0, 0);
  };
  EXPECT_EQ(translationalActions(hand.over(7)), 3);
  EXPECT_EQ(rotationalActions(hand.over(7)), 0);
}

TEST(Actions, SlowAndShortOnesAreNone) {
  Hand slow;
  slow.tip = [](double t) { return Vec3(0.049 * t, 0, 0); };
  EXPECT_EQ(translationalActions(slow.over(3)), 0);
  Hand quick;
  quick.tip = [](double t) { return Vec3(0.051 * t, 0, 0); };
  EXPECT_EQ(translationalActions(quick.over(3)), 1);
  Hand jolt;  // 0.15 s
  jolt.tip = [](double t) { return Vec3(0.02 * minimumJerk(t, 0.15, 1), 0, 0); };
  EXPECT_EQ(translationalActions(jolt.over(3)), 0);
}

TEST(Actions, TurnsAreCountedApart) {
  Hand hand;  // 90 degrees in 1 s, twice
  hand.axis = [](double t) {
    const double angle = kPi / 2 * (minimumJerk(t, 1, 1) + minimumJerk(t, 1, 4));
    return Vec3(std::cos(angle), std::sin(angle), 0);
  };
  EXPECT_EQ(rotationalActions(hand.over(6)), 2);
  EXPECT_EQ(translationalActions(hand.over(6)), 0);
  EXPECT_NEAR(rotationTotal(hand.over(6)), kPi, 1e-3);
}

TEST(Smoothness, OfOneMinimumJerkMovement) {
  EXPECT_NEAR(spectralArcLength(straight().over(2)), -1.41, 0.02);
  Hand large;  // ten times the size, half as long
  large.tip = [](double t) { return Vec3(0.8 * minimumJerk(t, 1), 0, 0); };
  EXPECT_NEAR(spectralArcLength(large.over(1)), spectralArcLength(straight().over(2)), 0.02);
}

TEST(Smoothness, FallsWithEachStop) {
  double before = 0;
  for (int movements = 1; movements <= 4; ++movements) {
    Hand hand;
    hand.tip = [&](double t) {
      double x = 0;
      for (int i = 0; i < movements; ++i) x += minimumJerk(t, 0.8, 1.0 * i);
      return Vec3(0.05 * x, 0, 0);
    };
    const double smoothness = spectralArcLength(hand.over(movements));
    EXPECT_LT(smoothness, before - 0.2) << movements;
    before = smoothness;
  }
  EXPECT_TRUE(std::isnan(spectralArcLength(Hand{}.over(1))));
}

TEST(Smoothness, JerkOfAnOscillation) {
  // X = a sin(w t): the third derivative is a w^3 cos(w t); over whole periods its square
  // integrates to a^2 w^6 T / 2
  Hand hand;
  const double a = 0.01, w = 2 * kPi;
  hand.tip = [=](double t) { return Vec3(a * std::sin(w * t), 0, 0); };
  EXPECT_NEAR(integratedJerk(hand.over(10)) / (a * w * w * w * std::sqrt(10.0 / 2)), 1, 0.01);
}

// In along z by 30 mm from 1 s to 2 s, then the tip moves 20 mm aside while the entry stays, from 3
// s to 4 s; out at 5 s.
Hand needle() {
  Hand hand;
  const auto depth = [](double t) { return t < 5 ? 0.03 * minimumJerk(t, 1, 1) : 0.0; };
  const auto aside = [](double t) { return t < 5 ? 0.02 * minimumJerk(t, 1, 3) : 0.0; };
  hand.tip = [=](double t) { return Vec3(aside(t), 0, -depth(t)); };
  hand.axis = [=](double t) {
    return depth(t) > 0 ? Vec3(aside(t), 0, -depth(t)).normalized() : Vec3(0, 0, -1);
  };
  hand.inserted = [=](double t) { return std::hypot(aside(t), depth(t)); };
  return hand;
}

TEST(Tissue, AFanSweepsATriangle) {
  const Motion motion = needle().over(6);
  EXPECT_NEAR(tissueDamage(motion), 0.5 * 0.02 * 0.03, 1e-6);
  EXPECT_NEAR(tissuePath(motion), 0.05, 1e-3);
  EXPECT_NEAR(tissueTime(motion), 4, 0.1);
  EXPECT_EQ(insertions(motion), 1);
}

TEST(Tissue, StraightInSweepsNothingAndOutsideCountsNothing) {
  EXPECT_LT(tissueDamage(needle().over(2.5)), 1e-9);
  const Motion outside = straight().over(2);
  EXPECT_EQ(tissueDamage(outside), 0);
  EXPECT_EQ(tissuePath(outside), 0);
  EXPECT_EQ(tissueTime(outside), 0);
  EXPECT_EQ(insertions(outside), 0);
}

TEST(Tissue, TwoWaysInAreTwo) {
  Hand hand;
  hand.inserted = [](double t) { return (t > 1 && t < 2) || t > 3 ? 0.01 : 0.0; };
  EXPECT_EQ(insertions(hand.over(4)), 2);
}

TEST(CurveDistance, OfParallelLines) {
  const Curve a{{0, 0, 0}, {0.1, 0, 0}}, b{{0, 0.007, 0}, {0.1, 0.007, 0}};
  EXPECT_NEAR(hausdorff(a, b), 0.007, 1e-12);
  EXPECT_NEAR(frechet(a, b), 0.007, 1e-12);
  EXPECT_NEAR(timeWarped(a, b), 0.007, 1e-12);
  EXPECT_EQ(frechet(a, a), 0);
}

TEST(CurveDistance, AWayBackIsFarForTheLeashOnly) {
  // There, half back and there again: every point lies on the line, but the leash must reach 25 mm
  // back and forth.
  const Curve line{{0, 0, 0}, {0.1, 0, 0}},
      to_and_fro{{0, 0, 0}, {0.075, 0, 0}, {0.025, 0, 0}, {0.1, 0, 0}};
  EXPECT_LT(hausdorff(line, to_and_fro), 0.0005);
  EXPECT_NEAR(frechet(line, to_and_fro), 0.025, 0.0006);
  EXPECT_GT(timeWarped(line, to_and_fro), 0.001);
  EXPECT_LT(timeWarped(line, to_and_fro), 0.025);
}

TEST(CurveDistance, WaitingDoesNotCountAndDirectionDoes) {
  const Curve line{{0, 0, 0}, {0.1, 0, 0}},
      waiting{{0, 0, 0}, {0, 0, 0}, {0.03, 0, 0}, {0.03, 0, 0}, {0.1, 0, 0}},
      back{{0.1, 0, 0}, {0, 0, 0}};
  EXPECT_NEAR(frechet(line, waiting), 0, 1e-9);
  EXPECT_NEAR(frechet(line, back), 0.1, 1e-9);
  EXPECT_NEAR(hausdorff(line, back), 0, 1e-9);
}

TEST(CurveDistance, PointsAndNothing) {
  const Curve point{{0, 0, 0.003}}, line{{0, 0, 0}, {0.004, 0, 0}};
  EXPECT_NEAR(hausdorff(point, line), 0.005, 1e-12);
  EXPECT_NEAR(frechet(point, line), 0.005, 1e-12);
  EXPECT_TRUE(std::isnan(frechet({}, line)));
  EXPECT_EQ(resampled({{1, 1, 1}, {1, 1, 1}}).size(), 1u);
}

TEST(ForceUse, OfARampAndAPlateau) {
  Hand hand;  // 0 to 4 N in 1 s, then 4 N for 1 s, then nothing
  hand.force = [](double t) { return t < 1 ? 4 * t : t < 2 ? 4.0 : 0.0; };
  const Motion motion = hand.over(3);
  EXPECT_NEAR(peakForce(motion), 4, 1e-12);
  EXPECT_NEAR(meanForce(motion), 3, 0.03);
  EXPECT_NEAR(overForceTime(motion, 3), 1.25, 0.02);
  EXPECT_NEAR(forceJerk(motion), 4 / std::sqrt(2.0), 0.06);  // 4 N/s for half of the contact
  EXPECT_TRUE(std::isnan(meanForce(straight().over(1))));
  EXPECT_TRUE(std::isnan(forceJerk(straight().over(1))));
  EXPECT_EQ(peakForce(straight().over(1)), 0);
}

}  // namespace
}  // namespace palpa::metrics
