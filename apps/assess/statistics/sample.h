#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <string>
#include <vector>

namespace palpa::statistics {

/// What tests of means need of a sample; may come from a publication.
struct Moments {
  double mean = 0, sd = 0;  ///< sd with n - 1
  double n = 0;
};

/// Throws Error, naming `where`, for fewer than two values or one that is not finite.
Moments momentsOf(const std::vector<double>& values, const std::string& where = "statistics");

double meanOf(const std::vector<double>& values);  ///< not a number for none

/// The share q of the values lies below: linear between the two nearest (type 7 of Hyndman and Fan
/// 1996). Not a number for none.
double interpolatedQuantile(std::vector<double> values, double q);

struct Description {
  std::size_t n = 0;
  double mean = 0, sd = 0;  ///< sd: not a number for fewer than two
  double median = 0, q1 = 0, q3 = 0, min = 0, max = 0;
};

/// All not a number but n for no value. Throws Error for a value that is not finite.
Description describe(const std::vector<double>& values);

/// Ranks from 1, equal values share the mean of theirs. `ties`: sum of t^3 - t over groups of t
/// equal values.
struct Ranks {
  std::vector<double> of;
  double ties = 0;
};
Ranks ranksOf(const std::vector<double>& values);

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

/// What somebody says of things of two kinds: how many of the signals were called so (hits), how
/// many of the rest as well (alarms).
struct Detections {
  int hits = 0, signals = 0, alarms = 0, rest = 0;
};

/// How well the two kinds are told apart, and which way doubt is settled.
struct Discrimination {
  double d = std::numeric_limits<double>::quiet_NaN();          ///< d', 0: not at all
  double criterion = std::numeric_limits<double>::quiet_NaN();  ///< c, below 0: too readily called
};

/// With H = (hits + 1/2) / (signals + 1), F = (alarms + 1/2) / (rest + 1), z the normal quantile:
///   d' = z(H) - z(F),  c = -(z(H) + z(F)) / 2.
/// The halves (log-linear rule) keep both finite where all or none were called. Not a number where
/// there was no signal, or nothing else. Source: M. J. Hautus, Behav. Res. Methods 27, 1995.
Discrimination discriminationOf(const Detections& seen);

}  // namespace palpa::statistics
