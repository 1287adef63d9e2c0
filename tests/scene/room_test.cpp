#include <gtest/gtest.h>

#include "scene/actors/table.h"
#include "tests/scene/offscreen.h"

/// What eyes see round a patient when they see nothing else.
namespace palpa::scene {
namespace {

constexpr int kWide = 800, kHigh = 400;

/// Both eyes half a metre above what lies there, looking down at it at 45 degrees, or level.
SceneState lookedAt(const Vec3& from_A, const Vec3& at_A) {
  const Vec3 ahead = (at_A - from_A).normalized(), down(0, 1, 0);
  const Vec3 right = down.cross(ahead).normalized();
  Mat3 R_AC;
  R_AC << right, ahead.cross(right), ahead;
  const Pose X_CA = makePose(R_AC, from_A).inverse();
  SceneState state;
  state.show_tool = false;
  state.registered = true;
  state.X_CA = X_CA;
  EyeCamera eye{{kWide / 2, kHigh, 200, 200, kWide / 4 - 0.5, kHigh / 2 - 0.5}, X_CA};
  state.eyes = std::array<EyeCamera, 2>{eye, eye};
  return state;
}

Image shown(const anatomy::Patient& patient, const SceneState& state, bool see_through) {
  ViewLayout layout;
  layout.width = kWide;
  layout.height = kHigh;
  layout.fixed_views = FixedViews::none;
  layout.stereo = Stereo::headset;
  layout.see_through = see_through;
  SceneView view(offscreen(), patient, layout);
  view.show(state);
  return view.capture();
}

const anatomy::Patient& ball() {
  static const anatomy::Patient patient = [] {
    anatomy::Patient made = test::spherePatient({0, 0, 0}, 0.1);
    made.organs.front().organ = Organ::skin;
    return made;
  }();
  return patient;
}

TEST(Room, HasAFloorWallsAndATableUnderWhatLiesThere) {
  ASSERT_TRUE(tableUnder(ball()));
  EXPECT_NEAR(tableUnder(ball())->y, 0.1, 1e-3);
  const Image level = shown(ball(), lookedAt({0, -0.6, -1.5}, {0, -0.6, 0}), false);
  for (const int eye : {0, 1}) {
    const int middle = eye * kWide / 2 + kWide / 4;
    const double above = luminance(at(level, middle, 20)),
                 ahead = luminance(at(level, middle, 150)),
                 below = luminance(at(level, middle - 150, kHigh - 10));
    EXPECT_GT(above, ahead) << "the ceiling is lighter than the wall";
    EXPECT_GT(ahead, below) << "and that than the floor";
    EXPECT_GT(below, 0.01) << "which is no void";
  }
  const Image down = shown(ball(), lookedAt({0, -0.6, -0.6}, {0, 0.1, 0}), false);
  const Pixel table = at(down, kWide / 4 - 70, kHigh / 2);
  const Pixel wood{int(255 * colour::kTable[0]), int(255 * colour::kTable[1]),
                   int(255 * colour::kTable[2])};
  EXPECT_LT(difference(table, wood), 25) << "beside the ball";
}

TEST(Room, IsNotThereForWhoSeesTheRealOne) {
  const Image seen = shown(ball(), lookedAt({0, -0.6, -1.5}, {0, -0.6, 0}), true);
  EXPECT_LT(luminance(at(seen, kWide / 4, 20)), 1e-6);
  EXPECT_LT(luminance(at(seen, kWide / 4 - 150, kHigh - 10)), 1e-6);
}

}  // namespace
}  // namespace palpa::scene
