#include "apps/report/axis.h"

#include <algorithm>
#include <cmath>

#include "apps/report/numbers.h"

namespace palpa::report {
namespace {

/// Steps 1, 2, 5, 10, 20, ...: number `index` counted from 10^0 (negative below one).
double stepNumber(int index) {
  const int decade = index >= 0 ? index / 3 : -((2 - index) / 3);
  static constexpr double kMantissas[] = {1, 2, 5};
  const double mantissa = kMantissas[index - 3 * decade];
  // Dividing by a power of ten is exact to the last bit where multiplying with a negative one is
  // not.
  return decade >= 0 ? mantissa * std::pow(10, decade) : mantissa / std::pow(10, -decade);
}

constexpr double kSlack = 1e-9;  // of a step: a limit that is round up to rounding counts as round

}  // namespace

std::string Ticks::label(double value) const { return fixed(value, decimals); }

Ticks niceTicks(double from, double to, int most) {
  Ticks ticks;
  most = std::max(most, 2);
  if (!std::isfinite(from) || !std::isfinite(to) || !(to > from)) return ticks;
  int index = 3 * (static_cast<int>(std::floor(std::log10((to - from) / most))) - 1);
  double first = 0, last = 0, step = 0;
  do {
    step = stepNumber(index);
    first = std::ceil(from / step - kSlack);
    last = std::floor(to / step + kSlack);
    ++index;
  } while (last - first + 1 > most);
  for (double k = first; k <= last; ++k) ticks.values.push_back(k == 0 ? 0 : k * step);
  ticks.decimals = std::max(0, -static_cast<int>(std::floor(std::log10(step) + kSlack)));
  return ticks;
}

double niceCeiling(double value) {
  if (!(value > 0) || !std::isfinite(value)) return 1;
  int index = 3 * static_cast<int>(std::floor(std::log10(value)) - 1);
  // Finer than the ticks' steps, so that a plot is not half empty: 1, 1.2, 1.5, 2, 2.5, 3, 4, 5,
  // 6, 8.
  for (;; index += 3) {
    for (const double mantissa : {1.0, 1.2, 1.5, 2.0, 2.5, 3.0, 4.0, 5.0, 6.0, 8.0}) {
      const double candidate = mantissa * stepNumber(index);
      if (candidate >= value * (1 - kSlack)) return candidate;
    }
  }
}

}  // namespace palpa::report
