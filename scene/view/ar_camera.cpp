#include "scene/view/ar_camera.h"

#include <vtkCamera.h>
#include <vtkMatrix4x4.h>
#include <vtkNew.h>

#include <algorithm>

namespace palpa::scene {

Mat4 projectionMatrix(const Pinhole& camera, const DepthRange& range) {
  const double n = range.near, f = range.far;
  Mat4 P = Mat4::Zero();
  P(0, 0) = 2 * camera.fx / camera.width;
  P(0, 2) = 1 - 2 * (camera.cx + 0.5) / camera.width;
  P(1, 1) = 2 * camera.fy / camera.height;
  P(1, 2) = 2 * (camera.cy + 0.5) / camera.height - 1;
  P(2, 2) = -(f + n) / (f - n);
  P(2, 3) = -2 * f * n / (f - n);
  P(3, 2) = -1;
  return P;
}

DepthRange depthRangeOf(std::initializer_list<Ball> balls) {
  constexpr double kNearest = 0.01;  // metres; closer than any lens focuses
  double nearest = 1e9, farthest = 10 * kNearest;
  for (const Ball& ball : balls) {
    nearest = std::min(nearest, ball.centre_C.z() - ball.radius);
    farthest = std::max(farthest, ball.centre_C.z() + ball.radius);
  }
  return {std::max({kNearest, nearest, farthest / 1000}), farthest};
}

void aim(vtkCamera& target, const Pinhole& camera, const Pose& X_CA, const DepthRange& range) {
  const Pose X_AC = X_CA.inverse();
  const Vec3 eye = X_AC.translation();
  const Vec3 ahead = eye + X_AC.linear().col(2);
  const Vec3 up = -X_AC.linear().col(1);
  target.SetPosition(eye.data());
  target.SetFocalPoint(ahead.data());
  target.SetViewUp(up.data());
  target.SetClippingRange(range.near, range.far);
  vtkNew<vtkMatrix4x4> P;
  const Mat4 values = projectionMatrix(camera, range);
  for (int row = 0; row < 4; ++row)
    for (int column = 0; column < 4; ++column) P->SetElement(row, column, values(row, column));
  target.SetExplicitProjectionTransformMatrix(P);
  target.UseExplicitProjectionTransformMatrixOn();
}

Pinhole partOf(const Pinhole& camera, const Rect& part) {
  return {part.width, part.height, camera.fx, camera.fy, camera.cx - part.x, camera.cy - part.y};
}

Pinhole scaled(const Pinhole& camera, int width, int height) {
  const double sx = static_cast<double>(width) / camera.width;
  const double sy = static_cast<double>(height) / camera.height;
  return {width,
          height,
          sx * camera.fx,
          sy * camera.fy,
          sx * (camera.cx + 0.5) - 0.5,
          sy * (camera.cy + 0.5) - 0.5};
}

}  // namespace palpa::scene
