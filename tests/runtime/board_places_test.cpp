#include "apps/runtime/camera_trouble.h"

#include <gtest/gtest.h>

namespace palpa::runtime {
namespace {

Pose turnedAt(double about_z, const Vec3& p) {
  return makePose(Eigen::AngleAxisd(about_z, Vec3::UnitZ()).toRotationMatrix(), p);
}

/// A board that belongs at `X_WB` and is seen off by `off`, in its own frame, by some camera.
std::string told(const Pose& off, double tolerance = 0.003,
                 std::optional<std::size_t> was = std::nullopt) {
  const Pose X_WB = turnedAt(0.4, {0.16, 0.01, 0}),
             X_CW =
                 makePose(Eigen::AngleAxisd(2.5, Vec3(1, 0.2, 0).normalized()).toRotationMatrix(),
                          {0.02, -0.05, 0.5});
  CameraView view;
  view.X_CW = X_CW;
  view.others = {std::nullopt, X_CW * X_WB * off};
  const auto displaced =
      displacedBoard(view, {{"lid", Pose::Identity(), 0.001}, {"phantom", X_WB, tolerance}}, was);
  return displaced ? displaced->words : "";
}

TEST(BoardPlaces, WhatIsElsewhereIsToldWithHowFar) {
  EXPECT_EQ(told(Pose::Identity()), "");
  EXPECT_EQ(told(turnedAt(0.02, {0.0015, 0.001, 0})), "");
  EXPECT_EQ(told(turnedAt(0, {0.006, 0, 0.008})),
            "the phantom has moved by 10 mm: put it back, or calibrate again");
  EXPECT_EQ(told(turnedAt(0.0873, Vec3::Zero())),
            "the phantom is turned by 5.0 degrees: turn it back, or calibrate again");
  EXPECT_EQ(told(turnedAt(0, {0.006, 0, 0.008}), 0.02), "");
  EXPECT_EQ(told(turnedAt(0, {0.0025, 0, 0})), "");
  EXPECT_NE(told(turnedAt(0, {0.0025, 0, 0}), 0.003, 1), "")
      << "told before, it is told until it is well back";
  EXPECT_EQ(told(turnedAt(0, {0.002, 0, 0}), 0.003, 1), "");
}

TEST(BoardPlaces, WhatIsNotSeenOrBelongsNowhereIsNotTold) {
  CameraView view;
  view.others = {turnedAt(1, {1, 2, 3})};
  EXPECT_FALSE(displacedBoard(view, {{"phantom", Pose::Identity()}})) << "the table is not seen";
  view.X_CW = Pose::Identity();
  EXPECT_TRUE(displacedBoard(view, {{"phantom", Pose::Identity()}}));
  EXPECT_FALSE(displacedBoard(view, {{"instrument", std::nullopt}}));
  view.others.clear();
  EXPECT_FALSE(displacedBoard(view, {{"phantom", Pose::Identity()}}));
}

}  // namespace
}  // namespace palpa::runtime
