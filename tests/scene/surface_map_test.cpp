#include "scene/actors/surface_map.h"

#include <gtest/gtest.h>

#include <cmath>

#include "anatomy/parametric/phantoms.h"
#include "tests/scene/offscreen.h"

/// A learnt map on what it was learnt of, as pixels: colours by value, stripes where it is hardly
/// known, a legend.
namespace palpa::scene {
namespace {

constexpr int kNodes = 9;
constexpr double kNodeStep = 0.008;  // m

const anatomy::Patient& mappedBlock() {
  static const anatomy::Patient patient = anatomy::phantomBlock({0.1, 0.1, 0.05}, "block");
  return patient;
}

/// Rising along x; hardly known where y is above 0.
SurfaceMap risingMap() {
  SurfaceMap map;
  map.X_AG = anatomy::X_AP();
  map.columns = map.rows = kNodes;
  map.low_x = map.low_y = -kNodeStep * (kNodes - 1) / 2;
  map.step_x = map.step_y = kNodeStep;
  for (int j = 0; j < kNodes; ++j)
    for (int i = 0; i < kNodes; ++i) {
      map.values.push_back(0.1F + 0.05F * static_cast<float>(i));
      map.unsure.push_back(j > kNodes / 2);
    }
  map.title = "Stiffness";
  map.unit = "N/mm";
  return map;
}

class MapOnBlock : public testing::Test {
 protected:
  Image frame() { return (view_.show(state_), view_.capture()); }
  Pixel seenAt(const Image& image, double x, double y) const {
    const Eigen::Vector2d px =
        project(state_.camera, state_.X_CA * (anatomy::X_AP() * Vec3(x, y, 0)));
    return at(image, static_cast<int>(std::lround(px.x())), static_cast<int>(std::lround(px.y())));
  }
  const Image picture_ = plain(320, 240, 128);
  SceneState state_ = straightOn(picture_);
  SceneView view_{offscreen(), mappedBlock(), {320, 240, FixedViews::none, true}};
  const SurfaceMap map_ = risingMap();
};

double luma(double r, double g, double b) { return 0.2126 * r + 0.7152 * g + 0.0722 * b; }
double luma(const Pixel& p) { return luma(p.r, p.g, p.b); }

TEST(MapScale, RisesInBrightnessFromOneEndToTheOther) {
  const auto brightness = [](double share) {
    const Rgb colour = scaleColour(share);
    return luma(colour[0], colour[1], colour[2]);
  };
  const double even = (brightness(1) - brightness(0)) / 50;
  EXPECT_GT(even, 0.5 / 50);
  for (int i = 1; i <= 50; ++i) {
    const double step = brightness(i / 50.0) - brightness((i - 1) / 50.0);
    EXPECT_GT(step, 0) << i;
    EXPECT_LT(step, 1.6 * even) << i;
  }
  EXPECT_EQ(scaleColour(-1), scaleColour(0));
  EXPECT_EQ(scaleColour(7), scaleColour(1));
  const ColourScale scale = scaleOf(risingMap());
  EXPECT_EQ(scale.low, "0.1");
  EXPECT_EQ(scale.high, "0.5 N/mm");
  EXPECT_TRUE(scale.any_unsure);
}

TEST_F(MapOnBlock, IsBrighterWhereItIsMoreAndNowhereElse) {
  const Image bare = frame();
  state_.surface_map = &map_;
  const Image with = frame();
  const double y = -0.012;
  EXPECT_GT(luma(seenAt(with, 0.026, y)), luma(seenAt(with, 0.0, y)) + 25);
  EXPECT_GT(luma(seenAt(with, 0.0, y)), luma(seenAt(with, -0.026, y)) + 25);
  EXPECT_EQ(difference(seenAt(with, 0.04, y), seenAt(bare, 0.04, y)), 0) << "beyond the map";
  state_.surface_map = nullptr;
  EXPECT_EQ(changed(frame(), bare).count, 0) << "it is off";
}

/// Along a line of one value: one colour where it is known, pale stripes where it is hardly known.
TEST_F(MapOnBlock, IsStripedAndPalerWhereItIsHardlyKnown) {
  state_.surface_map = &map_;
  const Image with = frame();
  const auto spread = [&](double y0) {
    double least = 1e9, most = 0;
    for (double y = y0; y < y0 + 0.012; y += 2e-4) {
      const double now = luma(seenAt(with, -0.02, y));
      least = std::min(least, now);
      most = std::max(most, now);
    }
    return std::pair(least, most);
  };
  const auto [known_least, known_most] = spread(-0.022);
  const auto [hardly_least, hardly_most] = spread(0.012);
  EXPECT_LT(known_most - known_least, 6);
  EXPECT_GT(hardly_most - hardly_least, 30);
  EXPECT_GT(hardly_least, known_most);
}

/// What has been felt would hide it: there its outline alone is drawn.
TEST_F(MapOnBlock, TakesThePlaceOfWhatHasBeenFelt) {
  state_.surface_map = &map_;
  state_.coverage = CoverageGrid{anatomy::X_AP(), 0.01, 0.01, 6, 6, std::vector<std::uint8_t>(36)};
  const Image clear = frame();
  state_.coverage->levels.assign(36, 3);
  EXPECT_EQ(changed(frame(), clear).count, 0);
}

TEST_F(MapOnBlock, AMapWithoutAFigureForEachNodeIsNotShown) {
  const Image bare = frame();
  SurfaceMap damaged = map_;
  damaged.values.pop_back();
  state_.surface_map = &damaged;
  const Pixel there = seenAt(frame(), 0.02, -0.01);
  EXPECT_EQ(difference(there, seenAt(bare, 0.02, -0.01)), 0);
}

}  // namespace
}  // namespace palpa::scene
