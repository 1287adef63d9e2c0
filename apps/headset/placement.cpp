#include "apps/headset/placement.h"

namespace palpa::headset {
namespace {

constexpr double
    kAhead = 0.45,
    kBelow = 0.25;  // m from the eyes: within reach of a bent arm, looked down on as at a table
constexpr double kLevel =
    0.3;  // less of the gaze than this is level: they look straight up or down

/// Between the eyes.
Vec3 headOf(const std::array<ar::EyeView, 2>& eyes) {
  return 0.5 * (eyes[0].X_LE.translation() + eyes[1].X_LE.translation());
}

}  // namespace

scene::Pinhole pinholeOf(const ar::EyeView& eye, int width, int height) {
  scene::Pinhole camera;
  camera.width = width;
  camera.height = height;
  camera.fx = width / (eye.right - eye.left);
  camera.fy = height / (eye.up - eye.down);
  camera.cx = -0.5 - camera.fx * eye.left;
  camera.cy = -0.5 + camera.fy * eye.up;
  return camera;
}

Pose placeBefore(const std::array<ar::EyeView, 2>& eyes, const Vec3& focus_W) {
  const auto level = [](Vec3 v) {
    v.z() = 0;
    return v;
  };
  Vec3 ahead = level(0.5 * (eyes[0].X_LE.linear().col(2) + eyes[1].X_LE.linear().col(2)));
  // Who looks down has the top of the head toward what is ahead, who looks up the chin.
  const Vec3 gaze = eyes[0].X_LE.linear().col(2), top = -eyes[0].X_LE.linear().col(1);
  if (ahead.norm() < kLevel) ahead = level(gaze.z() < 0 ? top : Vec3(-top));
  if (ahead.norm() < kLevel) ahead = Vec3::UnitY();
  ahead.normalize();
  Mat3 R_LW;
  R_LW << ahead.cross(Vec3::UnitZ()), ahead, Vec3::UnitZ();
  const Vec3 focus_L = headOf(eyes) + kAhead * ahead - kBelow * Vec3::UnitZ();
  return makePose(R_LW, focus_L - R_LW * focus_W);
}

}  // namespace palpa::headset
