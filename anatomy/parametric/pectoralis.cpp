#include "anatomy/parametric/pectoralis.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "anatomy/shapes/mesh_tools.h"
#include "anatomy/shapes/spline.h"

namespace palpa::anatomy {
namespace {

constexpr int kAlong = 36, kAcross = 84;  // quads along the fibres and across them

using Flat = Eigen::Vector2d;  // (l, z)

// Origin: under the clavicle from its middle to its sternal end, then down beside the sternum.
Flat origin(const Clavicle& clavicle, double v) {
  static const Spline sternal_l{{0, 27}, {0.25, 22}, {1, 19}};
  static const Spline sternal_z{{0, -17}, {0.25, -32}, {1, -118}};
  constexpr double kClavicular = 0.45;
  if (v < kClavicular) {
    const double fraction = 0.54 + (0.13 - 0.54) * v / kClavicular;
    const auto& s = clavicle.sections[static_cast<std::size_t>(fraction * 96)];
    return {s.centre.x(), clavicle.lowerBorder(fraction) - 3};
  }
  const double w = (v - kClavicular) / (1 - kClavicular);
  return {sternal_l(w), sternal_z(w)};
}

// Insertion: the fibres close up toward the humerus and cross a little.
Flat insertion(double v) { return {152 - 4 * v, -38 - 34 * v}; }

Flat place(const Clavicle& clavicle, double u, double v) {
  const Flat a = origin(clavicle, v), b = insertion(v);
  const double sag = 7 * v * v * std::sin(std::numbers::pi * u);  // the lower border hangs
  return a + u * (b - a) - Flat(0, sag);
}

// 1 inside, falling to 0 like a quarter circle within `margin` of the edge of [0, 1].
double rounded(double t, double margin) {
  const double d = std::clamp(std::min(t, 1 - t) / margin, 0.0, 1.0);
  return std::sqrt(1 - (1 - d) * (1 - d));
}

// Shallow furrows between the bundles of fibres, on the front only, mm.
double fibres(double u, double v) {
  constexpr double kDepth = 0.5, kBundles = 13;
  const double fade = rounded(u, 0.25) * rounded(v, 0.15);
  const double wave = std::cos(2 * std::numbers::pi * kBundles * (v + 0.01 * std::sin(9 * u)));
  return kDepth * fade * std::pow(0.5 + 0.5 * wave, 2);
}

}  // namespace

TriangleMesh makePectoralis(const BodySurface& skin, const Clavicle& clavicle) {
  TriangleMesh mesh;
  std::vector<std::uint32_t> front, back;
  for (int j = 0; j <= kAcross; ++j)
    for (int i = 0; i <= kAlong; ++i) {
      const double u = double(i) / kAlong, v = double(j) / kAcross;
      const Flat at = place(clavicle, u, v);
      const Vec3 on_skin(at.x(), skin.front(at.x(), at.y()), at.y());
      const Vec3 n = gradient(std::cref(skin), on_skin, 2.0).normalized();
      const Vec3 middle = on_skin - n * (skin.skin() + skin.fat() + skin.muscle() / 2);
      const double half = skin.muscle() / 2 * rounded(u, 0.10) * rounded(v, 0.07);
      front.push_back(static_cast<std::uint32_t>(mesh.points.size()));
      mesh.points.push_back(middle + (half - fibres(u, v)) * n);
      const bool border = i == 0 || j == 0 || i == kAlong || j == kAcross;
      back.push_back(border ? front.back() : static_cast<std::uint32_t>(mesh.points.size()));
      if (!border) mesh.points.push_back(middle - half * n);
    }
  const auto quad = [&](std::uint32_t a, std::uint32_t b, std::uint32_t c, std::uint32_t d) {
    mesh.triangles.push_back({a, b, c});
    mesh.triangles.push_back({a, c, d});
  };
  for (int j = 0; j < kAcross; ++j)
    for (int i = 0; i < kAlong; ++i) {
      const std::size_t a = std::size_t(j) * (kAlong + 1) + i, b = a + 1, c = b + kAlong + 1,
                        d = c - 1;
      // At two corners the diagonal turns, lest front and back share a whole triangle.
      const bool corner = (i == kAlong - 1 && j == 0) || (i == 0 && j == kAcross - 1);
      if (corner) {
        quad(front[b], front[c], front[d], front[a]);
        quad(back[b], back[a], back[d], back[c]);
      } else {
        quad(front[a], front[b], front[c], front[d]);
        quad(back[a], back[d], back[c], back[b]);
      }
    }
  if (signedVolume(mesh) < 0) flip(&mesh);
  computeNormals(&mesh);
  return mesh;
}

}  // namespace palpa::anatomy
