#include "haptics/materials/dahl.h"

#include <algorithm>
#include <cmath>

namespace palpa::haptics {
namespace {

Vec3 along(const Vec3& v, const Vec3& n) noexcept { return v - v.dot(n) * n; }

/// Laid into the plane across n without losing its size.
Vec3 turnedInto(const Vec3& F, const Vec3& n) noexcept {
  const Vec3 in_plane = along(F, n);
  const double size = in_plane.norm();
  return size > 1e-12 ? Vec3(F.norm() / size * in_plane) : Vec3(Vec3::Zero());
}

}  // namespace

Vec3 dragOf(const Dahl& law, const Vec3& dp, const Vec3& n, double f_n, double dt,
            DahlState* state) noexcept {
  const double limit = law.mu * f_n;
  if (!(limit > 0)) {
    *state = {};
    return Vec3::Zero();
  }
  const Vec3 motion = along(dp, n);
  const double way = motion.norm();
  Vec3 F = turnedInto(unpack(state->F), n);
  if (way > 0) {
    const Vec3 slid = limit / way * motion;
    F = slid + std::exp(-law.sigma * way / limit) * (F - slid);
  }
  if (const double size = F.norm(); size > limit) F *= limit / size;
  state->F = pack(F);
  return dt > 0 ? Vec3(F + law.B / dt * motion) : F;
}

}  // namespace palpa::haptics
