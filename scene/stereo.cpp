#include "scene/stereo.h"

#include <algorithm>

namespace palpa::scene {

std::array<EyeCamera, 2> stereoPair(const Pinhole& camera, const Pose& X_CA, double apart, double focus) {
  std::array<EyeCamera, 2> eyes;
  for (std::size_t i = 0; i < 2; ++i) {
    const double side = i == 0 ? 1 : -1;   // from the left eye everything lies further right
    eyes[i].camera = camera;
    eyes[i].camera.cx -= side * camera.fx * apart / (2 * focus);
    eyes[i].X_CA = makePose(Mat3::Identity(), Vec3(side * apart / 2, 0, 0)) * X_CA;
  }
  return eyes;
}

std::array<Rect, 2> eyePanels(const Rect& panel, Stereo stereo) {
  if (stereo == Stereo::side_by_side) {
    const int half = panel.width / 2;
    return {Rect{panel.x, panel.y, half, panel.height}, Rect{panel.x + half, panel.y, panel.width - half, panel.height}};
  }
  if (stereo == Stereo::top_bottom) {
    const int half = panel.height / 2;
    return {Rect{panel.x, panel.y + panel.height - half, panel.width, half}, Rect{panel.x, panel.y, panel.width, panel.height - half}};
  }
  return {panel, panel};
}

Image anaglyph(const Image& left, const Image& right) {
  Image both = right;
  for (std::size_t i = 0; i + 2 < both.pixels.size(); i += 3) {
    const int brightness = (299 * left.pixels[i] + 587 * left.pixels[i + 1] + 114 * left.pixels[i + 2] + 500) / 1000;
    both.pixels[i] = static_cast<std::uint8_t>(std::min(brightness, 255));
  }
  return both;
}

}  // namespace palpa::scene
