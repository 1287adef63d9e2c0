#include "scene/orbit_camera.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace palpa::scene {

namespace {
constexpr double kHighest = 85 * std::numbers::pi / 180;
constexpr double kHalfAngle = 15 * std::numbers::pi / 180;
constexpr double kWidestShare = 0.85;  // a narrow view keeps the region's width in sight
constexpr double kClosestOrbit = 0.1, kFarthestOrbit = 1.5;  // metres
}  // namespace

OrbitCamera::OrbitCamera(const Vec3& target_A, double azimuth, double elevation, double distance)
    : view_{target_A, azimuth, elevation, distance}, home_(view_) {}

void OrbitCamera::orbit(double d_azimuth, double d_elevation) {
  view_.azimuth += d_azimuth;
  view_.elevation = std::clamp(view_.elevation + d_elevation, -kHighest, kHighest);
}

void OrbitCamera::zoom(double factor) {
  view_.distance = std::clamp(view_.distance * factor, kClosestOrbit, kFarthestOrbit);
}

void OrbitCamera::pan(double right, double down) {
  const Mat3 R_AC = X_CA().linear().transpose();
  view_.target_A -= view_.distance * (right * R_AC.col(0) + down * R_AC.col(1));
}

void OrbitCamera::reset() { view_ = home_; }

Pose OrbitCamera::X_CA() const {
  const double ce = std::cos(view_.elevation);
  const Vec3 back(ce * std::sin(view_.azimuth), -ce * std::cos(view_.azimuth),
                  std::sin(view_.elevation));  // from the target to the eye
  const Vec3 ahead = -back;
  const Vec3 right = ahead.cross(Vec3::UnitZ()).normalized();
  Mat3 R_AC;
  R_AC << right, ahead.cross(right), ahead;
  return makePose(R_AC, view_.target_A + view_.distance * back).inverse();
}

Pinhole OrbitCamera::pinhole(int width, int height) const {
  const double side = std::min<double>(height, kWidestShare * width);
  const double f = 0.5 * side / std::tan(kHalfAngle);
  return {width, height, f, f, 0.5 * width - 0.5, 0.5 * height - 0.5};
}

}  // namespace palpa::scene
