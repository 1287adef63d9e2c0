#include "scene/view/creases.h"

#include <gtest/gtest.h>

#include "tests/scene/offscreen.h"

namespace palpa::scene {
namespace {

anatomy::OrganSurface plateOf(const Vec3& middle, const Vec3& across, const Vec3& up,
                              const Vec3& n) {
  const auto corner = [=](int i, int j) {
    return Vec3(middle + (2 * j - 1) * across + (2 * i - 1) * up);
  };
  return {"bone",
          Organ::clavicle,
          test::gridMesh(2, 2, false, corner, [=](int, int) { return n; }),
          {0.8, 0.8, 0.8, 1}};
}

/// A floor, y = 0, and where `wall` a wall on it, x = 0, of 50 mm, with the eye before both.
struct Corner {
  explicit Corner(bool wall) {
    patient.organs.push_back(plateOf({0, 0, 0}, {0.12, 0, 0}, {0, 0, 0.12}, {0, -1, 0}));
    if (wall)
      patient.organs.push_back(plateOf({0, -0.025, 0}, {0, 0, 0.12}, {0, -0.025, 0}, {1, 0, 0}));
  }
  Image seen(bool creases, const Vec3& eye_A) const {
    const Image dark = plain(320, 240, 20);
    SceneState state = straightOn(dark);
    state.X_CA = lookAt(eye_A, {0, 0, 0});
    ViewLayout layout{320, 240, FixedViews::none};
    layout.creases = creases;
    SceneView view(offscreen(), patient, layout);
    view.show(state);
    return view.capture();
  }
  anatomy::Patient patient;
};

const Vec3 kBefore(0.25, -0.3, 0);

/// How bright the floor is beside the wall, of what it is without creases.
double litAt(double x, const Image& with, const Image& without) {
  const SceneState state = straightOn(without);
  const Eigen::Vector2d p = project(state.camera, lookAt(kBefore, {0, 0, 0}) * Vec3(x, 0, 0));
  double sums[2] = {0, 0};
  for (int v = -12; v <= 12; ++v) {  // along the wall
    const int u = static_cast<int>(std::lround(p.x()));
    sums[0] += at(with, u, static_cast<int>(p.y()) + v).g;
    sums[1] += at(without, u, static_cast<int>(p.y()) + v).g;
  }
  return sums[0] / sums[1];
}

TEST(Creases, AreDarkerTheDeeperInThem) {
  const Corner corner(true);
  const Image with = corner.seen(true, kBefore), without = corner.seen(false, kBefore);
  const double deep = litAt(0.002, with, without), near = litAt(0.006, with, without),
               off = litAt(0.03, with, without);
  EXPECT_LT(deep, 0.85);
  EXPECT_LT(deep, near - 0.05);
  EXPECT_LT(near, off - 0.02);
  EXPECT_NEAR(off, 1, 0.01);
  EXPECT_EQ(difference(at(with, 2, 2), at(without, 2, 2)), 0) << "the camera's picture";
}

/// Whether all is plate within 3 pixels: what lies behind its edge is no part of it.
bool isInside(const Image& image, int u, int v) {
  for (int dv = -3; dv <= 3; ++dv)
    for (int du = -3; du <= 3; ++du) {
      const int x = u + du, y = v + dv;
      if (x < 0 || y < 0 || x >= image.width || y >= image.height ||
          difference(at(image, x, y), {20, 20, 20}) < 3)
        return false;
    }
  return true;
}

TEST(Creases, WhatIsFlatHasNone) {
  const Corner corner(false);
  for (const Vec3& eye_A : {Vec3(0, -0.4, 0.001), Vec3(0.2, -0.25, 0.1), Vec3(0.38, -0.1, 0)}) {
    const Image with = corner.seen(true, eye_A), without = corner.seen(false, eye_A);
    const Blob plate = blobOf(without, [&](int u, int v) { return isInside(without, u, v); });
    const Blob darker = blobOf(without, [&](int u, int v) {
      return isInside(without, u, v) && difference(at(with, u, v), at(without, u, v)) > 2;
    });
    EXPECT_GT(plate.count, 5000);
    EXPECT_EQ(darker.count, 0) << eye_A.transpose();
  }
}

}  // namespace
}  // namespace palpa::scene
