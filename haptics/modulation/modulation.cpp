#include "haptics/modulation/modulation.h"

#include <algorithm>
#include <cmath>

#include "anatomy/base/pinned_math.h"

namespace palpa::haptics {
namespace {

constexpr double kPressedWithin = 0.05;  // tan 3 degrees
constexpr double kNormalFollows = 1e-4;  // m of sliding
constexpr double kAngleDoubt = 0.01;     // N across a reaction [chosen]
constexpr double kForceDoubt = 0.025;    // N, of a reaction [chosen]
constexpr double kLawDoubt = 0.05;       // of a depth that the law tells [chosen]

/// Where both begin to touch, from one tick's distance and squeezing force.
void learnBegin(const SqueezeModulation& law, double apart, double F,
                SqueezeState& state) noexcept {
  if (!(law.real.k > 0)) {
    if (state.d0 == 0) state.d0 = apart;
    return;
  }
  const double x = depthOf(law.real, F, 0), rise = std::max(stiffnessOf(law.real, x, 0), 1.0),
               by_force = kForceDoubt / rise, by_law = kLawDoubt * x,
               precision = 1 / (by_force * by_force + by_law * by_law);
  state.precision += precision;
  state.d0 += (apart + 2 * (law.x0 + x) - state.d0) * precision / state.precision;
}

}  // namespace

Vec3 slidOver(const Vec3& dp, const Vec3& u, double f) noexcept {
  const double pressed = dp.dot(u);
  const Vec3 along = dp - pressed * u;
  const double length = along.norm(),
               sticks = (kPressedWithin + kAngleDoubt / f) * std::abs(pressed);
  return length > sticks ? Vec3(along * (1 - sticks / length)) : Vec3(Vec3::Zero());
}

Modulated modulateStiffness(const StiffnessModulation& law, const Vec3& f_r, const Vec3& dp,
                            double dt, StiffnessModulationState* state) noexcept {
  if (!f_r.allFinite() || !dp.allFinite() || !(dt > 0) || f_r.norm() < law.least_contact) {
    *state = {};
    return {};
  }
  // At first touch the reaction itself is the best normal there is; from then on the last one.
  const Vec3 u_before = state->f_n > 0 ? unpack(state->u_n) : Vec3(f_r.normalized());
  const double f_before = state->f_n > 0 ? state->f_n : f_r.norm();
  const Vec3 slid = slidOver(dp, u_before, f_before),
             drag = dragOf(law.friction, slid, u_before, f_before, dt, &state->friction);
  const Vec3 f_rn = f_r + drag;
  Modulated now;
  now.f_n = f_rn.norm();
  if (now.f_n < law.least_contact) {  // all of it is friction: no normal can be told
    *state = {};
    return {};
  }
  now.contact = true;
  now.slid = slid;
  now.u_n = f_rn / now.f_n;
  const double rate = -dp.dot(now.u_n) / dt;
  now.x = std::max(0.0, law.x0 + depthOf(law.real, now.f_n, rate));
  const double wanted =
      law.target.constant > 0 ? law.target.constant * now.x : law.target.factor * now.f_n;
  now.f_d = (wanted - now.f_n) * now.u_n;
  double follows = 0;
  if (state->f_n > 0)
    follows = slid != Vec3::Zero() ? 1 - pinned::exp(-slid.norm() / kNormalFollows)
                                   : 1 - std::min(state->told_N / now.f_n, 1.0);
  state->told_N = std::max(state->told_N, now.f_n);
  const Vec3 between = u_before + follows * (now.u_n - u_before);
  state->u_n = pack(between.norm() > 0.1 ? Vec3(between.normalized())
                                         : now.u_n);  // where it has turned round
  state->f_n = now.f_n;
  return now;
}

Modulated modulateFriction(const FrictionModulation& law, const Vec3& f_r, const Vec3& dp,
                           double dt, FrictionModulationState* state) noexcept {
  Modulated now = modulateStiffness(law.contact, f_r, dp, dt, &state->contact);
  if (!now.contact) {
    state->wanted = {};
    return now;
  }
  const Vec3 f_real = f_r - f_r.dot(now.u_n) * now.u_n;
  now.f_rub = -(dragOf(law.wanted, now.slid, now.u_n, now.f_n, dt, &state->wanted) + f_real);
  now.f_d += now.f_rub;
  return now;
}

Squeezed modulateSqueeze(const SqueezeModulation& law, const std::array<Vec3, 2>& f_r,
                         const std::array<Vec3, 2>& p, SqueezeState* state) noexcept {
  constexpr double kNearest = 1e-4;  // m: tips that are one have no line between them
  const double apart = (p[0] - p[1]).norm();
  const bool touching = f_r[0].norm() >= law.least_contact && f_r[1].norm() >= law.least_contact;
  if (!f_r[0].allFinite() || !f_r[1].allFinite() || !(apart > kNearest) || !(apart < 10) ||
      !touching) {
    *state = {};
    return {};
  }
  Squeezed now;
  now.contact = true;
  now.l = (p[0] - p[1]) / apart;
  now.F = std::max(0.5 * (f_r[0] - f_r[1]).dot(now.l), 0.0);
  learnBegin(law, apart, now.F, *state);
  now.x = std::max(0.5 * (state->d0 - apart), 0.0);
  const double wanted =
      law.target.constant > 0 ? law.target.constant * now.x : law.target.factor * now.F;
  for (std::size_t i = 0; i < 2; ++i) {
    const Vec3 u = i == 0 ? now.l : Vec3(-now.l);
    now.f_w[i] = f_r[i] - now.F * u;
    now.f_d[i] = (wanted - now.F) * u + (law.weight_factor - 1) * now.f_w[i];
  }
  return now;
}

}  // namespace palpa::haptics
