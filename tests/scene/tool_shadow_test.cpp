#include "scene/actors/tool_shadow.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <set>

#include "anatomy/parametric/phantoms.h"
#include "scene/actors/instrument.h"
#include "scene/actors/table.h"
#include "tests/scene/offscreen.h"

namespace palpa::scene {
namespace {

/// A flat block of 120 x 100 x 30 mm whose top is y = 0, up is -y.
const anatomy::Patient& slab() {
  static const anatomy::Patient patient = anatomy::phantomBlock({0.12, 0.10, 0.03}, "block");
  return patient;
}

const anatomy::TriangleTree& skin() {
  static const anatomy::TriangleTree tree(slab().organs.front().mesh);
  return tree;
}

/// A needle `height` above the block's top at (x, z), that points down and to one side.
Pose above(double x, double height, double z) {
  return makePose(rotationWithZ(Vec3(0.5, 1, 0.2).normalized()), Vec3(x, -height, z));
}

TEST(ToolShadow, OfATipLiesStraightBelowIt) {
  for (const double height : {0.001, 0.010, 0.040}) {
    const Pose X_AT = above(0.005, height, -0.004);
    const auto places = shadowOf(Tool::needle, X_AT, skin());
    ASSERT_EQ(places.size(), sectionsOf(Tool::needle).size());
    ASSERT_TRUE(places.front());
    const Vec3 expected(X_AT.translation().x(), 0, X_AT.translation().z());
    EXPECT_NEAR((places.front()->p_A - expected).norm(), 0, 1e-9) << height;
    EXPECT_NEAR((places.front()->n_A - Vec3(0, -1, 0)).norm(), 0, 1e-6);
  }
}

TEST(ToolShadow, IsNarrowAndDarkNearTheSkin) {
  const auto near = shadowOf(Tool::needle, above(0, 0.001, 0), skin()).front(),
             far = shadowOf(Tool::needle, above(0, 0.040, 0), skin()).front();
  ASSERT_TRUE(near && far);
  EXPECT_LT(near->half_width, 0.5 * far->half_width);
  EXPECT_GT(near->dark, 1.5 * far->dark);
}

TEST(ToolShadow, WhatIsInsideCastsNone) {
  const auto places = shadowOf(Tool::needle, above(0, -0.010, 0), skin());
  EXPECT_FALSE(places.front());
  EXPECT_TRUE(places[8]) << "32 mm behind the tip it is outside";
}

TEST(ToolShadow, BesideTheBlockThereIsNone) {
  for (const auto& place : shadowOf(Tool::probe, above(0.5, 0.01, 0), skin())) EXPECT_FALSE(place);
}

TEST(ToolShadow, TheRingIsWhereTheNeedleWentIn) {
  const Pose X_AT = above(0.003, -0.012, 0.002);
  const auto entry = entryOf(X_AT, skin());
  ASSERT_TRUE(entry);
  const Vec3 way = X_AT.linear().col(2);
  const Vec3 expected = X_AT.translation() - 0.012 / way.y() * way;
  EXPECT_NEAR((entry->p_A - expected).norm(), 0, 1e-9);
  EXPECT_FALSE(entryOf(above(0, 0.002, 0), skin())) << "it is still outside";
}

TEST(GroundShade, IsDarkUnderTheThingAndAtItsFootAndNothingFarOff) {
  const double half = 0.25;
  const GroundShade shade =
      groundShade({&slab().organs.front().mesh}, 0.03, Eigen::Vector2d(0, 0), half);
  const auto at = [&](double x, double z) {
    const auto texel = [&](double p) {
      return static_cast<int>((p + half) / (2 * half) * shade.texels);
    };
    return shade.at(texel(x), texel(z));
  };
  EXPECT_GT(at(0, 0), 0.5F);
  EXPECT_GT(at(0.062, 0), 0.2F);
  EXPECT_LT(at(0.062, 0), at(0, 0));
  EXPECT_LT(at(0.085, 0), at(0.062, 0));
  EXPECT_LT(at(0.2, 0.2), 0.01F);
}

/// A real block is seen through its overlay.
TEST(Walls, AreNotDrawnOverACamerasPicture) {
  SceneView view(offscreen(), slab(), {320, 240, FixedViews::none});
  const auto middleOn = [&](const Image* picture) {
    SceneState state = straightOn(picture ? *picture : Image());
    state.picture = picture;
    view.show(state);
    return at(view.capture(), 160, 120).g;
  };
  const Image dark = plain(320, 240, 20), bright = plain(320, 240, 220);
  EXPECT_GT(middleOn(&bright) - middleOn(&dark), 100);
  EXPECT_GT(middleOn(nullptr), 120) << "without a picture, silicone";
}

/// A flat plate of bone across y = 0, whose upper edge is z = 0.05.
const anatomy::Patient& plate() {
  static const anatomy::Patient patient = [] {
    anatomy::Patient made;
    const auto corner = [](int i, int j) { return Vec3(j ? 0.1 : -0.1, 0, i ? 0.05 : -0.1); };
    made.organs.push_back(
        {"bone",
         Organ::clavicle,
         test::gridMesh(2, 2, false, corner, [](int, int) { return Vec3(0, -1, 0); }),
         {1, 1, 1, 1}});
    return made;
  }();
  return patient;
}

/// How many levels there are along the plate's edge, turned 5 degrees from the rows.
std::size_t levelsAlongEdge(const Image* picture, bool see_through = false) {
  SceneState state = straightOn(picture ? *picture : Image());
  state.picture = picture;
  state.camera = {320, 240, 500, 500, 159.5, 119.5};
  const double turn = 5 * std::numbers::pi / 180;
  state.X_CA = makePose(Eigen::AngleAxisd(turn, Vec3::UnitZ()).toRotationMatrix(), Vec3::Zero()) *
               lookAt({0, -0.4, 0.05}, {0, 0, 0.05});
  ViewLayout layout{320, 240, FixedViews::none};
  layout.see_through = see_through;
  SceneView view(offscreen(), plate(), layout);
  view.show(state);
  const Image image = view.capture();
  std::set<int> levels;
  for (int u = 130; u < 190; ++u)
    for (int v = 1; v + 1 < image.height; ++v) {
      const int here = at(image, u, v).r, up = at(image, u, v - 1).r, down = at(image, u, v + 1).r;
      if (std::abs(up - down) > 25 && std::min(up, down) + 2 < here &&
          here < std::max(up, down) - 2)
        levels.insert(here);
    }
  return levels.size();
}

/// Before the world itself nothing is smoothed: there it is a staircase.
TEST(Edges, AreDrawnInManyLevels) {
  const Image dark = plain(320, 240, 20);
  EXPECT_LE(levelsAlongEdge(nullptr, true), 3u);
  EXPECT_GE(levelsAlongEdge(&dark), 8u);
  EXPECT_GE(levelsAlongEdge(nullptr), 8u);
}

}  // namespace
}  // namespace palpa::scene
