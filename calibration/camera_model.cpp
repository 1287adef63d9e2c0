#include "calibration/camera_model.h"

#include <cmath>
#include <limits>

#include "anatomy/base/error.h"

namespace palpa::calibration {
namespace {

using Vec2 = Eigen::Vector2d;
using Mat2 = Eigen::Matrix2d;

/// Distorted normalized point, and its derivative by the undistorted one when asked for.
Vec2 distort(const std::array<double, 5>& k, const Vec2& p, Mat2* derivative = nullptr) {
  const auto [k1, k2, p1, p2, k3] = k;
  const double x = p.x(), y = p.y(), r2 = p.squaredNorm();
  const double d = 1 + r2 * (k1 + r2 * (k2 + r2 * k3));
  if (derivative) {
    const double d_r2 = k1 + r2 * (2 * k2 + r2 * 3 * k3);
    const double cross = 2 * x * y * d_r2 + 2 * p1 * x + 2 * p2 * y;
    *derivative << d + 2 * x * x * d_r2 + 2 * p1 * y + 6 * p2 * x, cross,  //
        cross, d + 2 * y * y * d_r2 + 6 * p1 * y + 2 * p2 * x;
  }
  return {x * d + 2 * p1 * x * y + p2 * (r2 + 2 * x * x),
          y * d + p1 * (r2 + 2 * y * y) + 2 * p2 * x * y};
}

/// Ten steps of OpenCV's iteration p <- p + (target - distort(p)): safe, slow near the corners.
Vec2 fixedPoint(const std::array<double, 5>& k, const Vec2& target) {
  Vec2 p = target;
  for (int i = 0; i < 10; ++i) p += target - distort(k, p);
  return p.allFinite() ? p : target;
}

Vec2 newton(const std::array<double, 5>& k, const Vec2& target, Vec2 p) {
  for (int i = 0; i < 20; ++i) {
    Mat2 J;
    const Vec2 miss = target - distort(k, p, &J);
    if (miss.squaredNorm() < 1e-30) break;
    p += J.inverse() * miss;
  }
  return p;
}

/// A lens that folds the picture sees one point in two places. On the way from the centre to the
/// border the map's determinant must stay positive, and the border's rays must lead back.
bool folds(const CameraModel& camera, const Vec2& border) {
  const Vec3 ray = camera.unproject(border);
  if (!ray.allFinite() || !((camera.project(ray) - border).norm() < 1e-6)) return true;
  for (int i = 1; i <= 32; ++i) {
    Mat2 J;
    distort(camera.distortion, ray.head<2>() * (i / 32.0), &J);
    if (!(J.determinant() > 0)) return true;
  }
  return false;
}

bool foldsAnywhere(const CameraModel& camera) {
  const double w = camera.width - 1, h = camera.height - 1;
  for (int i = 0; i <= 8; ++i) {
    const double s = i / 8.0;
    for (const Vec2& border : {Vec2(s * w, 0), Vec2(s * w, h), Vec2(0, s * h), Vec2(w, s * h)})
      if (folds(camera, border)) return true;
  }
  return false;
}

void require(bool good, const std::string& what, const std::string& where) {
  if (!good) throw Error(what, where, "Calibrate the camera again, or correct the file.");
}

void requireFocal(double f, const CameraModel& camera, const std::string& field,
                  const std::string& where) {
  require(std::isfinite(f) && f >= 0.1 * camera.width && f <= 100.0 * camera.width,
          field + " must be 0.1 to 100 picture widths, in pixels", where);
}

}  // namespace

Eigen::Vector2d CameraModel::project(const Vec3& p_C) const { return project(p_C, nullptr); }

Eigen::Vector2d CameraModel::project(const Vec3& p_C,
                                     Eigen::Matrix<double, 2, 3>* d_pixel_d_p) const {
  if (!(p_C.z() > 0)) {
    const double nan = std::numeric_limits<double>::quiet_NaN();
    if (d_pixel_d_p) d_pixel_d_p->setConstant(nan);
    return {nan, nan};
  }
  const Vec2 p = p_C.head<2>() / p_C.z();
  Mat2 J;
  const Vec2 bent = distort(distortion, p, d_pixel_d_p ? &J : nullptr);
  if (d_pixel_d_p) {
    // f J d, d = (1 0 -x; 0 1 -y) / z, written out: it is asked for at every corner in every step
    const double a = fx * J(0, 0), b = fx * J(0, 1), c = fy * J(1, 0), d = fy * J(1, 1);
    *d_pixel_d_p << a, b, a * -p.x() + b * -p.y(), c, d, c * -p.x() + d * -p.y();
    *d_pixel_d_p /= p_C.z();
  }
  return {fx * bent.x() + cx, fy * bent.y() + cy};
}

Eigen::Matrix<double, 2, kLensNumbers> CameraModel::byLens(const Vec3& p_C) const {
  const Vec2 p = p_C.head<2>() / p_C.z(), ray(fx * p.x(), fy * p.y()),
             bent = distort(distortion, p);
  const double r2 = p.squaredNorm(), xy = p.x() * p.y();
  Eigen::Matrix<double, 2, kLensNumbers> J = decltype(J)::Zero();
  J(0, 0) = bent.x();
  J(1, 1) = bent.y();
  J(0, 2) = J(1, 3) = 1;
  J.col(4) = r2 * ray;
  J.col(5) = r2 * r2 * ray;
  J.col(6) << fx * 2 * xy, fy * (r2 + 2 * p.y() * p.y());
  J.col(7) << fx * (r2 + 2 * p.x() * p.x()), fy * 2 * xy;
  J.col(8) = r2 * r2 * r2 * ray;
  return J;
}

Vec3 CameraModel::unproject(const Eigen::Vector2d& pixel) const {
  const Vec2 target((pixel.x() - cx) / fx, (pixel.y() - cy) / fy);
  const Vec2 p = newton(distortion, target, fixedPoint(distortion, target));
  return {p.x(), p.y(), 1.0};
}

Vec3 CameraModel::unproject(const Eigen::Vector2d& pixel, const Vec3& beside) const {
  const Vec2 target((pixel.x() - cx) / fx, (pixel.y() - cy) / fy);
  const Vec2 p = newton(distortion, target, beside.head<2>());
  return {p.x(), p.y(), 1.0};
}

void validate(const CameraModel& camera, const std::string& where) {
  const auto sane = [](int size) { return size >= 16 && size <= 20000; };
  require(sane(camera.width), "image_width must be 16 to 20000 px", where);
  require(sane(camera.height), "image_height must be 16 to 20000 px", where);
  requireFocal(camera.fx, camera, "fx", where);
  requireFocal(camera.fy, camera, "fy", where);
  const auto near = [](double c, int size) { return c > -0.5 * size && c < 1.5 * size; };
  require(near(camera.cx, camera.width), "cx is far outside the picture", where);
  require(near(camera.cy, camera.height), "cy is far outside the picture", where);
  for (const double k : camera.distortion)
    require(std::isfinite(k), "distortion_coefficients hold a value that is not a number", where);
  require(std::isfinite(camera.rms_px) && camera.rms_px >= 0,
          "the reprojection error must be zero or positive", where);
  require(!foldsAnywhere(camera),
          "distortion_coefficients fold the picture over at its border (board views that reach "
          "into the "
          "corners prevent it)",
          where);
}

}  // namespace palpa::calibration
