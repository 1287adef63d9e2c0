#pragma once

#include <Eigen/Core>
#include <array>
#include <filesystem>
#include <string>

#include "anatomy/geometry/pose.h"

namespace palpa::calibration {

/// The numbers of a lens, in this order: fx fy cx cy k1 k2 p1 p2 k3.
inline constexpr int kLensNumbers = 9;

/// Pinhole camera with the distortion of Brown (1971) as OpenCV writes it, in the order k1 k2 p1 p2
/// k3. Frame C: +x right, +y down, +z forward, metres. Pixel centres at whole numbers.
///
///   x = X/Z, y = Y/Z, r2 = x^2 + y^2, d = 1 + k1 r2 + k2 r2^2 + k3 r2^3
///   x' = x d + 2 p1 x y + p2 (r2 + 2 x^2)        u = fx x' + cx
///   y' = y d + p1 (r2 + 2 y^2) + 2 p2 x y        v = fy y' + cy
struct CameraModel {
  int width = 0, height = 0;
  double fx = 0, fy = 0, cx = 0, cy = 0;
  std::array<double, 5> distortion{};
  double rms_px = 0;  ///< of the calibration, 0 when unknown

  /// Not a number for a point that is not in front of the camera (Z <= 0).
  Eigen::Vector2d project(const Vec3& p_C) const;
  /// The same with the derivative of the pixel by the point, pixels a metre.
  Eigen::Vector2d project(const Vec3& p_C, Eigen::Matrix<double, 2, 3>* d_pixel_d_p) const;
  /// Derivative of the pixel by the lens's numbers, for a point in front of the camera.
  Eigen::Matrix<double, 2, kLensNumbers> byLens(const Vec3& p_C) const;
  /// Unit-depth point on the ray through a pixel: inverse of `project` by fixed-point iteration,
  /// finished by Newton's method; its projection meets the pixel to 1e-10 px inside the picture.
  Vec3 unproject(const Eigen::Vector2d& pixel) const;
  /// The same ray, found from that through a pixel beside it by Newton's method alone: for every
  /// pixel of a picture, at a fraction of the cost.
  Vec3 unproject(const Eigen::Vector2d& pixel, const Vec3& beside) const;
};

/// Throws Error unless the numbers are those of a real camera: sizes 16 to 20000 px, finite focal
/// lengths of 0.1 to 100 picture widths, a centre inside or near the picture, and a distortion that
/// does not fold the picture over. `where` names the origin, usually the file.
void validate(const CameraModel& model, const std::string& where);

/// OpenCV's YAML or XML (camera_matrix, distortion_coefficients, image_width, image_height,
/// avg_reprojection_error if there) or our JSON. 4 or 5 coefficients; longer vectors only when all
/// beyond k3 are zero: rational, thin-prism, tilted and fisheye models are not supported. Throws
/// Error with file and field.
CameraModel readCameraModel(const std::filesystem::path& file);

/// Our JSON, written beside the file and renamed: never a half-written file. Throws Error.
void writeCameraModel(const CameraModel& model, const std::filesystem::path& file);

}  // namespace palpa::calibration
