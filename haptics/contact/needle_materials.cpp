#include "haptics/contact/needle_materials.h"

#include <algorithm>

#include "anatomy/base/pinned_math.h"

namespace palpa::haptics {
namespace {
constexpr double kLargestExponent = 40;  // keeps absurd indentations finite
}

double SkinLaw::force(double u) const {
  if (u <= 0) return 0;
  const double exponent = std::min(m * (u - u_0), kLargestExponent);
  return u > u_0 ? (K_0 * (pinned::exp(exponent) - 1) + K_min) * u : K_min * u;
}

double SkinLaw::stiffness(double u) const {
  if (u <= u_0) return u > 0 ? K_min : 0;
  const double grown = pinned::exp(std::min(m * (u - u_0), kLargestExponent));
  return K_0 * (grown - 1) + K_min + K_0 * m * grown * u;
}

namespace {

constexpr double kForgetWall = 0.0003;  // m back out of a wall before it counts as whole again
constexpr double kGrazing = 0.05;       // cosine below which a boundary is nearly parallel
constexpr double kLocal = 0.003;  // m: the plane is believed this far along the needle, no farther

/// How far along the needle the tip is past a boundary; negative before it. The crossing point's
/// own distance along the axis, corrected for the plane's tilt where the needle has moved sideways
/// since. A grazing plane far from its crossing says nothing: the correction is bounded.
double pastBoundary(const Boundary& boundary, const Vec3& p_DT, const Vec3& a_D) {
  const Vec3 n = unpack(boundary.n), to_tip = p_DT - unpack(boundary.p);
  const double along = to_tip.dot(a_D);
  const Vec3 sideways = to_tip - along * a_D;
  const double incidence = std::max(-a_D.dot(n), kGrazing);
  return along - std::clamp(sideways.dot(n) / incidence, -kLocal, kLocal);
}

}  // namespace

TissueWalk walkTissues(const NeedleMaterials& materials, const LocalGeometry& geometry,
                       const Vec3& p_DT, const Vec3& a_D, double insertion,
                       const PuncturedWalls& walls) noexcept {
  TissueWalk walk;
  double layer_start = 0;  // insertion at which the current tissue began
  for (int i = 0; i < geometry.boundary_count; ++i) {
    const Boundary& boundary = geometry.boundaries[i];
    if (boundary.wall == Organ::skin) continue;  // the skin has its own law
    const double past = pastBoundary(boundary, p_DT, a_D);
    const bool has_wall =
        boundary.wall != Organ::none && materials.walls[static_cast<int>(boundary.wall)].peak > 0;
    const std::uint32_t bit = has_wall ? 1u << static_cast<int>(boundary.wall) : 0u;
    const bool punctured = (boundary.leaving ? walls.back : walls.front) & bit;
    if (punctured && past > -kForgetWall)
      (boundary.leaving ? walk.passed.back : walk.passed.front) |= bit;
    if (past <= 0) break;
    if (has_wall && !punctured) {
      walk.wall = boundary.wall;
      walk.wall_leaving = boundary.leaving;
      walk.wall_depth = past;
      break;
    }
    const double here = std::clamp(insertion - past, layer_start, std::max(insertion, layer_start));
    walk.shaft_friction +=
        materials.layers[static_cast<int>(walk.tissue)].friction * (here - layer_start);
    layer_start = here;
    walk.tissue = boundary.to;
  }
  walk.shaft_friction += materials.layers[static_cast<int>(walk.tissue)].friction *
                         std::max(0.0, insertion - layer_start);
  return walk;
}

}  // namespace palpa::haptics
