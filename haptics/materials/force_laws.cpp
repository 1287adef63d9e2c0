#include "haptics/materials/force_laws.h"

#include <algorithm>

#include "anatomy/base/pinned_math.h"

namespace palpa::haptics {
namespace {

/// What multiplies x^m.
double factorOf(const HuntCrossley& law, double rate) noexcept {
  return std::max(law.k + law.b * rate, 0.1 * law.k);
}

}  // namespace

double forceOf(const HuntCrossley& law, double x, double rate) noexcept {
  return x > 0 ? pinned::pow(x, law.m) * factorOf(law, rate) : 0;
}

double depthOf(const HuntCrossley& law, double f, double rate) noexcept {
  const double factor = factorOf(law, rate);
  return f > 0 && factor > 0 ? pinned::pow(f / factor, 1 / law.m) : 0;
}

double stiffnessOf(const HuntCrossley& law, double x, double rate) noexcept {
  return x > 0 ? law.m * pinned::pow(x, law.m - 1) * factorOf(law, rate) : 0;
}

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
    F = slid + pinned::exp(-law.sigma * way / limit) * (F - slid);
  }
  if (const double size = F.norm(); size > limit) F *= limit / size;
  state->F = pack(F);
  return dt > 0 ? Vec3(F + law.B / dt * motion) : F;
}

double relaxed(const Relaxation& law, RelaxationState& state, double elastic, double dt) noexcept {
  if (elastic <= 0) {
    state = RelaxationState{};
    return 0;
  }
  const double grown = elastic - state.elastic;
  double force = elastic;
  for (int i = 0; i < Relaxation::kTerms; ++i) {
    if (law.g[i] == 0) continue;
    const double a = dt > 0 ? dt / law.tau[i] : 0.0;
    const double kept = pinned::exp(-a);
    const double share = a > 0 ? -pinned::expm1(-a) / a : 1.0;
    state.held[i] = kept * state.held[i] + law.g[i] * share * grown;
    force -= law.g[i] * elastic - state.held[i];
  }
  state.elastic = elastic;
  return std::max(force,
                  0.0);  // drawn back fast, the tissue lags behind the tool: it does not pull
}

}  // namespace palpa::haptics
