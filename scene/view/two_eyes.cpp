#include "scene/view/two_eyes.h"

#include <vtkCamera.h>
#include <vtkProp.h>
#include <vtkPropCollection.h>
#include <vtkRenderWindow.h>
#include <vtkRenderer.h>

#include <algorithm>
#include <vector>

#include "scene/palette.h"
#include "scene/renderer_setup.h"
#include "scene/view/ar_camera.h"

namespace palpa::scene {

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

std::array<Rect, 2> halvesOf(const Rect& panel) {
  const int half = panel.width / 2;
  return {Rect{panel.x, panel.y, half, panel.height},
          Rect{panel.x + half, panel.y, panel.width - half, panel.height}};
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

bool isMerged(Stereo stereo) { return stereo != Stereo::none && stereo != Stereo::headset; }

namespace {

Image anaglyph(const Image& left, const Image& right) {
  Image both = right;
  for (std::size_t i = 0; i + 2 < both.pixels.size(); i += 3) {
    const int brightness =
        (299 * left.pixels[i] + 587 * left.pixels[i + 1] + 114 * left.pixels[i + 2] + 500) / 1000;
    both.pixels[i] = static_cast<std::uint8_t>(std::min(brightness, 255));
  }
  return both;
}

/// Two of its pixels are one of a half's, side by side or one above the other. An odd line at the
/// end is seen by neither eye.
Image inHalves(const Image& left, const Image& right, bool beside) {
  Image both{left.width, left.height, 3, std::vector<std::uint8_t>(left.pixels.size(), 0)};
  const int width = beside ? left.width / 2 : left.width,
            height = beside ? left.height : left.height / 2;
  const auto byte = [&](int u, int v) {
    return 3 * (static_cast<std::size_t>(v) * static_cast<std::size_t>(left.width) +
                static_cast<std::size_t>(u));
  };
  for (const bool of_right : {false, true}) {
    const Image& eye = of_right ? right : left;
    const int across = of_right && beside ? width : 0, down = of_right && !beside ? height : 0;
    for (int v = 0; v < height; ++v)
      for (int u = 0; u < width; ++u) {
        const std::size_t first = beside ? byte(2 * u, v) : byte(u, 2 * v),
                          second = beside ? byte(2 * u + 1, v) : byte(u, 2 * v + 1),
                          to = byte(u + across, v + down);
        for (std::size_t k = 0; k < 3; ++k)
          both.pixels[to + k] =
              static_cast<std::uint8_t>((eye.pixels[first + k] + eye.pixels[second + k] + 1) / 2);
      }
  }
  return both;
}

}  // namespace

Image merged(const Image& left, const Image& right, Stereo stereo) {
  if (stereo == Stereo::anaglyph) return anaglyph(left, right);
  return inHalves(left, right, stereo == Stereo::side_by_side);
}

Eigen::Vector2d inEyesPicture(const Eigen::Vector2d& px, int width, int height, Stereo stereo) {
  const auto unfolded = [](double at, int length) {
    const int half = length / 2;
    return 2 * (at >= half ? at - half : at);
  };
  if (stereo == Stereo::side_by_side) return {unfolded(px.x(), width), px.y()};
  if (stereo == Stereo::top_bottom) return {px.x(), unfolded(px.y(), height)};
  return px;
}

namespace {

bool same(vtkPropCollection& a, vtkPropCollection& b) {
  if (a.GetNumberOfItems() != b.GetNumberOfItems()) return false;
  for (int i = 0; i < a.GetNumberOfItems(); ++i)
    if (a.GetItemAsObject(i) != b.GetItemAsObject(i)) return false;
  return true;
}

void copyProps(vtkRenderer& from, vtkRenderer& to) {
  if (same(*from.GetViewProps(), *to.GetViewProps())) return;
  to.RemoveAllViewProps();
  for (int i = 0; i < from.GetViewProps()->GetNumberOfItems(); ++i)
    to.AddViewProp(static_cast<vtkProp*>(from.GetViewProps()->GetItemAsObject(i)));
}

}  // namespace

SecondEye::SecondEye(vtkRenderWindow& window, vtkRenderer& behind, vtkRenderer& glass,
                     vtkRenderer& on_skin, vtkRenderer& above)
    : window_(window),
      first_behind_(behind),
      first_glass_(glass),
      first_on_skin_(on_skin),
      first_above_(above) {
  forAll([&](vtkRenderer& renderer) {
    setUpRenderer(renderer, colour::kBehindBottom);
    renderer.SetActiveCamera(behind_->GetActiveCamera());
    window_.AddRenderer(&renderer);
  });
  behind_->SetBackground2(first_behind_.GetBackground2());
  glass_->EraseOff();
  on_skin_->EraseOff();
  above_->SetLayer(first_above_.GetLayer());
}

SecondEye::~SecondEye() {
  forAll([&](vtkRenderer& renderer) { window_.RemoveRenderer(&renderer); });
}

void SecondEye::mirror() {
  copyProps(first_behind_, *behind_);
  copyProps(first_glass_, *glass_);
  copyProps(first_on_skin_, *on_skin_);
  copyProps(first_above_, *above_);
  behind_->SetBackground(first_behind_.GetBackground());
  behind_->SetGradientBackground(first_behind_.GetGradientBackground());
  on_skin_->SetDraw(first_on_skin_.GetDraw());
  above_->SetDraw(first_above_.GetDraw());
}

}  // namespace palpa::scene
