#include "ar/boards/gray_picture.h"

#include <algorithm>
#include <utility>

#include <opencv2/imgproc.hpp>

#include "anatomy/base/error.h"

namespace palpa::ar {

cv::Mat grayPicture(const cv::Mat& image) {
  if (image.dims == 2 && !image.empty()) {
    if (image.type() == CV_8UC1) return image;
    cv::Mat gray;
    if (image.type() == CV_8UC3) {
      cv::cvtColor(image, gray, cv::COLOR_BGR2GRAY);
      return gray;
    }
  }
  throw Error("the picture is empty or not 8-bit gray or BGR", "board detection",
              "Convert the picture to 8 bits a channel, one or three channels.");
}

namespace {

constexpr double kMinContrast = 15;  // gray levels
constexpr double kEvenness = 0.5;    // a point beside the crossing sees its quarters unevenly
constexpr double kWindowShare = 0.9;

double brightnessAt(const cv::Mat& gray, const Eigen::Vector2d& p) {
  cv::Mat patch;
  cv::getRectSubPix(gray, {1, 1}, cv::Point2f(cv::Point2d(p.x(), p.y())), patch);
  return patch.at<uchar>(0, 0);
}

Eigen::Vector2d toPicture(const cv::Matx33d& H, const Eigen::Vector2d& p) {
  const cv::Vec3d q = H * cv::Vec3d(p.x(), p.y(), 1);
  return {q[0] / q[2], q[1] / q[2]};
}

}  // namespace

bool isCrossing(const cv::Mat& gray, const Eigen::Vector2d& pixel, const Eigen::Vector2d& x,
                const Eigen::Vector2d& y) {
  const auto opposite = [&](const Eigen::Vector2d& d) {
    return std::pair(brightnessAt(gray, pixel - d), brightnessAt(gray, pixel + d));
  };
  const auto black = opposite(x + y), white = opposite(x - y);
  const double least = std::min(white.first, white.second) - std::max(black.first, black.second);
  const double most = std::max(white.first, white.second) - std::min(black.first, black.second);
  return least > kMinContrast && least > kEvenness * most;
}

Eigen::Vector2d stepInPicture(const cv::Matx33d& H, const Eigen::Vector2d& p,
                              const Eigen::Vector2d& step) {
  return toPicture(H, p + step) - toPicture(H, p);
}

bool refineSaddle(const cv::Mat& gray, double room, Eigen::Vector2d* pixel) {
  const cv::TermCriteria enough(cv::TermCriteria::COUNT + cv::TermCriteria::EPS, 50, 1e-3);
  const int half = std::clamp(int(kWindowShare * room), 2, 15);
  const cv::Point2f start(cv::Point2d(pixel->x(), pixel->y()));
  if (!cv::Rect2f(0, 0, float(gray.cols - 1), float(gray.rows - 1)).contains(start)) return false;
  std::vector<cv::Point2f> point{start};
  cv::cornerSubPix(gray, point, {half, half}, {-1, -1}, enough);
  if (point[0] == start) return false;  // OpenCV's way to say that it ran off
  *pixel = {point[0].x, point[0].y};
  return true;
}

double outlineHeight(const std::vector<cv::Point2f>& corners) {
  double longest = 0;
  for (std::size_t i = 0; i < 4; ++i)
    longest = std::max(longest, cv::norm(corners[i] - corners[(i + 1) % 4]));
  return cv::contourArea(corners) / longest;
}

}  // namespace palpa::ar
