#pragma once

#include <cmath>
#include <numbers>
#include <opencv2/calib3d.hpp>
#include <random>
#include <string>
#include <vector>

#include "calibration/camera_calibration.h"
#include "calibration/camera_model.h"
#include "calibration/rotation.h"

namespace palpa::calibration::test {

inline CameraModel webcam() {
  return {640, 480, 540, 538, 331, 236, {-0.28, 0.09, 0.001, -0.0005, -0.01}, 0};
}

/// 9 by 6 inner corners, `square` metres apart.
inline std::vector<Vec3> chessboardCorners(double square = 0.025) {
  std::vector<Vec3> corners;
  for (int row = 0; row < 6; ++row)
    for (int column = 0; column < 9; ++column) corners.push_back(square * Vec3(column, row, 0));
  return corners;
}

struct ViewSetting {
  double noise = 0;        ///< px, each coordinate
  double tilt = 0.3;       ///< rad, about; 0: all from the front
  double distance = 0.36;  ///< m, about
  double wander = 0.25;    ///< how far the board leaves the middle, of the distance
  int count = 12;
  unsigned seed = 1;
};

/// What `webcam` sees of a board that is held here and there, tilted to every side.
inline std::vector<BoardView> boardViews(const ViewSetting& setting) {
  std::mt19937 bits(setting.seed);
  std::normal_distribution<double> normal;
  std::vector<BoardView> all;
  for (int i = 0; i < setting.count; ++i) {
    const double around = 2.4 * i, tilt = setting.tilt * (1 + 0.7 * std::sin(1.0 * i));
    const Mat3 R = rotationOf(tilt * Vec3(std::cos(around), std::sin(around), 0)) *
                   rotationOf(0.2 * std::sin(2.0 * i) * Vec3::UnitZ());
    const double far = setting.distance + 0.08 * std::sin(0.8 * i), aside = setting.wander * far;
    const Pose X_CW =
        makePose(R, Vec3(aside * std::sin(1.7 * i), 0.8 * aside * std::cos(2.9 * i), far) -
                        R * Vec3(0.1, 0.0625, 0));
    BoardView view{"view " + std::to_string(i + 1), chessboardCorners(), {}};
    for (const Vec3& p : view.p_W) {
      const double du = normal(bits), dv = normal(bits);
      view.pixels.push_back(webcam().project(X_CW * p) + setting.noise * Eigen::Vector2d(du, dv));
    }
    all.push_back(view);
  }
  return all;
}

/// Moves that share of the corners by 10 to 30 px anywhere.
inline void spoilCorners(std::vector<BoardView>* views, double share, unsigned seed) {
  std::mt19937 bits(seed);
  std::uniform_real_distribution<double> uniform;
  for (BoardView& view : *views)
    for (auto& p : view.pixels) {
      if (uniform(bits) >= share) continue;
      const double way = 2 * std::numbers::pi * uniform(bits), far = 10 + 20 * uniform(bits);
      p += far * Eigen::Vector2d(std::cos(way), std::sin(way));
    }
}

/// A picture taken while the board moved: its corners up to 4 px off, each otherwise.
inline void spoilView(BoardView* view) {
  for (auto& p : view->pixels) p += Eigen::Vector2d(3 * std::sin(p.x()), 4 * std::cos(p.y()));
}

/// cv::calibrateCamera of the same corners, with the same five coefficients; its rms as it reports
/// it.
inline CameraModel calibratedByOpenCv(const std::vector<BoardView>& views, int width, int height) {
  std::vector<std::vector<cv::Point3f>> boards;
  std::vector<std::vector<cv::Point2f>> pictures;
  for (const BoardView& view : views) {
    boards.emplace_back();
    pictures.emplace_back();
    for (const Vec3& p : view.p_W)
      boards.back().emplace_back(static_cast<float>(p.x()), static_cast<float>(p.y()), 0.f);
    for (const auto& p : view.pixels)
      pictures.back().emplace_back(static_cast<float>(p.x()), static_cast<float>(p.y()));
  }
  cv::Mat K, k;
  std::vector<cv::Mat> turns, shifts;
  const double rms = cv::calibrateCamera(boards, pictures, {width, height}, K, k, turns, shifts);
  CameraModel model{
      width, height, K.at<double>(0, 0), K.at<double>(1, 1), K.at<double>(0, 2), K.at<double>(1, 2),
      {},    rms};
  for (int i = 0; i < 5; ++i) model.distortion[static_cast<std::size_t>(i)] = k.at<double>(i);
  return model;
}

}  // namespace palpa::calibration::test
