#pragma once

#include <cmath>
#include <numbers>
#include <opencv2/imgproc.hpp>
#include <random>

#include "ar/boards/board.h"
#include "ar/tracking/board_pose.h"
#include "ar/tracking/pose_filter.h"
#include "tests/support/camera_views.h"

/// Known truth for the tests of ar/: a camera, where it stands, and what it then sees.
namespace palpa::ar {

using test::rad;
using test::webcam;

/// The same without distortion: what `photograph` is seen with.
inline calibration::CameraModel pinhole() {
  auto camera = webcam();
  camera.distortion = {};
  return camera;
}

/// The board as seen from `distance`, `tilt` away from straight above, after walking round it by
/// `azimuth` and turning the camera by `roll`; the middle of the board in the middle of the
/// picture.
inline Pose viewOf(double distance, double tilt, double azimuth, double roll = 0) {
  return test::lookAt(Vec3::Zero(), distance, tilt, azimuth, roll);
}

/// [0, 1), the same in every standard library.
inline double share(std::mt19937* random) { return double((*random)()) / 4294967296.0; }

/// Standard normal, by Box and Muller.
inline double normal(std::mt19937* random) {
  const double u = 1 - share(random), v = share(random);
  return std::sqrt(-2 * std::log(u)) * std::cos(2 * std::numbers::pi * v);
}

inline Pose randomView(std::mt19937* random) {
  return viewOf(0.35 + 0.4 * share(random), rad(60 * share(random)), rad(360 * share(random)),
                rad(360 * share(random)));
}

/// Every corner of the default grid, where the camera sees it.
inline std::vector<BoardPoint> gridPoints(const Pose& X_CW, const calibration::CameraModel& camera,
                                          double noise_px = 0, std::mt19937* random = nullptr) {
  std::vector<BoardPoint> points;
  for (int id = 0; id < 24; ++id)
    for (const Vec3& p_W : tagCorners({}, id)) {
      Eigen::Vector2d pixel = camera.project(X_CW * p_W);
      if (random) pixel += noise_px * Eigen::Vector2d(normal(random), normal(random));
      points.push_back({p_W, pixel});
    }
  return points;
}

/// A flat picture lying on the board, as a pinhole without distortion sees it, four samples a pixel
/// each way. `px_per_m`: of the flat picture, whose middle is W's origin.
inline cv::Mat photograph(const cv::Mat& flat, double px_per_m, const Pose& X_CW,
                          const calibration::CameraModel& camera) {
  constexpr int kOver = 4;
  Mat3 K, from_flat;
  K << kOver * camera.fx, 0, kOver * (camera.cx + 0.5) - 0.5,  //
      0, kOver * camera.fy, kOver * (camera.cy + 0.5) - 0.5,   //
      0, 0, 1;
  from_flat << 1 / px_per_m, 0, -(flat.cols - 1) / 2.0 / px_per_m,  //
      0, -1 / px_per_m, (flat.rows - 1) / 2.0 / px_per_m,           //
      0, 0, 1;
  Mat3 plane;
  plane << X_CW.linear().col(0), X_CW.linear().col(1), X_CW.translation();
  const Mat3 H = K * plane * from_flat;
  cv::Matx33d h;
  for (int i = 0; i < 9; ++i) h.val[i] = H(i / 3, i % 3);
  cv::Mat fine, picture;
  cv::warpPerspective(flat, fine, h, cv::Size(camera.width, camera.height) * kOver,
                      cv::INTER_LINEAR, cv::BORDER_CONSTANT, cv::Scalar(120));
  cv::resize(fine, picture, {camera.width, camera.height}, 0, 0, cv::INTER_AREA);
  return picture;
}

}  // namespace palpa::ar
