#pragma once

#include <algorithm>

#include "tests/ar/views.h"

/// Pictures as a real webcam takes them, with the truth of every point, for boards of all kinds.
namespace palpa::ar {

/// Where a ray through each sample of a picture goes at unit depth, three samples a pixel each way:
/// the webcam's distortion included. Made once.
inline const cv::Mat& webcamRays() {
  static const cv::Mat rays = [] {
    constexpr int kOver = 3;
    const auto camera = webcam();
    cv::Mat made(camera.height * kOver, camera.width * kOver, CV_64FC2);
    for (int v = 0; v < made.rows; ++v)
      for (int u = 0; u < made.cols; ++u) {
        const Vec3 ray = camera.unproject({(u + 0.5) / kOver - 0.5, (v + 0.5) / kOver - 0.5});
        made.at<cv::Vec2d>(v, u) = {ray.x(), ray.y()};
      }
    return made;
  }();
  return rays;
}

struct Flaws {
  double blur_px = 0.7, noise = 2;  ///< standard deviations, pixels and gray levels
};

/// What `webcam()` sees of a flat picture on the board (as photograph does without distortion),
/// blurred and with noise.
inline cv::Mat snapshot(const cv::Mat& flat, double px_per_m, const Pose& X_CW,
                        const Flaws& flaws = {}) {
  const cv::Mat& rays = webcamRays();
  Mat3 plane;  // from W's plane to rays
  plane << X_CW.linear().col(0), X_CW.linear().col(1), X_CW.translation();
  const Mat3 back = plane.inverse();
  cv::Mat at(rays.size(), CV_32FC2), fine, picture;
  for (int v = 0; v < at.rows; ++v)
    for (int u = 0; u < at.cols; ++u) {
      const cv::Vec2d& ray = rays.at<cv::Vec2d>(v, u);
      const Vec3 p = back * Vec3(ray[0], ray[1], 1);
      at.at<cv::Vec2f>(v, u) = {float((flat.cols - 1) / 2.0 + p.x() / p.z() * px_per_m),
                                float((flat.rows - 1) / 2.0 - p.y() / p.z() * px_per_m)};
    }
  cv::remap(flat, fine, at, cv::noArray(), cv::INTER_LINEAR, cv::BORDER_CONSTANT, cv::Scalar(120));
  cv::resize(fine, picture, {webcam().width, webcam().height}, 0, 0, cv::INTER_AREA);
  if (flaws.blur_px > 0) cv::GaussianBlur(picture, picture, {0, 0}, flaws.blur_px);
  std::mt19937 random(5);
  for (uchar* p = picture.data; p != picture.data + picture.total(); ++p)
    *p = cv::saturate_cast<uchar>(*p + flaws.noise * normal(&random));
  return picture;
}

/// Distances of points from where the webcam must see them, pixels, in rising order.
inline std::vector<double> errors(const std::vector<BoardPoint>& points, const Pose& X_CW) {
  std::vector<double> all;
  for (const BoardPoint& point : points)
    all.push_back((webcam().project(X_CW * point.p_W) - point.pixel).norm());
  std::sort(all.begin(), all.end());
  return all;
}

struct Accuracy {
  std::size_t points = 0;
  double median_px = 1e9, worst_px = 1e9;
};

/// Over eight views from 0 to 49 degrees of tilt, all round and with the camera turned.
inline Accuracy accuracy(const Board& board, const cv::Mat& flat, double px_per_m, double distance,
                         const Flaws& flaws = {}) {
  std::vector<double> all;
  for (int i = 0; i < 8; ++i) {
    const Pose X_CW = viewOf(distance, rad(7 * i), rad(45 * i), rad(50 * i));
    const auto some = errors(board.detect(snapshot(flat, px_per_m, X_CW, flaws)), X_CW);
    all.insert(all.end(), some.begin(), some.end());
  }
  std::sort(all.begin(), all.end());
  if (all.empty()) return {};
  return {all.size(), all[all.size() / 2], all.back()};
}

}  // namespace palpa::ar
