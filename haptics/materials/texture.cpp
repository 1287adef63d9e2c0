#include "haptics/materials/texture.h"

#include <algorithm>
#include <cmath>

#include "anatomy/base/pinned_math.h"

namespace palpa::haptics {
namespace {

constexpr double kTextureTau = 0.02;  // s: a hand's force and speed, without what shakes them
constexpr double kLeastStep = 1e-6;   // s

/// Galois' form of x^13 + x^12 + x^11 + x^8 + 1: 8191 steps, then again. Over a whole turn every
/// frequency has the same power, so a few seconds are as loud as the model says in every band.
constexpr std::uint32_t kTaps = 0x1c80, kFirst = 1;

double nextSign(std::uint32_t* noise) noexcept {
  if (*noise == 0) *noise = kFirst;
  const bool one = *noise & 1u;
  *noise >>= 1;
  if (one) *noise ^= kTaps;
  return one ? 1 : -1;
}

/// Between which two of a row, and how far from the first of them: 0 to 1.
struct Between {
  std::size_t first = 0, second = 0;
  double share = 0;
};
template <std::size_t N>
Between between(const std::array<double, N>& row, std::size_t count, double x) noexcept {
  if (!(x > row[0])) return {};
  if (!(x < row[count - 1])) return {count - 1, count - 1, 0};
  std::size_t i = 0;
  while (i + 2 < count && row[i + 1] <= x) ++i;
  return {i, i + 1, (x - row[i]) / (row[i + 1] - row[i])};
}

/// Four nodes and their weights.
struct Corners {
  std::array<const TextureNode*, 4> node;
  std::array<double, 4> weight;
};
Corners cornersAt(const TextureLaw& law, double ln_force, double ln_speed) noexcept {
  const Between f = between(law.ln_force, law.forces, ln_force),
                v = between(law.ln_speed, law.speeds, ln_speed);
  return {{&law.nodes[f.first][v.first], &law.nodes[f.first][v.second],
           &law.nodes[f.second][v.first], &law.nodes[f.second][v.second]},
          {(1 - f.share) * (1 - v.share), (1 - f.share) * v.share, f.share * (1 - v.share),
           f.share * v.share}};
}

double mixed(const Corners& corners, double (*of)(const TextureNode&, std::size_t),
             std::size_t i) noexcept {
  double sum = 0;
  for (std::size_t c = 0; c < 4; ++c) sum += corners.weight[c] * of(*corners.node[c], i);
  return sum;
}

double shake(const TextureLaw& law, const Corners& corners, TextureState* state) noexcept {
  const double y_before = state->backward[0];
  double forward = nextSign(&state->noise);
  for (std::size_t i = law.order; i-- > 0;) {
    const double k = std::clamp(
        mixed(
            corners, [](const TextureNode& n, std::size_t j) { return n.reflection[j]; }, i),
        -1.0, 1.0);
    const double c = std::sqrt(1 - k * k), back = state->backward[i];
    if (i + 1 < law.order) state->backward[i + 1] = k * forward + c * back;
    forward = c * forward - k * back;
  }
  state->backward[0] = forward;
  const double ln_rms = mixed(
      corners, [](const TextureNode& n, std::size_t) { return n.ln_rms; }, 0);
  return pinned::exp(ln_rms) * (forward - kTextureLeak * y_before);
}

bool usable(const TextureLaw& law) noexcept {
  return law.speeds > 0 && law.speeds <= kMostTextureSpeeds && law.forces > 0 &&
         law.forces <= kMostTextureForces && law.order > 0 && law.order <= kMostTextureOrder;
}

}  // namespace

double textureForce(const TextureLaw& law, double f_n, const Vec3& slid, double dt,
                    TextureState* state) noexcept {
  const std::uint32_t noise = state->noise;
  if (!usable(law) || !(f_n > 0) || !std::isfinite(f_n) || !slid.allFinite() ||
      !(dt > kLeastStep)) {
    *state = {};
    state->noise = noise;
    return 0;
  }
  const double follows = dt / (kTextureTau + dt);
  const Vec3 before = unpack(state->slow_v), v = before + follows * (slid / dt - before);
  state->slow_v = pack(v);
  state->slow_f_n += follows * (f_n - state->slow_f_n);
  const double speed = v.norm(), ln_force = pinned::log(state->slow_f_n),
               first_speed = pinned::exp(law.ln_speed[0]);
  if (!(speed > kTextureStill)) return 0;
  const double moves = first_speed > kTextureStill
                           ? (speed - kTextureStill) / (first_speed - kTextureStill)
                           : 1.0,
               presses = pinned::exp(std::min(ln_force - law.ln_force[0], 0.0));
  const double w = shake(law, cornersAt(law, ln_force, pinned::log(speed)), state) *
                   std::min(moves, 1.0) * presses;
  return std::isfinite(w) ? std::clamp(w, -law.largest, law.largest) : 0.0;
}

double textureRms(const TextureNode& node) noexcept {
  const double r = kTextureLeak;
  return pinned::exp(node.ln_rms) * std::sqrt(1 + r * r + 2 * r * node.reflection[0]);
}

}  // namespace palpa::haptics
