#include "ar/cameras/undistort.h"

#include <algorithm>
#include <limits>
#include <opencv2/imgproc.hpp>

#include "anatomy/base/error.h"

namespace palpa::ar {
namespace {

using calibration::CameraModel;

/// The largest upright rectangle, at unit depth, inside the four bent borders of the picture.
struct Inside {
  double left, right, top, bottom;
};

Inside insideOf(const CameraModel& camera) {
  constexpr double far = std::numeric_limits<double>::infinity();
  Inside r{-far, far, -far, far};
  const double w = camera.width - 1, h = camera.height - 1;
  for (int i = 0; i <= 64; ++i) {
    const double u = w * i / 64, v = h * i / 64;
    r.left = std::max(r.left, camera.unproject({0, v}).x());
    r.right = std::min(r.right, camera.unproject({w, v}).x());
    r.top = std::max(r.top, camera.unproject({u, 0}).y());
    r.bottom = std::min(r.bottom, camera.unproject({u, h}).y());
  }
  return r;
}

/// One focal length so that the picture shows nothing beyond `r`; the rectangle's middle in its
/// middle.
CameraModel pinholeFor(const CameraModel& camera) {
  const Inside r = insideOf(camera);
  const double w = camera.width - 1, h = camera.height - 1;
  CameraModel pinhole;
  pinhole.width = camera.width;
  pinhole.height = camera.height;
  pinhole.fx = pinhole.fy = std::max(w / (r.right - r.left), h / (r.bottom - r.top));
  pinhole.cx = w / 2 - pinhole.fx * (r.left + r.right) / 2;
  pinhole.cy = h / 2 - pinhole.fy * (r.top + r.bottom) / 2;
  pinhole.rms_px = camera.rms_px;
  return pinhole;
}

/// Where each pixel of the pinhole lies in the camera's picture.
cv::Mat sourceOf(const CameraModel& pinhole, const CameraModel& camera) {
  cv::Mat map(pinhole.height, pinhole.width, CV_32FC2);
  for (int v = 0; v < map.rows; ++v)
    for (int u = 0; u < map.cols; ++u) {
      const Vec3 ray((u - pinhole.cx) / pinhole.fx, (v - pinhole.cy) / pinhole.fy, 1);
      const Eigen::Vector2d from = camera.project(ray);
      map.at<cv::Vec2f>(v, u) = {float(from.x()), float(from.y())};
    }
  return map;
}

}  // namespace

Undistorter::Undistorter(const CameraModel& camera) : pinhole_(pinholeFor(camera)) {
  calibration::validate(camera, "undistortion");
  cv::convertMaps(sourceOf(pinhole_, camera), cv::noArray(), coarse_, fine_, CV_16SC2);
}

cv::Mat Undistorter::apply(const cv::Mat& image) const {
  if (image.cols != pinhole_.width || image.rows != pinhole_.height)
    throw Error("the picture is " + std::to_string(image.cols) + "x" + std::to_string(image.rows) +
                    ", the camera was calibrated at " + std::to_string(pinhole_.width) + "x" +
                    std::to_string(pinhole_.height),
                "undistortion", "Use pictures of the calibrated size.");
  cv::Mat straight;
  cv::remap(image, straight, coarse_, fine_, cv::INTER_LINEAR, cv::BORDER_REPLICATE);
  return straight;
}

}  // namespace palpa::ar
