#include "ar/pose_smoother.h"

#include <gtest/gtest.h>

#include "tests/ar/views.h"

namespace palpa::ar {
namespace {

constexpr std::int64_t kStep = 1'000'000'000 / 15;  // 15 pictures a second
constexpr double kT = double(kStep) * 1e-9;

Pose turned(double angle, const Vec3& axis, const Vec3& p) {
  return makePose(Eigen::AngleAxisd(angle, axis.normalized()).toRotationMatrix(), p);
}

double cutoffAlpha(double cutoff_hz) {
  return 1 / (1 + 1 / (2 * std::numbers::pi * cutoff_hz * kT));
}

TEST(PoseSmoother, AStillPoseStaysToTheLastBits) {
  PoseSmoother smoother;
  const Pose X = turned(2, {1, 2, 3}, {0.1, 0.2, 0.5});
  for (int i = 0; i < 300; ++i)
    EXPECT_LT(difference(smoother.update(X, i * kStep), X).norm(), 1e-14);
}

struct Jitter {
  double translation, rotation;   ///< what is left of one, standard deviation a coordinate
};

Jitter leftOfJitter(double sigma_p, double sigma_R) {
  std::mt19937 random(1);
  PoseSmoother smoother;
  const Pose X = turned(1, {0, 1, 1}, {0, 0, 0.5});
  const int count = 3000, settle = 60;
  double p2 = 0, R2 = 0;
  for (int i = 0; i < count + settle; ++i) {
    const Vec3 w(normal(&random), normal(&random), normal(&random));
    const Vec3 v(normal(&random), normal(&random), normal(&random));
    const Pose raw = makePose(turned(sigma_R * w.norm(), w, {0, 0, 0}).linear() * X.linear(),
                              X.translation() + sigma_p * v);
    const auto d = difference(smoother.update(raw, i * kStep), X);
    if (i < settle) continue;
    R2 += d.head<3>().squaredNorm() / (3.0 * count);
    p2 += d.tail<3>().squaredNorm() / (3.0 * count);
  }
  return {std::sqrt(p2) / sigma_p, std::sqrt(R2) / sigma_R};
}

/// The closed form, where the noise is too small to open the filter. The smoothed samples are correlated
/// over some ten pictures: 3000 of three coordinates tell a standard deviation to 3 %.
TEST(PoseSmoother, SmallJitterShrinksAsTheClosedFormSays) {
  const double a = cutoffAlpha(PoseSmoother::Settings{}.min_cutoff_hz);
  const double promised = std::sqrt(a / (2 - a));
  EXPECT_NEAR(promised, 0.308, 0.001);
  const Jitter left = leftOfJitter(2e-6, 2e-5);
  EXPECT_NEAR(left.translation / promised, 1, 0.1);
  EXPECT_NEAR(left.rotation / promised, 1, 0.1);
}

/// What the header promises of a board seen at 0.5 m and of one seen badly.
TEST(PoseSmoother, RealJitterShrinksAsTheHeaderSays) {
  const Jitter good = leftOfJitter(0.00005, rad(0.02)), bad = leftOfJitter(0.00015, rad(0.05));
  EXPECT_LT(good.translation, 0.37);
  EXPECT_LT(good.rotation, 0.37);
  EXPECT_LT(bad.translation, 0.45);
  EXPECT_LT(bad.rotation, 0.45);
}

TEST(PoseSmoother, LagOfASteadyMotionIsTheClosedFormAndBounded) {
  const PoseSmoother::Settings settings;
  for (const double speed : {0.001, 0.01, 0.1, 1.0}) {
    PoseSmoother smoother;
    double lag = 0;
    for (int i = 0; i < 400; ++i) {
      const Vec3 p(speed * kT * i, 0, 0.5);
      lag = (p - smoother.update(turned(0.3, {1, 0, 0}, p), i * kStep).translation()).norm();
    }
    const double expected = speed / (2 * std::numbers::pi *
                                     (settings.min_cutoff_hz + settings.beta_translation * speed));
    EXPECT_NEAR(lag, expected, 1e-3 * expected) << speed;  // 400 steps: settled to exp(-20)
    EXPECT_LT(lag, 0.0005) << speed;
  }
}

TEST(PoseSmoother, LagOfASteadyTurnIsTheClosedFormAndBounded) {
  const PoseSmoother::Settings settings;
  for (const double rate : {0.01, 0.1, 1.0}) {
    PoseSmoother smoother;
    double lag = 0;
    for (int i = 0; i < 400; ++i) {
      const Pose raw = turned(rate * kT * i, {1, -1, 2}, {0, 0, 0.5});
      lag = difference(raw, smoother.update(raw, i * kStep)).head<3>().norm();
    }
    const double expected =
        rate / (2 * std::numbers::pi * (settings.min_cutoff_hz + settings.beta_rotation * rate));
    EXPECT_NEAR(lag, expected, 1e-3 * expected) << rate;
    EXPECT_LT(lag, rad(0.21)) << rate;
  }
}

/// A push of 10 mm between two pictures: at once mostly there, never beyond, and back to rest.
TEST(PoseSmoother, StepResponseIsFastAndDoesNotOvershoot) {
  PoseSmoother smoother;
  for (int i = 0; i < 30; ++i) smoother.update(turned(0, {1, 0, 0}, {0, 0, 0.5}), i * kStep);
  double last = 0;
  for (int i = 30; i < 90; ++i) {
    const double x =
        smoother.update(turned(0, {1, 0, 0}, {0.01, 0, 0.5}), i * kStep).translation().x();
    EXPECT_GE(x, last);
    EXPECT_LE(x, 0.01 + 1e-15);
    if (i == 30) {
      EXPECT_GT(x, 0.0085);  // speed 44 mm/s, cutoff 14.7 Hz, alpha 0.860
    }
    last = x;
  }
  EXPECT_NEAR(last, 0.01, 1e-6);
}

TEST(PoseSmoother, StartsAnewAfterAGapAndIgnoresTimeThatStandsStill) {
  PoseSmoother smoother;
  const Pose a = turned(0.1, {1, 0, 0}, {0, 0, 0.5}), b = turned(1.1, {0, 1, 0}, {0.2, 0, 0.6});
  EXPECT_EQ(smoother.update(a, 0).matrix(), a.matrix());
  EXPECT_EQ(smoother.update(b, 0).matrix(), a.matrix());
  EXPECT_EQ(smoother.update(b, -5).matrix(), a.matrix());
  EXPECT_NE(smoother.update(b, kStep).matrix(), b.matrix());
  EXPECT_EQ(smoother.update(b, 20 * kStep).matrix(), b.matrix());
  smoother.reset();
  EXPECT_EQ(smoother.update(a, 21 * kStep).matrix(), a.matrix());
}

/// Smoothing in another camera frame gives the same motion: no axis is preferred.
TEST(PoseSmoother, DoesNotDependOnTheFrame) {
  std::mt19937 random(2);
  PoseSmoother one, other;
  const Pose X_GC = turned(2.2, {3, 1, -1}, {0, 0, 0});
  for (int i = 0; i < 50; ++i) {
    const Vec3 axis(normal(&random), normal(&random), normal(&random));
    const Pose raw = turned(0.2 * normal(&random), axis, 0.01 * axis);
    EXPECT_LT(
        difference(X_GC * one.update(raw, i * kStep), other.update(X_GC * raw, i * kStep)).norm(),
        1e-12);
  }
}

}  // namespace
}  // namespace palpa::ar
