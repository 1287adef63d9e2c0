#pragma once

#include <algorithm>
#include <cmath>

#include "anatomy/base/error.h"
#include "scene/palette.h"
#include "scene/view/scene_view.h"
#include "tests/support/simple_patient.h"

/// What the tests of this folder share: one context for the program, and ways to look at frames.
namespace palpa::scene {

inline GlContextProvider& offscreen() {
  static const auto context = makeGlContext(Display::offscreen, 640, 480, "test");
  return *context;
}

struct Pixel {
  int r = 0, g = 0, b = 0;
};

inline Pixel at(const Image& image, int u, int v) {
  const auto* p = &image.pixels[(static_cast<std::size_t>(v) * image.width + u) * image.channels];
  return {p[0], p[1], p[2]};
}

inline int difference(const Pixel& a, const Pixel& b) {
  return std::max({std::abs(a.r - b.r), std::abs(a.g - b.g), std::abs(a.b - b.b)});
}

/// Relative luminance of sRGB (WCAG 2.1).
inline double luminance(const Rgb& c) {
  const auto linear = [](double level) {
    return level <= 0.03928 ? level / 12.92 : std::pow((level + 0.055) / 1.055, 2.4);
  };
  return 0.2126 * linear(c[0]) + 0.7152 * linear(c[1]) + 0.0722 * linear(c[2]);
}

inline double luminance(const Pixel& p) {
  return luminance(Rgb{p.r / 255.0, p.g / 255.0, p.b / 255.0});
}

/// Number, centroid and bounds of the pixels for which `chosen(u, v)` holds.
struct Blob {
  int count = 0;
  double u = 0, v = 0;
  int left = 1 << 20, right = -1, top = 1 << 20, bottom = -1;
};

template <class Chosen>
Blob blobOf(const Image& image, Chosen chosen) {
  Blob blob;
  for (int v = 0; v < image.height; ++v) {
    for (int u = 0; u < image.width; ++u) {
      if (!chosen(u, v)) continue;
      ++blob.count;
      blob.u += u;
      blob.v += v;
      blob.left = std::min(blob.left, u);
      blob.right = std::max(blob.right, u);
      blob.top = std::min(blob.top, v);
      blob.bottom = std::max(blob.bottom, v);
    }
  }
  blob.u /= std::max(1, blob.count);
  blob.v /= std::max(1, blob.count);
  return blob;
}

/// Where two frames of one size differ by more than rounding.
inline Blob changed(const Image& a, const Image& b, int rounding = 2) {
  return blobOf(a, [&](int u, int v) { return difference(at(a, u, v), at(b, u, v)) > rounding; });
}
/// Where they differ by more than what a smoothed edge leaves beside it.
inline Blob clearlyChanged(const Image& a, const Image& b) { return changed(a, b, 16); }

inline Image plain(int width, int height, std::uint8_t value) {
  return {width, height, 3,
          std::vector<std::uint8_t>(static_cast<std::size_t>(width) * height * 3, value)};
}

inline Eigen::Vector2d project(const Pinhole& camera, const Vec3& p_C) {
  return {camera.fx * p_C.x() / p_C.z() + camera.cx, camera.fy * p_C.y() / p_C.z() + camera.cy};
}

/// Pose of A in a camera at `eye_A` that looks at `target_A`, upright.
inline Pose lookAt(const Vec3& eye_A, const Vec3& target_A) {
  const Vec3 z = (target_A - eye_A).normalized(), x = z.cross(Vec3::UnitZ()).normalized();
  Mat3 R_AC;
  R_AC << x, z.cross(x), z;
  return makePose(R_AC, eye_A).inverse();
}

/// A registered picture of 320 x 240 in which the origin is seen straight on from 0.4 m; no tool.
inline SceneState straightOn(const Image& picture) {
  SceneState state;
  state.picture = &picture;
  state.registered = true;
  state.camera = {320, 240, 300, 300, 159.5, 119.5};
  state.X_CA = lookAt({0, -0.4, 0}, {0, 0, 0});
  state.show_tool = false;
  return state;
}

/// A camera that no symmetry can hide a mistake of: off-centre, fx != fy.
inline Pinhole crookedCamera() { return {640, 480, 610, 570, 300.3, 260.7}; }

}  // namespace palpa::scene
