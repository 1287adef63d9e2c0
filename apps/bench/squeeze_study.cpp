#include "apps/bench/squeeze_study.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "haptics/squeeze_modulation.h"

namespace palpa::bench {
namespace {

constexpr double kGravity = 9.80665, kThick = 0.06;  // m/s^2, m
constexpr double
    kFirm = 3e-3,
    kDeepest = 7e-3;  // m that both tools press, so that nothing slips, to begin with and at most

double pushOf(const twin::PhantomTable& side, double x) { return side.at(0, x).f_up; }

/// Depths at both sides whose sum is known and whose forces differ by what hangs along the line:
/// bisection.
std::array<double, 2> settledDepths(const twin::PhantomTable& side, double sum, double along) {
  double low = 0, high = sum;
  for (int i = 0; i < 60; ++i) {
    const double first = 0.5 * (low + high);
    (pushOf(side, first) - pushOf(side, sum - first) < along ? low : high) = first;
  }
  return {low, sum - low};
}

}  // namespace

double squeezeError(const twin::PhantomTable& side, const haptics::HuntCrossley& known,
                    const SqueezeCase& squeeze) {
  const Vec3 l(std::cos(squeeze.tilt), 0,
               std::sin(squeeze.tilt));  // from the second tool to the first, the higher one
  const double weight = squeeze.mass * kGravity;
  const Vec3 on_object(0, 0, -weight), along = on_object.dot(l) * l, across = on_object - along;
  haptics::SqueezeState state;
  haptics::SqueezeModulation law;
  law.real = known;
  RelativeRms error;
  for (double t = 0; t < 4; t += kPhantomTick) {
    // Both come to touch together; lifted once they hold firmly.
    const double mean =
        t < 1 ? kFirm * t : kFirm + (kDeepest - kFirm) * 0.5 * (1 - std::cos(2 * (t - 1)));
    const double lifted = std::min(1.0, std::max(0.0, (t - 1) / 0.5));
    const std::array<double, 2> x = settledDepths(side, 2 * mean, lifted * on_object.dot(l));
    // The object's reaction on a tool: outward push, and half of the weight across the line.
    const std::array<Vec3, 2> f_r{pushOf(side, x[0]) * l + 0.5 * lifted * across,
                                  -pushOf(side, x[1]) * l + 0.5 * lifted * across};
    const std::array<Vec3, 2> p{0.5 * (kThick - 2 * mean) * l, -0.5 * (kThick - 2 * mean) * l};
    const int a = squeeze.swapped ? 1 : 0, b = 1 - a;
    law.target.constant = mean > 0 ? squeeze.factor * pushOf(side, mean) / mean : 1;
    const haptics::Squeezed now = haptics::modulateSqueeze(
        law, {f_r[static_cast<std::size_t>(a)], f_r[static_cast<std::size_t>(b)]},
        {p[static_cast<std::size_t>(a)], p[static_cast<std::size_t>(b)]}, &state);
    if (t < 1.5) continue;
    for (std::size_t i = 0; i < 2; ++i) {
      const Vec3 u = i == 0 ? l : Vec3(-l),
                 wanted = law.target.constant * mean * u + 0.5 * on_object;
      error.add(f_r[i] + now.f_d[i == static_cast<std::size_t>(a) ? 0 : 1] - wanted, wanted);
    }
  }
  return error.value();
}

}  // namespace palpa::bench
