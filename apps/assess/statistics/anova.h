#pragma once

#include <vector>

namespace palpa::statistics {

/// One-way analysis of variance of independent groups. Source: Fisher 1925; omega squared: Hays
/// 1963.
struct Anova {
  double f = 0, degrees_between = 0, degrees_within = 0;
  double p = 1;
  double squares_between = 0, squares_within = 0;
  double eta_squared = 0;  ///< share of all squares that lies between groups
  double omega_squared =
      0;  ///< the same without its bias, (SSB - dfB MSW) / (SST + MSW); can be below 0
};

/// Throws Error for fewer than two groups, an empty one, no value to spare, and where nothing
/// varies within groups.
Anova oneWayAnova(const std::vector<std::vector<double>>& groups);

/// Share of Fisher's F(d1, d2) above f. Throws Error for degrees that are not positive or f below
/// 0.
double fTail(double f, double d1, double d2);

}  // namespace palpa::statistics
