#pragma once

#include <vector>

#include "anatomy/geometry/pose.h"

namespace palpa::anatomy {

/// All points within `radius` of the segment a-b.
struct Rod {
  Vec3 a, b;
  double radius;
};

/// Of p from the rod's surface, negative inside. `foot`, if asked for: the segment's point nearest
/// to p.
double distanceTo(const Rod& rod, const Vec3& p, Vec3* foot = nullptr);

struct SurfaceSample {
  Vec3 p, n;  ///< n: outward, unit
};

/// Radius of the largest ball inside the surface that touches it at p with the outward normal n, at
/// most `most`: no sample lies deeper than `give` in it. r = min over q of ((p - q)^2 - give^2) /
/// (2 (n . (p - q) - give)).
double inscribedRadius(const std::vector<SurfaceSample>& samples, const Vec3& p, const Vec3& n,
                       double give, double most);

/// The rod about the inscribed ball's centre, along `u` as far as no sample lies deeper than `give`
/// in it, at most `half` each way.
Rod inscribedRod(const std::vector<SurfaceSample>& samples, const Vec3& p, const Vec3& n,
                 const Vec3& u, double give, double most, double half);

/// Direction along which the samples within `reach` of p are least curved: of least variance of
/// their normals.
Vec3 alongSurface(const std::vector<SurfaceSample>& samples, const Vec3& p, double reach);

struct RodFit {
  std::vector<Rod> rods;
  double rms = 0;  ///< of the samples' distances to the union, metres
};

/// Rods whose union fits the samples of a closed surface: one more at a time, inscribed where the
/// union misses most, then all of them moved to the least sum of squares of the samples' distances
/// to the union (Levenberg 1944, Marquardt 1963; a sample counts for the rod nearest to it, so that
/// every rod has normal equations of its own, 7 by 7). Ends at `good_rms` or with `most` rods. Same
/// samples, same bits.
RodFit fitRods(const std::vector<SurfaceSample>& samples, double good_rms, int most);

}  // namespace palpa::anatomy
