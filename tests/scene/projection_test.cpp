#include <gtest/gtest.h>

#include "tests/scene/offscreen.h"

namespace palpa::scene {
namespace {

/// Centre of the ellipse that a sphere at `c` with radius `r` leaves in the picture. A little off
/// the projection of its centre: Z^2 becomes Z^2 - r^2.
Eigen::Vector2d ellipseCentre(const Pinhole& camera, const Vec3& c, double r) {
  const double k = c.z() / (c.z() * c.z() - r * r);
  return {camera.fx * c.x() * k + camera.cx, camera.fy * c.y() * k + camera.cy};
}

struct Case {
  int width, height;  // window
  Vec3 p_A;
  const char* name;
};

class Projection : public testing::TestWithParam<Case> {};

/// Where the centre of a disc in the picture lies in a window that the picture fills in height or
/// width, in the middle of the rest.
Eigen::Vector2d inWindow(const Eigen::Vector2d& in_picture, int width, int height) {
  const double scale = std::min(width / 640.0, height / 480.0);
  const Eigen::Vector2d corner(0.5 * (width - scale * 640), 0.5 * (height - scale * 480));
  return scale * (in_picture.array() + 0.5).matrix() + corner - Eigen::Vector2d(0.5, 0.5);
}

/// Middle of what hides a black and a white picture, by the share of each pixel that it hides: a
/// smoothed edge counts in part, whatever the light on it. Around here: beside the pictures is
/// neither.
Eigen::Vector2d middleOf(const Image& on_black, const Image& on_white,
                         const Eigen::Vector2d& about) {
  constexpr double kAround_px = 60;
  Eigen::Vector2d sum(0, 0);
  double hidden = 0;
  for (int v = 0; v < on_black.height; ++v)
    for (int u = 0; u < on_black.width; ++u) {
      if ((Eigen::Vector2d(u, v) - about).norm() > kAround_px) continue;
      const double share = 1 - (at(on_white, u, v).b - at(on_black, u, v).b) / 255.0;
      sum += share * Eigen::Vector2d(u, v);
      hidden += share;
    }
  return sum / hidden;
}

// A disc sampled at pixel centres (radius 15 to 30 px) has a centroid good to about 0.04 px (one
// sigma); nine shifts of the principal point by a fraction of a pixel bring that to about 0.015 px.
TEST_P(Projection, SphereLiesWhereThePinholeSaysToATenthOfAPixel) {
  const double radius = 0.012;
  const Case& c = GetParam();
  const auto patient = test::spherePatient(c.p_A, radius);
  SceneView view(offscreen(), patient, {c.width, c.height, FixedViews::none, true});
  const Image black = plain(640, 480, 0), white = plain(640, 480, 255);
  SceneState state;
  state.registered = true;
  state.show_tool = false;
  state.X_CA = lookAt({-0.10, -0.35, 0.12}, {0.01, 0.02, -0.01});
  Eigen::Vector2d error(0, 0);
  for (int i = 0; i < 9; ++i) {
    state.camera = crookedCamera();
    state.camera.cx += (i % 3) / 3.0;
    state.camera.cy += (i / 3) / 3.0;  // NOLINT(bugprone-integer-division): thirds of a pixel
    const auto on = [&](const Image& picture) {
      state.picture = &picture;
      view.show(state);
      return view.capture();
    };
    const Eigen::Vector2d expected =
        inWindow(ellipseCentre(state.camera, state.X_CA * c.p_A, radius), c.width, c.height);
    error += (middleOf(on(black), on(white), expected) - expected) / 9;

    const ArGeometry geometry = view.arGeometry();
    const Eigen::Vector2d told = ellipseCentre(geometry.camera, geometry.X_CA * c.p_A, radius);
    EXPECT_NEAR((told - expected).norm(), 0, 1e-9);  // the same formula, written twice
  }
  EXPECT_LT(error.norm(), 0.1);
  RecordProperty("error_px", std::to_string(error.norm()));
}

INSTANTIATE_TEST_SUITE_P(Windows, Projection,
                         testing::Values(Case{640, 480, {0.0, 0.0, 0.0}, "filled_middle"},
                                         Case{640, 480, {0.09, 0.02, -0.05}, "filled_right_low"},
                                         Case{640, 480, {-0.07, -0.03, 0.06}, "filled_left_high"},
                                         Case{900, 480, {0.05, 0.04, 0.03}, "bars_at_the_sides"},
                                         Case{960, 720, {-0.04, 0.0, -0.05}, "enlarged"}),
                         [](const auto& c) { return c.param.name; });

TEST(Picture, FillsTheViewPixelForPixelUprightAndUnchanged) {
  Image picture = plain(640, 480, 0);
  for (int v = 0; v < 480; ++v) {
    for (int u = 0; u < 640; ++u) {
      auto* p = &picture.pixels[(static_cast<std::size_t>(v) * 640 + u) * 3];
      p[0] = static_cast<std::uint8_t>(u / 4);
      p[1] = static_cast<std::uint8_t>(v / 2);
      p[2] = static_cast<std::uint8_t>((u * 7 + v * 13) % 256);
    }
  }
  const auto patient = test::simplePatient();
  SceneView view(offscreen(), patient, {640, 480, FixedViews::none, true});
  SceneState state;  // not registered: the picture alone, no patient on it
  state.picture = &picture;
  view.show(state);
  EXPECT_EQ(view.capture().pixels, picture.pixels);
}

TEST(Picture, WithTheWrongNumberOfBytesIsRefused) {
  const auto patient = test::simplePatient();
  SceneView view(offscreen(), patient, {320, 240, FixedViews::none, true});
  Image picture = plain(64, 48, 0);
  picture.pixels.pop_back();
  SceneState state;
  state.picture = &picture;
  EXPECT_THROW(view.show(state), Error);
}

}  // namespace
}  // namespace palpa::scene
