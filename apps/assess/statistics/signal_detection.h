#pragma once

#include <limits>

namespace palpa::statistics {

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
