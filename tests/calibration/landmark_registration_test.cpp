#include "calibration/registration.h"

#include <cmath>

#include "calibration/rotation.h"
#include "tests/support/complaint.h"

namespace palpa::calibration {
namespace {

using palpa::test::complaint;
using palpa::test::says;

const Pose kTruth = makePose(rotationOf(Vec3(0.4, -1.1, 0.7)), Vec3(0.1, -0.2, 0.05));

std::vector<TouchedLandmark> touched(const std::vector<Vec3>& known) {
  std::vector<TouchedLandmark> all;
  for (const Vec3& p : known) all.push_back({p, kTruth * p, 5e-4});
  return all;
}
const std::vector<Vec3> kAllOver{{0, 0, 0},    {0.1, 0, 0},        {0, 0.12, 0},
                                 {0, 0, 0.08}, {0.07, 0.06, 0.05}, {-0.05, 0.02, 0.03}};

TEST(LandmarkRegistration, OfPerfectLandmarksIsExact) {
  const LandmarkRegistration found = registerLandmarks(touched(kAllOver));
  EXPECT_LT((found.X_BA.matrix() - kTruth.matrix()).norm(), 1e-9);
  EXPECT_LT(found.fre, 1e-9);
  EXPECT_NEAR(found.scale, 1, 1e-9);
}

// Fitzpatrick, West and Maurer 1998, first order: of N landmarks touched to sd per coordinate
// (fle^2 = 3 sd^2),
//   TRE^2 = fle^2 (1 / N + (d1^2 / f1^2 + d2^2 / f2^2 + d3^2 / f3^2) / 3)
// with the rms distances f from the principal axes summed over N.
TEST(LandmarkRegistration, PredictsTheErrorThatFitzpatricksFormulaGives) {
  std::vector<TouchedLandmark> landmarks;
  for (int i = 0; i < 8; ++i)
    landmarks.push_back(
        {Vec3(i & 1 ? 0.05 : -0.05, i & 2 ? 0.03 : -0.03, i & 4 ? 0.04 : -0.04), Vec3::Zero(), 1});
  unsigned state = 7;
  for (TouchedLandmark& l : landmarks) {
    Vec3 e;
    for (int k = 0; k < 3; ++k)
      e[k] = 2e-4 * (((state = state * 1664525u + 1013904223u) >> 16) % 2001 / 1000.0 - 1);
    l.p_B = kTruth * l.p_A + e;
  }
  const LandmarkRegistration found = registerLandmarks(landmarks);
  const double sigma = found.fit.sigma;
  for (const Vec3& p : {Vec3(0, 0, 0), Vec3(0.1, 0, 0), Vec3(0.03, -0.08, 0.05)}) {
    const Vec3 d2(p.y() * p.y() + p.z() * p.z(), p.x() * p.x() + p.z() * p.z(),
                  p.x() * p.x() + p.y() * p.y());
    const Vec3 f2(0.03 * 0.03 + 0.04 * 0.04, 0.05 * 0.05 + 0.04 * 0.04, 0.05 * 0.05 + 0.03 * 0.03);
    const double formula = std::sqrt(3 * sigma * sigma / 8 * (1 + d2.cwiseQuotient(f2).sum() / 3));
    EXPECT_NEAR(found.tre(p), formula, 0.01 * formula);
  }
}

TEST(LandmarkRegistration, WhatCannotBeRegisteredIsNamed) {
  EXPECT_TRUE(says(complaint([] {
                     registerLandmarks(touched({{0, 0, 0}, {0.1, 0, 0}}));
                   }),
                   "too few"));
  EXPECT_TRUE(
      says(complaint([] {
             registerLandmarks(touched({{0, 0, 0}, {0.1, 0, 0}, {0.2, 0.001, 0}, {0.3, 0, 0}}));
           }),
           "on one line"));
  EXPECT_TRUE(
      says(complaint([] {
             registerLandmarks(touched({{0, 0, 0}, {0.001, 0, 0}, {0, 0.001, 0}, {0, 0, 0.001}}));
           }),
           "lie within"));
  auto millimetres = touched(kAllOver);
  for (TouchedLandmark& l : millimetres) l.p_B *= 1000;
  EXPECT_TRUE(says(complaint([&] { registerLandmarks(millimetres); }), "another unit"));
  auto mirrored = touched(kAllOver);
  for (TouchedLandmark& l : mirrored) l.p_B.x() = -l.p_B.x();
  EXPECT_NE(complaint([&] { registerLandmarks(mirrored); }), "");
  auto shuffled = touched(kAllOver);
  std::swap(shuffled[0].p_B, shuffled[3].p_B);
  std::swap(shuffled[1].p_B, shuffled[4].p_B);
  EXPECT_NE(complaint([&] { registerLandmarks(shuffled); }), "");
  auto broken = touched(kAllOver);
  broken[2].p_B.z() = std::nan("");
  EXPECT_TRUE(says(complaint([&] { registerLandmarks(broken); }), "not a number"));
}

}  // namespace
}  // namespace palpa::calibration
