#include "scene/view/framing.h"

#include <gtest/gtest.h>

#include <random>

#include "tests/scene/offscreen.h"

/// What of the camera's picture is shown.
namespace palpa::scene {
namespace {

constexpr double kRadius = 0.08;

struct Scene {
  Pinhole camera;
  Vec3 centre_C;
  double aspect = 1;
};

Scene anywhere(std::mt19937& bits) {
  std::uniform_real_distribution<double> share(0, 1);
  Scene s;
  s.camera = {1280, 720, 900, 900, 639.5, 359.5};
  if (share(bits) < 0.5) s.camera = {640, 480, 600, 600, 319.5, 239.5};
  const double depth = 0.35 + 0.6 * share(bits);
  s.centre_C = {depth * (share(bits) - 0.5) * s.camera.width / s.camera.fx,
                depth * (share(bits) - 0.5) * s.camera.height / s.camera.fy, depth};
  s.aspect = 0.4 + 2 * share(bits);
  return s;
}

TEST(PartWithWork, IsOfThePictureAndOfTheViewsShape) {
  std::mt19937 bits(1);
  int framed = 0;
  for (int i = 0; i < 2000; ++i) {
    const Scene s = anywhere(bits);
    const Rect part = partWithWork(s.camera, s.centre_C, kRadius, s.aspect, {});
    ASSERT_GE(part.x, 0);
    ASSERT_GE(part.y, 0);
    ASSERT_LE(part.right(), s.camera.width);
    ASSERT_LE(part.top(), s.camera.height);
    if (part == Rect{0, 0, s.camera.width, s.camera.height}) continue;
    ++framed;
    EXPECT_NEAR(part.width, s.aspect * part.height, s.aspect + 1);
    EXPECT_GE(part.width, std::min(0.5 * s.camera.width, s.aspect * s.camera.height) - 1);
    const double u = s.camera.fx * s.centre_C.x() / s.centre_C.z() + s.camera.cx,
                 v = s.camera.fy * s.centre_C.y() / s.centre_C.z() + s.camera.cy;
    EXPECT_TRUE(part.contains(u, v));
  }
  EXPECT_GT(framed, 1000);
}

TEST(PartWithWork, IsNoMoreThanTheWorkNeeds) {
  const Pinhole camera{1280, 720, 900, 900, 639.5, 359.5};
  const Rect near = partWithWork(camera, {0, 0, 0.4}, kRadius, 1.6, {}),
             far = partWithWork(camera, {0, 0, 0.8}, kRadius, 1.6, {});
  EXPECT_LT(far.width, near.width);
  EXPECT_NEAR(near.height, 2 * 900 * kRadius / 0.4 / 0.8, 2);
  EXPECT_NEAR(near.x + 0.5 * near.width, 640, 1);
  EXPECT_NEAR(near.y + 0.5 * near.height, 360, 1);
}

TEST(PartWithWork, StaysWhileItDoes) {
  const Pinhole camera{1280, 720, 900, 900, 639.5, 359.5};
  const Rect first = partWithWork(camera, {0, 0, 0.36}, kRadius, 1.6, {});
  EXPECT_EQ(partWithWork(camera, {0.01, 0.005, 0.35}, kRadius, 1.6, first), first);
  EXPECT_NE(partWithWork(camera, {0.08, 0, 0.36}, kRadius, 1.6, first), first);
  EXPECT_NE(partWithWork(camera, {0, 0, 0.7}, kRadius, 1.6, first), first);
  EXPECT_NE(partWithWork(camera, {0, 0, 0.36}, kRadius, 1.2, first), first) << "another window";
}

TEST(PartWithWork, IsTheWholePictureWhereTheWorkIsNotInIt) {
  const Pinhole camera{640, 480, 600, 600, 319.5, 239.5};
  const Rect whole{0, 0, 640, 480};
  for (const Vec3& centre_C : {Vec3(0, 0, 0.05), Vec3(0, 0, -1), Vec3(2, 0, 0.5), Vec3(0, 0, 0.09)})
    EXPECT_EQ(partWithWork(camera, centre_C, kRadius, 1.3, {}), whole) << centre_C.transpose();
}

/// The overlay is where it belongs in the part as well: a ball, and a bright spot of the picture.
TEST(FramedView, OverlayAndPictureStayTogether) {
  const Vec3 ball_A(0.01, -0.01, 0), spot_A(0.05, 0, 0.03);
  const double radius = 0.01;
  const auto patient = test::spherePatient(ball_A, radius);
  ViewLayout layout{900, 600, FixedViews::none, true};
  layout.framed = true;
  SceneView view(offscreen(), patient, layout);
  Image picture = plain(640, 480, 0);
  SceneState state = straightOn(picture);
  state.camera = {640, 480, 600, 600, 319.5, 239.5};
  state.X_CA = lookAt({-0.05, -0.7, 0.12}, {0.06, 0.02, -0.05});
  const Eigen::Vector2d spot = project(state.camera, state.X_CA * spot_A);
  for (int v = -3; v <= 3; ++v)
    for (int u = -3; u <= 3; ++u)
      for (int k = 0; k < 3; ++k)
        picture.pixels[static_cast<std::size_t>(
            3 * ((int(std::lround(spot.y())) + v) * 640 + int(std::lround(spot.x())) + u) + k)] =
            255;
  view.show(state);
  const ArGeometry seen = view.arGeometry();
  EXPECT_GT(seen.camera.fx, 1.2 * state.camera.fx * 900 / 640) << "larger than the whole picture";
  const Image frame = view.capture();
  const auto at_A = [&](const Vec3& p_A) { return project(seen.camera, seen.X_CA * p_A); };
  const Blob white = blobOf(frame, [&](int u, int v) {
    const Pixel p = at(frame, u, v);
    return p.r > 200 && p.g > 200 && p.b > 200;
  });
  ASSERT_GT(white.count, 50);
  EXPECT_LT((Eigen::Vector2d(white.u, white.v) - at_A(spot_A)).norm(), 2) << "rounded to a pixel";
  const Blob ball =
      blobOf(frame, [&](int u, int v) { return at(frame, u, v).b > at(frame, u, v).r + 20; });
  ASSERT_GT(ball.count, 300);
  EXPECT_LT((Eigen::Vector2d(ball.u, ball.v) - at_A(ball_A)).norm(), 1);
}

}  // namespace
}  // namespace palpa::scene
