#include "apps/task_palpation/palpation_scene.h"

#include <gtest/gtest.h>

namespace palpa::task_palpation {
namespace {

struct Shown {
  runtime::ToolState tool;
  Mat3 R_AD = (Mat3() << 0, -1, 0, 1, 0, 0, 0, 0, 1).finished();
  Pose X_AT = makePose(Mat3::Identity(), Vec3(0.01, 0.02, 0.03));
  Shown() {
    tool.f_sensed_D = {0.1, 0.2, 0.9};
    tool.f_command_D = {0, 0.3, 0.1};
  }
};

TEST(ShownForces, WhileSomethingIsSearchedWhatIsFeltIsOneArrow) {
  const Shown s;
  const std::vector<scene::ForceArrow> arrows = shownForces(s.tool, s.R_AD, s.X_AT, false);
  ASSERT_EQ(arrows.size(), 1u);
  EXPECT_EQ(arrows[0].kind, scene::ForceKind::reaction);
  EXPECT_LT((arrows[0].f_A - Vec3(-0.5, 0.1, 1.0)).norm(), 1e-12);
  EXPECT_LT((arrows[0].p_A - s.X_AT.translation()).norm(), 1e-12);
}

TEST(ShownForces, ApartTheyAreTheForcesOfTheRecord) {
  const Shown s;
  const std::vector<scene::ForceArrow> arrows = shownForces(s.tool, s.R_AD, s.X_AT, true);
  ASSERT_EQ(arrows.size(), 3u);
  EXPECT_LT((arrows[0].f_A - Vec3(-0.2, 0.1, 0.9)).norm(), 1e-12);
  EXPECT_EQ(arrows[1].kind, scene::ForceKind::device);
  EXPECT_LT((arrows[1].f_A - Vec3(-0.3, 0, 0.1)).norm(), 1e-12);
  EXPECT_EQ(arrows[2].kind, scene::ForceKind::felt);
  EXPECT_LT((arrows[2].f_A - Vec3(-0.5, 0.1, 1.0)).norm(), 1e-12);
}

TEST(ShownForces, NothingThatNobodyFeels) {
  Shown s;
  s.tool.f_sensed_D = {0, 0, 0.03};
  s.tool.f_command_D = {0, 0, 0};
  EXPECT_TRUE(shownForces(s.tool, s.R_AD, s.X_AT, false).empty());
}

}  // namespace
}  // namespace palpa::task_palpation
