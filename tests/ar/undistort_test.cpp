#include "ar/cameras/undistort.h"

#include <gtest/gtest.h>

#include "anatomy/base/error.h"
#include "tests/ar/views.h"

namespace palpa::ar {
namespace {

void addSpot(const Eigen::Vector2d& at, cv::Mat* picture) {
  for (int v = 0; v < picture->rows; ++v)
    for (int u = 0; u < picture->cols; ++u) {
      const double d2 = (Eigen::Vector2d(u, v) - at).squaredNorm();
      if (d2 < 400)
        picture->at<unsigned char>(v, u) += uchar(std::lround(200 * std::exp(-d2 / 32)));
    }
}

Eigen::Vector2d centroidNear(const cv::Mat& picture, const Eigen::Vector2d& near) {
  Eigen::Vector2d sum = Eigen::Vector2d::Zero();
  double weight = 0;
  for (int v = int(near.y()) - 20; v <= int(near.y()) + 20; ++v)
    for (int u = int(near.x()) - 20; u <= int(near.x()) + 20; ++u) {
      if (u < 0 || v < 0 || u >= picture.cols || v >= picture.rows) continue;
      sum += picture.at<unsigned char>(v, u) * Eigen::Vector2d(u, v);
      weight += picture.at<unsigned char>(v, u);
    }
  return sum / weight;
}

TEST(Undistort, PutsPointsWhereThePinholeSeesThem) {
  const auto camera = webcam();
  const Undistorter undistorter(camera);
  for (const Eigen::Vector2d& at : {Eigen::Vector2d(320, 240), Eigen::Vector2d(60, 70),
                                    Eigen::Vector2d(570, 400), Eigen::Vector2d(100, 420)}) {
    cv::Mat picture(480, 640, CV_8U, cv::Scalar(0));
    addSpot(at, &picture);
    const Eigen::Vector2d expected = undistorter.pinhole().project(camera.unproject(at));
    // Steps of 1/32 px in the maps, 8 bits; the lens stretches the outer side of a spot more.
    EXPECT_LT((centroidNear(undistorter.apply(picture), expected) - expected).norm(), 0.25);
  }
}

TEST(Undistort, ThePinholeSeesNoBorderAndLosesLittle) {
  for (auto camera :
       {webcam(), calibration::CameraModel{
                      1280, 720, 800, 780, 600, 380, {0.1, 0.05, 0.001, -0.002, 0}, 0}}) {
    const auto pinhole = Undistorter(camera).pinhole();
    EXPECT_EQ(pinhole.fx, pinhole.fy);
    EXPECT_EQ(pinhole.distortion, (std::array<double, 5>{}));
    double closest = 1e9;
    for (int u = 0; u < camera.width; ++u)
      for (const int v : {0, camera.height - 1}) {
        const Eigen::Vector2d p = camera.project(pinhole.unproject({double(u), double(v)}));
        EXPECT_GT(p.y(), -0.01);
        EXPECT_LT(p.y(), camera.height - 0.99);
        closest = std::min({closest, p.y(), camera.height - 1 - p.y()});
      }
    for (int v = 0; v < camera.height; ++v)
      for (const int u : {0, camera.width - 1}) {
        const Eigen::Vector2d p = camera.project(pinhole.unproject({double(u), double(v)}));
        EXPECT_GT(p.x(), -0.01);
        EXPECT_LT(p.x(), camera.width - 0.99);
        closest = std::min({closest, p.x(), camera.width - 1 - p.x()});
      }
    EXPECT_LT(closest, 1) << "the picture was cut more than it had to be";
  }
}

TEST(Undistort, ColourStaysColourAndTheSizeMustFit) {
  const Undistorter undistorter(webcam());
  EXPECT_EQ(undistorter.apply(cv::Mat(480, 640, CV_8UC3, cv::Scalar(1, 2, 3))).type(), CV_8UC3);
  EXPECT_THROW(undistorter.apply(cv::Mat(720, 1280, CV_8U)), Error);
  EXPECT_THROW(undistorter.apply(cv::Mat()), Error);
  EXPECT_THROW(Undistorter(calibration::CameraModel{}), Error);
}

}  // namespace
}  // namespace palpa::ar
