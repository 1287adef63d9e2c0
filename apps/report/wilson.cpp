#include "apps/report/wilson.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace palpa::report {

ShareInterval wilson(int hits, int of) {
  if (of <= 0) return {std::numeric_limits<double>::quiet_NaN(), 0, 1};
  constexpr double kZ = 1.959963984540054;   // 97.5 % of a normal distribution lie below
  const double n = of, p = hits / n, z2n = kZ * kZ / n;
  const double middle = (p + z2n / 2) / (1 + z2n), half = kZ * std::sqrt(p * (1 - p) / n + z2n / (4 * n)) / (1 + z2n);
  return {p, std::max(0.0, middle - half), std::min(1.0, middle + half)};
}

}  // namespace palpa::report
