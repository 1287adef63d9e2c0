#include "haptics/squeeze_modulation.h"

#include <algorithm>

namespace palpa::haptics {

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
  if (state->d0 == 0) state->d0 = apart + (law.real.k > 0 ? 2 * depthOf(law.real, now.F, 0) : 0);
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
