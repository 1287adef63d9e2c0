#include "anatomy/parametric/thorax.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "anatomy/shapes/mesh_tools.h"
#include "anatomy/shapes/spline.h"

namespace palpa::anatomy {
namespace {

using Flat = Eigen::Vector2d;  // (l, z)

// Origin: under the clavicle from its middle to its sternal end, then down beside the sternum.
Flat origin(const Clavicle& clavicle, double lowest, double v) {
  static const Spline sternal_l{{0, 27}, {0.25, 22}, {1, 21}};
  constexpr double kClavicular = 0.40, kSternalTop = -17;
  if (v < kClavicular) {
    const double fraction = 0.54 + (0.13 - 0.54) * v / kClavicular;
    const auto& s = clavicle.sections[static_cast<std::size_t>(fraction * 96)];
    return {s.centre.x(), clavicle.lowerBorder(fraction) - 3};
  }
  const double w = (v - kClavicular) / (1 - kClavicular);
  return {sternal_l(w) + 10 * std::max(0.0, w - 0.8), kSternalTop + (lowest - kSternalTop) * w};
}

// Insertion: the fibres close up toward the humerus and cross a little.
Flat insertion(const Clavicle& clavicle, double v) {
  return {clavicle.acromial_end.x() + 3 - 6 * v, clavicle.acromial_end.z() - 62 - 36 * v};
}

// 1 inside, falling to 0 like a quarter circle within `margin` of the edge of [0, 1].
double rounded(double t, double margin) {
  const double d = std::clamp(std::min(t, 1 - t) / margin, 0.0, 1.0);
  return std::sqrt(1 - (1 - d) * (1 - d));
}

// Shallow furrows between the bundles of fibres, on the front only, mm.
double fibres(double u, double v, double bundles) {
  constexpr double kDepth = 0.5;
  const double fade = rounded(u, 0.25) * rounded(v, 0.15);
  const double wave = std::cos(2 * std::numbers::pi * bundles * (v + 0.01 * std::sin(9 * u)));
  return kDepth * fade * std::pow(0.5 + 0.5 * wave, 2);
}

// Where there is little over it, a muscle (half as thick as `half`) lies deeper: 2 mm stay over it.
Vec3 under(const BodySurface& skin, const Vec3& p, double half) {
  constexpr double kOver = 2.0;
  const double facing = std::max(-skin.frontNormal(p.x(), p.z()).y(), 0.5);
  return {p.x(), std::max(p.y(), skin.front(p.x(), p.z(), true) + (half + kOver) / facing), p.z()};
}

}  // namespace

TriangleMesh makePectoralisMajor(const BodySurface& skin, const Clavicle& clavicle) {
  const double lowest = std::min(0.64 * skin.lower(), -112.0);
  const auto at = [&](double u, double v) {
    const double sag = 9 * v * v * std::sin(std::numbers::pi * u);  // the lower border hangs
    const Flat a = origin(clavicle, lowest, v), b = insertion(clavicle, v);
    const Flat f = a + u * (b - a) - Flat(0, sag);
    const Vec3 on_skin(f.x(), skin.front(f.x(), f.y(), true), f.y());
    const Vec3 n = skin.frontNormal(f.x(), f.y());
    const double off = std::abs(f.x()), thick = skin.muscle(off),
                 half = thick / 2 * rounded(u, 0.10) * rounded(v, 0.07);
    return SheetPoint{on_skin - n * (skin.soft(off) - thick / 2), n,
                      half - std::min(fibres(u, v, 13), 0.3 * half), half};
  };
  return sheet(at, 30, 66);
}

TriangleMesh makePectoralisMinor(const BodySurface& skin, const Clavicle& clavicle,
                                 const Build& build) {
  const Vec3 top = build.place({74, 2, -90}),
             bottom = build.bust() ? build.place({82, -5, -116}) : build.place({84, -10, -147}),
             tip = coracoid(clavicle);
  const auto middle = [&](double u, double v) {
    const Vec3 from = top + v * (bottom - top) + Vec3(0, -2.5 * std::sin(std::numbers::pi * v), 0);
    const Vec3 to = tip + Vec3(-3 * v, -5, -6 + 5 * (1 - 2 * v));
    return Vec3(from + u * (to - from) + std::sin(std::numbers::pi * u) * Vec3(0, -7, 0));
  };
  const auto at = [&](double u, double v) {
    constexpr double kStep = 1e-3;
    const Vec3 du = middle(u + kStep, v) - middle(u - kStep, v),
               dv = middle(u, v + kStep) - middle(u, v - kStep);
    Vec3 n = du.cross(dv).normalized();
    if (n.y() > 0) n = -n;
    const double half = 3.2 * rounded(u, 0.08) * rounded(v, 0.12);
    return SheetPoint{under(skin, middle(u, v), half), n, half - 0.6 * fibres(u, v, 7), half};
  };
  return sheet(at, 26, 36);
}

TriangleMesh makeSubclavius(const BodySurface& skin, const Clavicle& clavicle) {
  const auto below = [&](double fraction) {
    const Section& s = clavicle.sections[static_cast<std::size_t>(fraction * 96)];
    return under(skin, s.centre + Vec3(0, 4.0, -s.half_up - 2.6), 3.6);
  };
  const Curve curve({under(skin, {34, 15.5, -12}, 2.6), under(skin, {43, 16.5, -7}, 3.6),
                     below(0.34), below(0.46), below(0.58)});
  std::vector<Section> sections = sectionsAlong(curve.sample(30), Vec3::UnitZ());
  for (std::size_t i = 0; i < sections.size(); ++i) {
    const double u = static_cast<double>(i) / static_cast<double>(sections.size() - 1);
    sections[i].half_up = 1.1 + 1.5 * std::sin(std::numbers::pi * u);
    sections[i].half_side = 1.6 + 2.0 * std::sin(std::numbers::pi * u);
  }
  return sweep(sections, 16, 0.6);
}

}  // namespace palpa::anatomy
