#include "calibration/camera_model.h"

#include <gtest/gtest.h>

#include <cmath>
#include <opencv2/calib3d.hpp>
#include <random>

#include "anatomy/base/error.h"
#include "tests/calibration/sample_cameras.h"

namespace palpa::calibration {
namespace {

using Vec2 = Eigen::Vector2d;

Vec2 opencvPixel(const CameraModel& camera, const Vec3& p) {
  const cv::Matx33d K(camera.fx, 0, camera.cx, 0, camera.fy, camera.cy, 0, 0, 1);
  const std::vector<cv::Point3d> points{{p.x(), p.y(), p.z()}};
  std::vector<cv::Point2d> pixels;
  cv::projectPoints(points, cv::Vec3d(0, 0, 0), cv::Vec3d(0, 0, 0), K,
                    cv::Mat(1, 5, CV_64F, const_cast<double*>(camera.distortion.data())), pixels);
  return {pixels[0].x, pixels[0].y};
}

/// A point in front of the camera that falls into its picture.
Vec3 pointInView(const CameraModel& camera, std::mt19937* random) {
  const auto share = [&] { return double((*random)()) / 4294967295.0; };
  const Vec2 pixel(share() * camera.width, share() * camera.height);
  return camera.unproject(pixel) * (0.2 + 3 * share());
}

class EveryCamera : public testing::TestWithParam<CameraModel> {};
INSTANTIATE_TEST_SUITE_P(Lenses, EveryCamera, testing::ValuesIn(sampleCameras()));

TEST_P(EveryCamera, ProjectsAsOpenCvDoes) {
  std::mt19937 random(1);
  for (int i = 0; i < 200; ++i) {
    const Vec3 p = pointInView(GetParam(), &random);
    // The same polynomial in another order of operations: some 20 roundings of 1e3 px.
    EXPECT_LT((GetParam().project(p) - opencvPixel(GetParam(), p)).norm(), 1e-10);
  }
}

TEST_P(EveryCamera, DerivativeAgreesWithFiniteDifferences) {
  std::mt19937 random(2);
  for (int i = 0; i < 50; ++i) {
    const Vec3 p = pointInView(GetParam(), &random);
    Eigen::Matrix<double, 2, 3> J;
    GetParam().project(p, &J);
    for (int axis = 0; axis < 3; ++axis) {
      const Vec3 h = 1e-6 * Vec3::Unit(axis);
      const Vec2 slope = (GetParam().project(p + h) - GetParam().project(p - h)) / 2e-6;
      // Central difference: rounding 1e-13 px / 1e-6 m, curvature below it.
      EXPECT_LT((slope - J.col(axis)).norm(), 1e-6 * J.norm());
    }
  }
}

TEST_P(EveryCamera, UnprojectInvertsProjectAllOverThePicture) {
  const CameraModel& camera = GetParam();
  for (int v = 0; v <= camera.height; v += 20)
    for (int u = 0; u <= camera.width; u += 20) {
      const Vec3 ray = camera.unproject({double(u), double(v)});
      EXPECT_EQ(ray.z(), 1.0);
      EXPECT_LT((camera.project(ray) - Vec2(u, v)).norm(), 1e-10) << u << ' ' << v;
    }
}

TEST_P(EveryCamera, ARayIsTheSameFoundFromThatBesideIt) {
  const CameraModel& camera = GetParam();
  for (int v = 0; v < camera.height; v += 40) {
    Vec3 ray = camera.unproject({0, double(v)});
    for (int u = 1; u < camera.width; ++u) {
      ray = camera.unproject({double(u), double(v)}, ray);
      EXPECT_LT((camera.project(ray) - Vec2(u, v)).norm(), 1e-10) << u << ' ' << v;
    }
    EXPECT_LT((ray - camera.unproject({camera.width - 1.0, double(v)})).norm(), 1e-13) << v;
  }
}

TEST_P(EveryCamera, IsAccepted) { EXPECT_NO_THROW(validate(GetParam(), "test")); }

TEST(CameraModel, DistanceDoesNotMatter) {
  const CameraModel camera = sampleCameras()[1];
  const Vec3 p(0.1, -0.07, 0.4);
  EXPECT_LT((camera.project(p) - camera.project(7 * p)).norm(), 1e-10);
}

TEST(CameraModel, NothingIsSeenBehindTheCamera) {
  const CameraModel camera = sampleCameras()[0];
  for (const double z : {0.0, -0.5}) EXPECT_TRUE(camera.project({0.1, 0.1, z}).hasNaN());
}

TEST(CameraModel, RefusesADistortionThatFoldsThePicture) {
  CameraModel camera = sampleCameras()[0];
  camera.distortion = {-1.5, 0, 0, 0,
                       0};  // r(1 - 1.5 r^2) peaks at r = 0.47; the corner is at 0.67
  EXPECT_THROW(validate(camera, "test"), Error);
}

}  // namespace
}  // namespace palpa::calibration
