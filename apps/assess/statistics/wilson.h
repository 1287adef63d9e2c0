#pragma once

#include <algorithm>
#include <cmath>
#include <limits>

namespace palpa::statistics {

/// A share with its 95 % confidence interval.
struct ShareInterval {
  double share = 0, low = 0, high = 1;
};

/// Of `hits` among `of` independent tries. With p = hits / n and z = 1.96:
///   (p + z^2/2n -+ z sqrt(p (1 - p) / n + z^2/4n^2)) / (1 + z^2/n).
/// Holds for few tries and for shares near 0 and 1, where the usual p -+ z s does not. Without a
/// try: no number, 0, 1. Source: E. B. Wilson, J. Am. Stat. Assoc. 22, 1927.
inline ShareInterval wilson(int hits, int of) {
  if (of <= 0) return {std::numeric_limits<double>::quiet_NaN(), 0, 1};
  constexpr double kZ = 1.959963984540054;  // 97.5 % of a normal distribution lie below
  const double n = of, p = hits / n, z2n = kZ * kZ / n;
  const double middle = (p + z2n / 2) / (1 + z2n),
               half = kZ * std::sqrt(p * (1 - p) / n + z2n / (4 * n)) / (1 + z2n);
  return {p, std::max(0.0, middle - half), std::min(1.0, middle + half)};
}

}  // namespace palpa::statistics
