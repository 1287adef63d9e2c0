#include "calibration/hand_eye.h"

#include <gtest/gtest.h>

#include <random>

#include "anatomy/base/error.h"
#include "calibration/rotation.h"

namespace palpa::calibration {
namespace {

/// A tool with four tags, held before a webcam; pixel noise of `sigma_px`, the tag's pose as the
/// corners tell it: noisy along the view.
struct TagStation {
  CameraModel camera{640, 480, 602, 601, 322, 237, {-0.21, 0.09, 0, 0, 0}, 0};
  Pose X_DW = makePose(rotationOf({1.5, 0.1, -0.1}), Vec3(0.01, 0.15, 0.2)),
       X_EM = makePose(rotationOf({-2.0, 0.05, 0}), Vec3(0, 0.03, -0.025));
  std::vector<TagView> views;
  std::vector<HandEyeSample> poses;

  TagStation(int seed, double sigma_px, int count = 20) {
    std::mt19937_64 bits(static_cast<std::uint64_t>(seed));
    const auto normal = [&bits] {  // sum of twelve: near enough, and the same on every machine
      double sum = -6;
      for (int i = 0; i < 12; ++i) sum += static_cast<double>(bits() >> 11) * 0x1p-53;
      return sum;
    };
    const auto normal3 = [&] {
      const double x = normal(), y = normal(), z = normal();
      return Vec3(x, y, z);
    };
    const Pose X_CW = makePose(rotationOf({2.4, 0.05, 0.02}), Vec3(0, -0.05, 0.5));
    for (int i = 0; i < count; ++i) {
      // Where the marker is before the camera, facing it roughly.
      const Pose X_CM =
          makePose(rotationOf(Vec3(3.14159 - 0.1, 0, 0)) * rotationOf(0.25 * normal3()),
                   Vec3(0.05 * normal(), 0.04 * normal(), 0.5 + 0.04 * normal()));
      TagView view;
      view.X_CW = X_CW;
      view.X_DE = X_DW * X_CW.inverse() * X_CM * X_EM.inverse();
      for (const double x : {-0.033, -0.003, 0.003, 0.033})
        for (const double y : {-0.033, -0.003, 0.003, 0.033}) {
          view.p_M.push_back({x, y, 0});
          const double du = normal(), dv = normal();
          view.pixels.push_back(camera.project(X_CM * view.p_M.back()) +
                                sigma_px * Eigen::Vector2d(du, dv));
        }
      Pose seen = X_CM;
      seen.translation() += 2e-3 * sigma_px * normal() * X_CM.translation().normalized() +
                            1e-4 * sigma_px * normal3();
      seen.linear() = seen.linear() * rotationOf(0.01 * sigma_px * normal3());
      poses.push_back({view.X_DE, X_CW.inverse() * seen});
      views.push_back(std::move(view));
    }
  }
};

TEST(HandEyeRefinement, ExactPicturesGiveTheTruth) {
  const TagStation s(1, 1e-4);
  const RefinedHandEye found = refineHandEye(s.views, s.poses, s.camera);
  EXPECT_LT((found.X_DW.translation() - s.X_DW.translation()).norm(), 1e-6);
  EXPECT_LT((found.X_EM.translation() - s.X_EM.translation()).norm(), 1e-6);
  EXPECT_LT(found.rms_px, 2e-4);
}

TEST(HandEyeRefinement, IsBetterThanThePosesAndSaysHowGood) {
  double by_poses = 0, by_corners = 0, predicted = 0;
  const Vec3 tip_W(0.006, 0.26, 0.098);
  for (int seed = 1; seed <= 20; ++seed) {
    const TagStation s(seed, 0.2);
    const HandEye begun = calibrateHandEye(s.poses);
    const RefinedHandEye found = refineHandEye(s.views, s.poses, s.camera);
    by_poses += (begun.X_DC * tip_W - s.X_DW * tip_W).squaredNorm();
    by_corners += (found.X_DW * tip_W - s.X_DW * tip_W).squaredNorm();
    predicted +=
        pointCovariance(found.X_DW, found.covariance.bottomRightCorner<6, 6>(), tip_W).trace();
    EXPECT_LT(found.left_out_px, found.left_out_start_px);
  }
  EXPECT_LT(by_corners, by_poses);
  EXPECT_LT(std::abs(std::log(by_corners / predicted)), 2 * std::log(1.5))
      << std::sqrt(by_corners / predicted);
}

TEST(HandEyeRefinement, AWrongPoseIsLeftOut) {
  TagStation s(3, 0.2);
  for (Eigen::Vector2d& pixel : s.views[4].pixels) pixel += Eigen::Vector2d(15, -8);
  s.poses[4].X_CM.translation() += Vec3(0.01, 0.01, 0);
  const RefinedHandEye found = refineHandEye(s.views, s.poses, s.camera);
  EXPECT_FALSE(found.fit.good[4]);
  EXPECT_LT((found.X_DW.translation() - s.X_DW.translation()).norm(), 1e-3);
}

TEST(HandEyeRefinement, HalfSeenTagsAreNotEnough) {
  TagStation s(4, 0.2);
  for (std::size_t i = 5; i < s.views.size(); ++i) {
    s.views[i].p_M.resize(8 + i % 4);
    s.views[i].pixels.resize(8 + i % 4);
  }
  EXPECT_THROW(refineHandEye(s.views, s.poses, s.camera), Error);
}

}  // namespace
}  // namespace palpa::calibration
