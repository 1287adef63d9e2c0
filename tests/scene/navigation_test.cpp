#include "scene/view/navigation.h"

#include <gtest/gtest.h>

#include "tests/scene/offscreen.h"

namespace palpa::scene {
namespace {

const Vec3 kTarget(-0.07, 0.01, -0.02);

TEST(OrbitCamera, KeepsItsTargetInTheMiddleAndUprightWhereverItGoes) {
  OrbitCamera camera(kTarget, 0.3, 0.4, 0.5);
  for (int i = 0; i < 20; ++i) {
    camera.orbit(0.4, i % 2 ? 0.3 : -0.25);
    camera.zoom(1.05);
    const Vec3 p_C = camera.X_CA() * kTarget;
    EXPECT_NEAR(p_C.x(), 0, 1e-12);
    EXPECT_NEAR(p_C.y(), 0, 1e-12);
    EXPECT_GT(p_C.z(), 0);
    const Vec3 up_C = camera.X_CA().linear() * Vec3::UnitZ();
    EXPECT_NEAR(up_C.x(), 0, 1e-12);
    EXPECT_LT(up_C.y(), 0);  // +y of C is down
    EXPECT_NEAR(camera.X_CA().linear().determinant(), 1, 1e-12);
  }
  camera.reset();
  EXPECT_TRUE(camera.X_CA().isApprox(OrbitCamera(kTarget, 0.3, 0.4, 0.5).X_CA(), 1e-12));
}

TEST(OrbitCamera, SeesThePatientsLeftOnTheRightFromTheFront) {
  const OrbitCamera camera(kTarget, 0, 0, 0.5);
  EXPECT_TRUE((camera.X_CA().linear() * Vec3::UnitX()).isApprox(Vec3::UnitX(), 1e-12));
}

class Drag : public testing::Test {
 protected:
  Pose after(bool left, bool middle, bool right, bool shift, double x0, double dx, double dy) {
    OrbitCamera camera(kTarget, 0.3, 0.4, 0.5);
    Navigation navigation;
    ViewInput input;
    input.mouse_x = x0;
    input.mouse_y = 200;
    navigation.apply(input, view_, 480, camera);
    input.left_button = left;
    input.middle_button = middle;
    input.right_button = right;
    input.shift = shift;
    navigation.apply(input, view_, 480, camera);
    input.mouse_x += dx;
    input.mouse_y += dy;
    navigation.apply(input, view_, 480, camera);
    return camera.X_CA();
  }
  const Rect view_{0, 0, 448, 480};
  const Pose still_ = OrbitCamera(kTarget, 0.3, 0.4, 0.5).X_CA();
};

TEST_F(Drag, MiddleOrbitsRightZoomsShiftPans) {
  const Pose orbited = after(false, true, false, false, 100, 40, 10);
  EXPECT_GT((orbited.linear() - still_.linear()).norm(), 0.1);
  EXPECT_NEAR((orbited * kTarget).z(), 0.5, 1e-12);
  const Pose zoomed = after(false, false, true, false, 100, 0, 60);
  EXPECT_TRUE(zoomed.linear().isApprox(still_.linear(), 1e-12));
  EXPECT_GT((zoomed * kTarget).z(), 0.55);
  const Pose panned = after(false, true, false, true, 100, 48, 0);
  EXPECT_TRUE(panned.linear().isApprox(still_.linear(), 1e-12));
  EXPECT_GT((panned * kTarget).x(), 0.01);  // what was in the middle went with the mouse
}

TEST_F(Drag, LeftButtonAndDragsFromOutsideMoveNothing) {
  EXPECT_TRUE(after(true, false, false, false, 100, 40, 10).isApprox(still_, 1e-15));
  EXPECT_TRUE(after(false, true, false, false, 500, -200, 10).isApprox(still_, 1e-15));
  EXPECT_TRUE(after(false, false, false, false, 100, 40, 10).isApprox(still_, 1e-15));
}

}  // namespace
}  // namespace palpa::scene
