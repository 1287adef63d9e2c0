#include "scene/view/two_eyes.h"

#include <gtest/gtest.h>

#include "tests/scene/offscreen.h"

/// Two eyes, each with a projection of its own.
namespace palpa::scene {
namespace {

constexpr double kApart = 0.063, kFocus = 0.4;

SceneState through(const Image& picture, const Pose& X_CA) {
  SceneState state = straightOn(picture);
  state.camera = crookedCamera();
  state.X_CA = X_CA;
  return state;
}

TEST(Stereo, DisparityIsThatOfTwoParallelCamerasFocusedAhead) {
  const Pose X_CA = lookAt({0.1, -0.5, 0.2}, {0, 0, 0});
  const auto eyes = stereoPair(crookedCamera(), X_CA, kApart, kFocus);
  for (const double depth : {0.2, 0.4, 0.8}) {
    const Vec3 p_A = X_CA.inverse() * Vec3(0.03, -0.02, depth);
    const Eigen::Vector2d left = project(eyes[0].camera, eyes[0].X_CA * p_A),
                          right = project(eyes[1].camera, eyes[1].X_CA * p_A);
    EXPECT_NEAR(left.x() - right.x(), crookedCamera().fx * kApart * (1 / depth - 1 / kFocus), 1e-9)
        << depth;
    EXPECT_NEAR(left.y(), right.y(), 1e-9);
  }
  // The eyes stand beside each other, the left one on the left.
  const Vec3 between_C =
      X_CA * eyes[1].X_CA.inverse().translation() - X_CA * eyes[0].X_CA.inverse().translation();
  EXPECT_LT((between_C - Vec3(kApart, 0, 0)).norm(), 1e-12);
}

/// An eye's part of the window, and how much its pixels are squeezed.
struct Part {
  int left = 0, top = 0;
  double across = 1, down = 1;
};
std::array<Part, 2> partsOf(Stereo stereo) {
  if (stereo == Stereo::side_by_side) return {{{0, 0, 0.5, 1}, {320, 0, 0.5, 1}}};
  if (stereo == Stereo::top_bottom) return {{{0, 0, 1, 0.5}, {0, 240, 1, 0.5}}};
  return {{{0, 0, 1, 1}, {640, 0, 1, 1}}};
}

/// Where the centre of a small sphere is drawn in each half, against the projection of that eye;
/// nine shifts by thirds of one of its pixels, as for one camera.
void expectTrueEyes(Stereo stereo) {
  const int least = stereo == Stereo::headset ? 40 : 20;  // squeezed, pixels at the edge are halves
  const double radius = 0.012;
  const Vec3 p_A(0.03, 0.02, -0.03);
  const auto patient = test::spherePatient(p_A, radius);
  ViewLayout layout{640, 480, FixedViews::none, true};
  layout.stereo = stereo;
  if (stereo == Stereo::headset) layout.width *= 2;
  SceneView view(offscreen(), patient, layout);
  const Image dark = plain(640, 480, 0);
  SceneState state = through(dark, lookAt({-0.10, -0.35, 0.12}, {0.01, 0.02, -0.01}));
  const auto parts = partsOf(stereo);
  std::array<Eigen::Vector2d, 2> error{Eigen::Vector2d::Zero(), Eigen::Vector2d::Zero()};
  for (int i = 0; i < 9; ++i) {
    state.eyes = stereoPair(crookedCamera(), state.X_CA, kApart, kFocus);
    (*state.eyes)[1].camera.fx = 560;  // eyes need not be alike
    for (EyeCamera& eye : *state.eyes) {
      eye.camera.cx += i % 3 / 3.0 / parts[0].across;
      eye.camera.cy += i / 3 % 3 / 3.0 / parts[0].down;
    }
    view.show(state);
    const ArGeometry left = view.arGeometry();  // what the mouse meets
    EXPECT_EQ(left.X_CA.matrix(), (*state.eyes)[0].X_CA.matrix());
    EXPECT_NEAR(left.camera.cx, (*state.eyes)[0].camera.cx, 1e-9);
    EXPECT_EQ(left.width, 640);
    const Image frame = view.capture();
    for (std::size_t e = 0; e < 2; ++e) {
      const Part& part = parts[e];
      const Blob disc = blobOf(frame, [&](int u, int v) {
        return u >= part.left && u < part.left + 640 * part.across && v >= part.top &&
               v < part.top + 480 * part.down && at(frame, u, v).b > least;
      });
      ASSERT_GT(disc.count, 300);
      const EyeCamera& eye = (*state.eyes)[e];
      const Vec3 c = eye.X_CA * p_A;
      const double k = c.z() / (c.z() * c.z() - radius * radius);  // the ellipse's centre
      const Eigen::Vector2d expected(eye.camera.fx * c.x() * k + eye.camera.cx,
                                     eye.camera.fy * c.y() * k + eye.camera.cy);
      const Eigen::Vector2d found((disc.u + 0.5 - part.left) / part.across - 0.5,
                                  (disc.v + 0.5 - part.top) / part.down - 0.5);
      error[e] += (found - expected) / 9;
    }
  }
  EXPECT_LT(error[0].norm(), 0.1);
  EXPECT_LT(error[1].norm(), 0.1);
}

TEST(Stereo, EachEyeSeesATenthOfAPixelTrueSideBySide) { expectTrueEyes(Stereo::side_by_side); }
TEST(Stereo, EachEyeSeesATenthOfAPixelTrueOneAboveTheOther) { expectTrueEyes(Stereo::top_bottom); }
TEST(Stereo, EachEyeSeesATenthOfAPixelTrueOnTheHead) { expectTrueEyes(Stereo::headset); }

/// A screen halves all of a picture: what one eye alone would see hurts.
TEST(Stereo, BothHalvesOfAPictureHaveEveryWordAndView) {
  for (const Stereo stereo : {Stereo::side_by_side, Stereo::top_bottom}) {
    ViewLayout layout{960, 540, FixedViews::three, true};
    layout.stereo = stereo;
    SceneView view(offscreen(), test::simplePatient(), layout);
    SceneState bare;
    bare.show_tool = false;
    SceneState said = bare;
    said.hud.phase = "phase 2";
    said.hud.mark = "SIMULATED";
    said.hud.time = "0:31";
    view.show(bare);
    const Image without = view.capture();
    view.show(said);
    const Image with = view.capture();
    const int across = stereo == Stereo::side_by_side ? 480 : 0, down = across ? 0 : 270;
    long words = 0, one_eye = 0, unlike_views = 0;
    for (int v = 0; v < 540 - down; ++v)
      for (int u = 0; u < 960 - across; ++u) {
        const bool left = difference(at(with, u, v), at(without, u, v)) > 40,
                   right = difference(at(with, u + across, v + down),
                                      at(without, u + across, v + down)) > 40;
        words += left || right;
        one_eye += left != right;
        const bool in_fixed_view = u > (across ? 480 : 960) * 0.72;
        unlike_views +=
            in_fixed_view && difference(at(with, u, v), at(with, u + across, v + down)) > 0;
      }
    EXPECT_GT(words, 2000);
    EXPECT_LT(static_cast<double>(one_eye), 0.05 * static_cast<double>(words))
        << "plates are clear: what is behind them differs";
    EXPECT_EQ(unlike_views, 0);
  }
}

TEST(Stereo, TheMouseIsWhereEachEyeHasIt) {
  const auto expect = [](Stereo stereo, double x, double y, double u, double v) {
    const Eigen::Vector2d there = inEyesPicture({x, y}, 640, 480, stereo);
    EXPECT_EQ(there.x(), u);
    EXPECT_EQ(there.y(), v);
  };
  expect(Stereo::side_by_side, 100, 50, 200, 50);
  expect(Stereo::side_by_side, 420, 50, 200, 50);
  expect(Stereo::top_bottom, 100, 50, 100, 100);
  expect(Stereo::top_bottom, 100, 290, 100, 100);
  for (const Stereo whole : {Stereo::none, Stereo::anaglyph, Stereo::headset})
    expect(whole, 420, 290, 420, 290);
}

TEST(Stereo, AnAnaglyphHasTheLeftEyeInRedAndTheRightInCyan) {
  const Vec3 p_A(0, -0.05, 0);
  const auto patient = test::spherePatient(p_A, 0.02);
  ViewLayout layout{640, 480, FixedViews::none, true};
  layout.stereo = Stereo::anaglyph;
  SceneView view(offscreen(), patient, layout);
  const Image dark = plain(640, 480, 0);
  SceneState state = through(dark, lookAt({0, -0.4, 0}, {0, 0, 0}));
  state.eyes = stereoPair(crookedCamera(), state.X_CA, kApart, kFocus);
  view.show(state);
  const Image frame = view.capture();
  const Blob red = blobOf(frame, [&](int u, int v) { return at(frame, u, v).r > 25; }),
             cyan = blobOf(frame, [&](int u, int v) { return at(frame, u, v).b > 40; });
  ASSERT_GT(red.count, 300);
  const double expected = project((*state.eyes)[0].camera, (*state.eyes)[0].X_CA * p_A).x() -
                          project((*state.eyes)[1].camera, (*state.eyes)[1].X_CA * p_A).x();
  EXPECT_GT(expected, 5);
  EXPECT_NEAR((red.left + red.right - cyan.left - cyan.right) / 2.0, expected, 1.5);
}

TEST(Stereo, WithoutARealCameraTheVirtualOneHasTwoEyes) {
  const auto patient = test::simplePatient();
  ViewLayout layout{640, 240, FixedViews::none, true};
  layout.stereo = Stereo::side_by_side;
  SceneView view(offscreen(), patient, layout);
  SceneState state;
  state.show_tool = false;
  view.show(state);
  const Image frame = view.capture();
  int unlike = 0;
  for (int v = 0; v < 240; ++v)
    for (int u = 0; u < 320; ++u) unlike += difference(at(frame, u, v), at(frame, u + 320, v)) > 8;
  EXPECT_GT(unlike, 200);
}

}  // namespace
}  // namespace palpa::scene
