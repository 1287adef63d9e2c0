#include <gtest/gtest.h>

#include "anatomy/parametric/phantoms.h"
#include "tests/scene/offscreen.h"

/// A thing in the hands: it is drawn where it is held, between two probes.
namespace palpa::scene {
namespace {

constexpr int kBackground = 128;

class HeldBody : public testing::Test {
 protected:
  HeldBody() {
    state_.skin = SkinStyle::solid;
    state_.show_tool = false;
  }
  /// Whether something is drawn where a point of the body is seen.
  bool drawnAt(const Vec3& p_A) {
    const Image image = (view_.show(state_), view_.capture());
    const Eigen::Vector2d px = project(state_.camera, state_.X_CA * p_A);
    const Pixel p =
        at(image, static_cast<int>(std::lround(px.x())), static_cast<int>(std::lround(px.y())));
    return std::abs(p.r - kBackground) + std::abs(p.g - kBackground) + std::abs(p.b - kBackground) >
           30;
  }
  const anatomy::Patient block_ = anatomy::phantomBlock({0.02, 0.02, 0.02}, "thing");
  const Image picture_ = plain(320, 240, kBackground);
  SceneState state_ = straightOn(picture_);
  SceneView view_{offscreen(), block_, {320, 240, FixedViews::none, true}};
};

TEST_F(HeldBody, IsDrawnWhereItIsHeld) {
  const Vec3 middle = anatomy::X_AP() * Vec3(0, 0, -0.01), moved(0.03, 0, 0);
  EXPECT_TRUE(drawnAt(middle));
  EXPECT_FALSE(drawnAt(middle + moved));
  state_.X_AB.translation() = moved;
  EXPECT_FALSE(drawnAt(middle));
  EXPECT_TRUE(drawnAt(middle + moved));
  state_.X_AB = Pose::Identity();
  EXPECT_TRUE(drawnAt(middle)) << "and back";
}

TEST_F(HeldBody, AnotherProbeIsSeenWhileThereIsOne) {
  const Vec3 beside(0.03, 0.02, 0);
  EXPECT_FALSE(drawnAt(beside));
  state_.second_X_AT = makePose(rotationWithZ(Vec3(-1, 0, 0)), beside - Vec3(0.006, 0, 0));
  EXPECT_TRUE(drawnAt(beside));
  state_.second_X_AT.reset();
  EXPECT_FALSE(drawnAt(beside));
}

}  // namespace
}  // namespace palpa::scene
