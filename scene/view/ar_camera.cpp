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

std::array<EyeCamera, 2> stereoPair(const Pinhole& camera, const Pose& X_CA, double apart,
                                    double focus) {
  std::array<EyeCamera, 2> eyes;
  for (std::size_t i = 0; i < 2; ++i) {
    const double side = i == 0 ? 1 : -1;  // from the left eye everything lies further right
    eyes[i].camera = camera;
    eyes[i].camera.cx -= side * camera.fx * apart / (2 * focus);
    eyes[i].X_CA = makePose(Mat3::Identity(), Vec3(side * apart / 2, 0, 0)) * X_CA;
  }
  return eyes;
}

std::array<Rect, 2> eyePanels(const Rect& panel, Stereo stereo) {
  if (stereo == Stereo::side_by_side || stereo == Stereo::headset) {
    const int half = panel.width / 2;
    return {Rect{panel.x, panel.y, half, panel.height},
            Rect{panel.x + half, panel.y, panel.width - half, panel.height}};
  }
  if (stereo == Stereo::top_bottom) {
    const int half = panel.height / 2;
    return {Rect{panel.x, panel.y + panel.height - half, panel.width, half},
            Rect{panel.x, panel.y, panel.width, panel.height - half}};
  }
  return {panel, panel};
}

std::array<Rect, 2> wordPanels(const std::array<EyeCamera, 2>& eyes,
                               const std::array<Rect, 2>& panels) {
  constexpr double kAhead = 1, kUp = 0.16, kWidth = 0.56, kHeight = 0.36;  // m
  const Pose X_AE0 = eyes[0].X_CA.inverse(), X_AE1 = eyes[1].X_CA.inverse();
  const Vec3 ahead = (X_AE0.linear().col(2) + X_AE1.linear().col(2)).normalized();
  const Vec3 up = -(X_AE0.linear().col(1) + X_AE1.linear().col(1)).normalized();
  const Vec3 middle_A =
      0.5 * (X_AE0.translation() + X_AE1.translation()) + kAhead * ahead + kUp * up;
  std::array<Rect, 2> where;
  int left = 0, down = 0;  // by which both are shifted into narrow pictures
  for (std::size_t i = 0; i < 2; ++i) {
    const Pinhole camera = scaled(eyes[i].camera, panels[i].width, panels[i].height);
    const Vec3 p = eyes[i].X_CA * middle_A;
    const double u = camera.fx * p.x() / p.z() + camera.cx,
                 v = camera.fy * p.y() / p.z() + camera.cy;
    const int width =
                  std::min(static_cast<int>(camera.fx * kWidth / kAhead), panels[i].width * 9 / 10),
              height = std::min(static_cast<int>(camera.fy * kHeight / kAhead),
                                panels[i].height * 9 / 10);
    where[i] = {panels[i].x + static_cast<int>(u) - width / 2,
                panels[i].top() - static_cast<int>(v) - height / 2, width, height};
    const int over_right = where[i].right() - panels[i].right(),
              over_left = panels[i].x - where[i].x, over_top = where[i].top() - panels[i].top();
    if (over_right > 0) left = std::max(left, over_right);
    if (over_left > 0) left = std::min(left, -over_left);
    down = std::max(down, over_top);
  }
  for (Rect& rect : where) {
    rect.x -= left;
    rect.y -= down;
  }
  return where;
}

Image anaglyph(const Image& left, const Image& right) {
  Image both = right;
  for (std::size_t i = 0; i + 2 < both.pixels.size(); i += 3) {
    const int brightness =
        (299 * left.pixels[i] + 587 * left.pixels[i + 1] + 114 * left.pixels[i + 2] + 500) / 1000;
    both.pixels[i] = static_cast<std::uint8_t>(std::min(brightness, 255));
  }
  return both;
}

}  // namespace palpa::scene
