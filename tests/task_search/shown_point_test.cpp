#include <gtest/gtest.h>

#include "apps/task_search/search_scene.h"

namespace palpa::task_search {
namespace {

const Pose kX_AF = makePose(rotationWithZ(Vec3(0, -1, 0)), Vec3(0.1, -0.05, 0.2));

TEST(ShownPoint, IsMagnifiedAboutTheFloorsMiddle) {
  const Vec3 p_F(0.002, -0.003, 0.001);
  EXPECT_NEAR((kX_AF.inverse() * shownPoint(kX_AF, 10, p_F) - 10 * p_F).norm(), 0, 1e-12);
}

/// 1.6 mm into a floor that gives way would be 16 mm under the one that is shown.
TEST(ShownPoint, IsNeverUnderTheFloor) {
  const Vec3 shown = kX_AF.inverse() * shownPoint(kX_AF, 10, Vec3(0.002, -0.003, -0.0016));
  EXPECT_NEAR((shown - Vec3(0.02, -0.03, 0)).norm(), 0, 1e-12);
}

}  // namespace
}  // namespace palpa::task_search
