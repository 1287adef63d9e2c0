#include "anatomy/nearest_on_segment.h"

#include <algorithm>
#include <cmath>

namespace palpa::anatomy {
namespace {

constexpr double kSpacing = 8e-3;  // of the first samples: bones bend on a larger scale
constexpr int kRefinements = 4;

}  // namespace

SurfacePoint nearestToSegment(const SurfaceQuery& query, int surface, const Vec3& a_A,
                              const Vec3& b_A) {
  const Vec3 way = b_A - a_A;
  const double length = way.norm();
  const int steps = static_cast<int>(std::ceil(length / kSpacing));
  SurfacePoint best = query.closest(surface, a_A);
  for (int i = 1; i <= steps; ++i) {
    const SurfacePoint at = query.closest(surface, a_A + way * i / steps);
    if (at.distance < best.distance) best = at;
  }
  for (int i = 0; i < kRefinements && length > 0; ++i) {
    const double t = std::clamp((best.p_A - a_A).dot(way) / (length * length), 0.0, 1.0);
    const SurfacePoint at = query.closest(surface, a_A + t * way);
    if (at.distance >= best.distance) break;
    best = at;
  }
  return best;
}

}  // namespace palpa::anatomy
