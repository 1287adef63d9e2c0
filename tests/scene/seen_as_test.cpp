#include <gtest/gtest.h>

#include <cmath>

#include "anatomy/parametric/body_part.h"
#include "anatomy/parametric/phantoms.h"
#include "tests/scene/offscreen.h"

/// A block of silicone, seen as the part of a body that it stands for.
namespace palpa::scene {
namespace {

/// In the large view, where the block ends the body goes on; the fixed views keep to the block.
TEST(SeenAs, TheLargeViewHasThePartOfABodyAndTheFixedOnesTheBlock) {
  const anatomy::Patient block = anatomy::phantomBlock({0.1, 0.1, 0.05}, "block");
  anatomy::Patient part = block;
  part.seen_as = anatomy::bodyPart(anatomy::BodyPart::abdomen, {}, {0.03, 0.03}, 0.05);
  const Image dark = plain(640, 480, 0);
  SceneState state = straightOn(dark);
  state.camera = {640, 480, 500, 500, 319.5, 239.5};
  state.X_CA = lookAt({0, -0.5, -0.1}, {0, 0, 0});
  const auto frameOf = [&](const anatomy::Patient& patient, FixedViews fixed) {
    SceneView view(offscreen(), patient, {fixed == FixedViews::none ? 640 : 900, 480, fixed, true});
    view.show(state);
    return view.capture();
  };
  const Image as_block = frameOf(block, FixedViews::none),
              as_part = frameOf(part, FixedViews::none);
  const auto redAt = [&](const Image& image, const Vec3& p_A) {
    const Eigen::Vector2d px = project(state.camera, state.X_CA * p_A);
    return at(image, static_cast<int>(std::lround(px.x())), static_cast<int>(std::lround(px.y())))
        .r;
  };
  const Vec3 beside_A = anatomy::X_AP() * Vec3(-0.085, 0, -0.02);
  EXPECT_GT(redAt(as_part, anatomy::X_AP() * Vec3(0, 0, 0)), 60);
  EXPECT_LT(redAt(as_block, beside_A), 10);
  EXPECT_GT(redAt(as_part, beside_A), 60);
  const Image block_views = frameOf(block, FixedViews::three),
              part_views = frameOf(part, FixedViews::three);
  EXPECT_EQ(blobOf(block_views,
                   [&](int u, int v) {
                     return u > 640 && difference(at(block_views, u, v), at(part_views, u, v)) > 0;
                   })
                .count,
            0);
}

}  // namespace
}  // namespace palpa::scene
