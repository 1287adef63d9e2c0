#include "haptics/modulation/pulse.h"

#include <algorithm>
#include <cmath>

namespace palpa::haptics {
namespace {

constexpr double kEnds = 4;  // times the width: where nothing is felt any more

double bumpAt(const PulseBump& bump, double t) noexcept {
  const double side = t < bump.peak_s ? bump.peak_s - bump.start_s : bump.end_s - bump.peak_s;
  if (!(side > 0) || !(std::abs(t - bump.peak_s) < side)) return 0;
  const double u = (t - bump.peak_s) / side, inside = 1 - u * u;
  return bump.height * inside * inside * inside;
}

/// 0 to 1 over 0 to 1, without a kink at either end.
double smoothStep(double u) noexcept {
  const double v = std::clamp(u, 0.0, 1.0);
  return v * v * (3 - 2 * v);
}

bool isArtery(const PulsingArtery& artery) noexcept {
  return artery.vessel >= 1 && artery.vessel <= kMostVessels && unpack(artery.p_P).allFinite() &&
         std::abs(unpack(artery.a_P).norm() - 1) < 1e-6 && artery.half_length >= 0 &&
         artery.depth >= 0 && artery.strength_N > 0 && artery.best_N > 0 &&
         std::isfinite(artery.half_length + artery.depth + artery.strength_N);
}

/// From the artery's line to the point that touches, along the surface, m.
double besideLine(const PulsingArtery& artery, const PulseTouch& touch) noexcept {
  const Vec3 a = unpack(artery.a_P), from = touch.p_C - unpack(artery.p_P);
  const Vec3 off = from - std::clamp(from.dot(a), -artery.half_length, artery.half_length) * a;
  return (off - off.dot(touch.u_n) * touch.u_n).norm();
}

double beatsNow(const PulseWave& wave, const PulsingArtery& artery, std::int64_t now_ns) noexcept {
  double sum = 0;
  for (const PulseBeat& beat : artery.beats) {
    if (!(beat.strength > 0) || !std::isfinite(beat.strength)) continue;
    const double t = static_cast<double>(now_ns) - static_cast<double>(beat.start_ns);
    sum += beat.strength * pulseWave(wave, 1e-9 * t);
  }
  return sum;
}

}  // namespace

double pulseWave(const PulseWave& wave, double t) noexcept {
  double sum = 0;
  for (const PulseBump& bump : wave.bumps) sum += bumpAt(bump, t);
  return sum;
}

double pulseAcross(double d, double z, double r) noexcept {
  const double w2 = z * z + r * r, q = d * d / w2;
  if (!(w2 > 0) || !(q < kEnds * kEnds)) return 0;
  const double ending = 1 - q / (kEnds * kEnds);
  return r / std::sqrt(w2) * ending * ending / ((1 + q) * (1 + q));
}

double pulsePressed(double u, double closed) noexcept {
  return u < 1 ? smoothStep(u) : 1 - smoothStep((u - 1) / (closed - 1));
}

Vec3 feelPulse(const PulseLaw& law, const PulsingArtery& artery, const PulseTouch& touch,
               std::int64_t now_ns, double dt, PulseState* state) noexcept {
  const bool valid = touch.p_C.allFinite() && touch.u_n.allFinite() && std::isfinite(touch.f_n);
  if (!touch.contact || !valid || !(dt > 0) || !isArtery(artery)) {
    *state = {};
    return Vec3::Zero();
  }
  state->pressed_N += (touch.f_n - state->pressed_N) * (dt / (law.press_tau + dt));
  const double f =
      artery.strength_N * pulseAcross(besideLine(artery, touch), artery.depth, law.contact_radius) *
      pulsePressed(state->pressed_N / artery.best_N, law.closed_at) *
      smoothStep(touch.f_n / law.light_N) * beatsNow(law.waves[artery.vessel - 1], artery, now_ns);
  return std::min(f, law.largest_N) * touch.u_n;
}

}  // namespace palpa::haptics
