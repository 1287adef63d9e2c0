#include <gtest/gtest.h>

#include "scene/actors/camera_picture.h"
#include "scene/actors/force_arrows.h"
#include "scene/actors/lines.h"
#include "tests/scene/offscreen.h"

/// What lies over the picture besides the patient: real things that hide, lines that lead, an
/// ellipse that owns up to an error.
namespace palpa::scene {
namespace {

SceneState before(const Image& picture) {
  SceneState state = straightOn(picture);
  state.skin = SkinStyle::hidden;
  return state;
}

Image frameOf(const anatomy::Patient& patient, const SceneState& state,
              ForceColours colours = ForceColours::paper) {
  ViewLayout layout{320, 240, FixedViews::none, true};
  layout.force_colours = colours;
  SceneView view(offscreen(), patient, layout);
  view.show(state);
  return view.capture();
}

anatomy::Patient aBall() {
  anatomy::Patient patient;
  test::add(patient, "ball", Organ::artery, test::sphere({0, 0, 0}, Vec3::Constant(0.03)));
  return patient;
}

TEST(Occluders, ARealThingInFrontHidesAndShowsThePicture) {
  const Image picture = plain(320, 240, 90);
  const anatomy::TriangleMesh thing = test::sphere({0, 0, 0}, Vec3::Constant(0.01));
  SceneState state = before(picture);
  const Pixel bare = at(frameOf(aBall(), state), 160, 120);
  EXPECT_GT(bare.r - bare.b, 60);
  state.occluders = {{&thing, makePose(Mat3::Identity(), Vec3(0, -0.1, 0))}};
  const Image hidden = frameOf(aBall(), state);
  EXPECT_LE(difference(at(hidden, 160, 120), {90, 90, 90}), 1);
  state.occluders.clear();
  const Pixel beside = at(frameOf(aBall(), state), 178, 120);
  EXPECT_GT(difference(beside, {90, 90, 90}), 40);
  EXPECT_LE(difference(at(hidden, 178, 120), beside), 1);  // there the ball is seen as before
  state.occluders = {{&thing, makePose(Mat3::Identity(), Vec3(0, -0.1, 0))}};
  state.occluders[0].X_A = makePose(Mat3::Identity(), Vec3(0, 0.1, 0));  // behind
  EXPECT_LE(difference(at(frameOf(aBall(), state), 160, 120), bare), 1);
  state.occluders[0].X_A = makePose(Mat3::Identity(), Vec3(0, -0.1, 0));
  state.picture = nullptr;  // nothing real is seen
  EXPECT_GT(difference(at(frameOf(aBall(), state), 160, 120), {90, 90, 90}), 40);
}

/// In the corner the camera's picture as it is, in the large view the same under the patient;
/// without a picture nothing.
TEST(Inset, ShowsThePictureWithoutTheOverlay) {
  Image picture = plain(320, 240, 60);
  for (int v = 0; v < 240; ++v)
    for (int u = 160; u < 320; ++u)
      picture.pixels[3 * (static_cast<std::size_t>(v) * 320 + u)] = 200;  // its right half is red
  const auto shown = [&](Inset inset, const Image* seen) {
    ViewLayout layout{640, 480, FixedViews::none, true};
    layout.inset = inset;
    SceneState state = before(picture);
    state.picture = seen;
    SceneView view(offscreen(), aBall(), layout);
    view.show(state);
    return view.capture();
  };
  const Image with = shown(Inset::camera, &picture), without = shown(Inset::none, &picture);
  const Rect where = insetRect({0, 0, 640, 480}, 320, 240);
  const int middle = 480 - 1 - (where.y + where.height / 2);
  for (const double across : {0.1, 0.45, 0.55, 0.9}) {
    const Pixel p = at(with, where.x + static_cast<int>(across * where.width), middle);
    EXPECT_LE(difference(p, across < 0.5 ? Pixel{60, 60, 60} : Pixel{200, 60, 60}), 2) << across;
  }
  const Blob apart = changed(with, without);
  EXPECT_GE(apart.left, where.x);
  EXPECT_GE(apart.top, 480 - where.top());
  EXPECT_GT(apart.count, where.width * where.height / 3);
  EXPECT_EQ(changed(shown(Inset::camera, nullptr), shown(Inset::none, nullptr)).count, 0);
}

TEST(Ellipse, IsWhere95PercentOfThePixelsLie) {
  const Pinhole camera{640, 480, 600, 580, 310, 250};
  const Pose X_CA = lookAt({0.1, -0.5, 0.05}, {0, 0, 0});
  const Vec3 p_A(0.02, 0.01, -0.03);
  Mat3 L;
  L << 0.004, 0, 0, 0.002, 0.003, 0, -0.001, 0.001, 0.006;
  const Mat3 S = L * L.transpose();
  const auto ellipse = uncertaintyEllipse(S, p_A, X_CA, camera);
  ASSERT_FALSE(ellipse.empty());
  // Drawn points: the share of them whose pixel lies inside the polygon, by the crossing rule.
  std::vector<Eigen::Vector2d> outline;
  for (const Vec3& q : ellipse) outline.push_back(project(camera, X_CA * q));
  std::uint64_t bits = 7;
  const auto uniform = [&] {
    return static_cast<double>((bits = bits * 6364136223846793005ull + 1442695040888963407ull) >>
                               11) *
           0x1p-53;
  };
  const auto normal = [&] {
    return std::sqrt(-2 * std::log(1 - uniform())) * std::cos(6.283185307179586 * uniform());
  };
  int inside = 0;
  const int all = 20000;
  for (int k = 0; k < all; ++k) {
    const double x = normal(), y = normal(), z = normal();
    const Eigen::Vector2d p = project(camera, X_CA * (p_A + L * Vec3(x, y, z)));
    bool in = false;
    for (std::size_t i = 0, j = outline.size() - 1; i < outline.size(); j = i++) {
      const auto &a = outline[i], &b = outline[j];
      if ((a.y() > p.y()) != (b.y() > p.y()) &&
          p.x() < (b.x() - a.x()) * (p.y() - a.y()) / (b.y() - a.y()) + a.x())
        in = !in;
    }
    inside += in;
  }
  EXPECT_NEAR(static_cast<double>(inside) / all, 0.95, 0.006);
  EXPECT_TRUE(uncertaintyEllipse(1e-6 * S, p_A, X_CA, camera).empty())
      << "smaller than a pixel: the words say it";
}

TEST(Ellipse, IsDrawnAboutTheTipAndOnlyWhereTheCameraIsReal) {
  const Image picture = plain(320, 240, 90);
  SceneState state = before(picture);
  state.X_AT.translation() = Vec3(0.05, 0, 0.03);
  const Image without = frameOf(aBall(), state);
  state.tip_covariance_A = 4e-5 * Mat3::Identity();  // 6.3 mm
  const Blob ring = changed(frameOf(aBall(), state), without);
  const Eigen::Vector2d tip = project(state.camera, state.X_CA * state.X_AT.translation());
  EXPECT_NEAR((ring.left + ring.right) / 2.0, tip.x(), 1.5);
  EXPECT_NEAR((ring.top + ring.bottom) / 2.0, tip.y(), 1.5);
  EXPECT_NEAR((ring.right - ring.left) / 2.0, std::sqrt(5.991 * 4e-5) * 300 / 0.4, 3);
  state.picture = nullptr;
  state.registered = false;
  const Image virtual_view = frameOf(aBall(), state);
  state.tip_covariance_A.reset();
  EXPECT_EQ(changed(virtual_view, frameOf(aBall(), state)).count, 0);
}

TEST(Guide, RunsInDashesFromTheEntryToTheTargetAndIsNeverHidden) {
  const auto lines = dashes({0, 0, 0}, {0, 0, 0.05});
  EXPECT_EQ(lines.size(), 7u);
  double drawn = 0;
  for (const auto& line : lines) drawn += (line.back() - line.front()).norm();
  EXPECT_NEAR(drawn, 6 * 0.005 + 0.002, 1e-12);
  EXPECT_LT((lines.back().back() - Vec3(0, 0, 0.05)).norm(), 1e-12);
  const Image picture = plain(320, 240, 90);
  SceneState state = before(picture);
  const Image without = frameOf(aBall(), state);
  state.guide = GuideLine{{-0.08, 0, 0}, {0.08, 0, 0}};
  const Image with = frameOf(aBall(), state);
  const Blob line = changed(with, without);
  EXPECT_NEAR(line.left, project(state.camera, state.X_CA * Vec3(-0.08, 0, 0)).x(), 3);
  EXPECT_NEAR(line.right, project(state.camera, state.X_CA * Vec3(0.08, 0, 0)).x(), 3);
  EXPECT_LT(std::abs(line.v - 119.5), 2);
  const Blob inside = blobOf(with, [&](int u, int v) {
    return u > 145 && u < 175 && difference(at(with, u, v), at(without, u, v)) > 2;
  });
  EXPECT_GT(inside.count, 10) << "it leads through what is opaque";
}

TEST(ForceColours, AreToldApartByBrightnessAloneInBothSchemes) {
  for (const ForceColours scheme : {ForceColours::paper, ForceColours::safe}) {
    const double reaction = luminance(arrowColour(ForceKind::reaction, scheme)),
                 weight = luminance(arrowColour(ForceKind::weight, scheme)),
                 device = luminance(arrowColour(ForceKind::device, scheme)),
                 felt = luminance(arrowColour(ForceKind::felt, scheme));
    EXPECT_GT(felt - device, 0.2);
    EXPECT_GT(weight - reaction, 0.1);
    EXPECT_GT(device - weight, 0.2);
  }
  const Image picture = plain(320, 240, 90);
  SceneState state = before(picture);
  state.forces = {{ForceKind::reaction, {0, -0.05, 0}, {0, 0, 1.5}}};
  const auto orange = [](const Image& image) {
    return blobOf(image, [&](int u, int v) {
      const Pixel p = at(image, u, v);
      return p.r > p.b + 90 && v < 110;
    });
  };
  anatomy::Patient nobody = test::spherePatient({0, 0.5, 0}, 0.001);
  EXPECT_EQ(orange(frameOf(nobody, state)).count, 0);
  EXPECT_GT(orange(frameOf(nobody, state, ForceColours::safe)).count, 30);
}

}  // namespace
}  // namespace palpa::scene
