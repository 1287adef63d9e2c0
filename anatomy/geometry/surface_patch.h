#pragma once

#include <type_traits>

#include "anatomy/geometry/pose.h"

namespace palpa {

/// A surface near the tool, as a height over a tangent plane: point p + a x + b y + h(a, b) n, with
///   h(a, b) = sum of c_ij a^i b^j, i + j <= 3      in the order 1 a b aa ab bb aaa aab abb bbb
/// within `reach` of p; beyond, it goes on straight. Curvature is in it, so that a hand which has
/// moved since the patch was made still meets the surface. Metres; x, y, n right-handed, n outward.
struct SurfacePatch {
  static constexpr int kTerms = 10;
  Packed3 p{}, x{1, 0, 0}, n{0, 0, 1};
  double c[kTerms]{};
  double reach = 0;  ///< 0: there is no patch
};
static_assert(std::is_trivially_copyable_v<SurfacePatch>);

struct PatchContact {
  Vec3 foot = Vec3::Zero();     ///< nearest point of the surface
  Vec3 normal = Vec3::UnitZ();  ///< of the surface there, outward, unit
  double distance = 0;          ///< signed: negative inside
};

/// Nearest point of the patch to `p`, by Newton's method from the point straight below: exact to
/// micrometres within the reach while `p` is nearer than the radius of curvature. A handful of
/// multiplications: the cost knows no mesh.
PatchContact nearestOn(const SurfacePatch& patch, const Vec3& p) noexcept;

}  // namespace palpa
