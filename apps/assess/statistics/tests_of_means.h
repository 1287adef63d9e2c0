#pragma once

#include <vector>

#include "apps/assess/statistics/sample.h"

namespace palpa::statistics {

/// A test of means with Student's t. `difference` = mean a - mean b in the values' unit.
struct TTest {
  double mean_a = 0, mean_b = 0;
  double difference = 0;
  double low = 0, high = 0;  ///< 95 % interval of the difference
  double t = 0, degrees = 0;
  double p_less = 1;     ///< one-tailed: a is smaller than b
  double p_greater = 1;  ///< one-tailed: a is larger than b
  double p_two_sided = 1;
  /// Size of the effect: difference / standard deviation x (1 - 3 / (4 df - 1)), Hedges 1981; the
  /// standard deviation pooled over both samples, for pairs that of their differences.
  double effect = 0;
};

/// Two independent samples of unequal variance: t = (m_a - m_b) / sqrt(s_a^2/n_a + s_b^2/n_b),
/// degrees after Welch and Satterthwaite. Source: Welch, Biometrika 34, 1947. All of these throw
/// Error for fewer than two values in a sample and where nothing varies.
TTest welchFromMoments(const Moments& a, const Moments& b);
TTest welch(const std::vector<double>& a, const std::vector<double>& b);

/// Two independent samples of one variance: pooled, n_a + n_b - 2 degrees. Source: Student,
/// Biometrika 6, 1908.
TTest pooledFromMoments(const Moments& a, const Moments& b);
TTest pooled(const std::vector<double>& a, const std::vector<double>& b);

/// The same subjects twice: of a_i - b_i, n - 1 degrees. Throws Error for samples of unlike size.
TTest paired(const std::vector<double>& a, const std::vector<double>& b);

/// Whether the mean of a_i - b_i lies between -margin and margin: two one-sided t-tests, n - 1
/// degrees. Source: Schuirmann, J. Pharmacokinet. Biopharm. 15, 1987. Pairs whose differences do
/// not vary are judged by their one difference.
struct Equivalence {
  double difference = 0;     ///< mean of a - b
  double sd = 0;             ///< of the differences
  double low = 0, high = 0;  ///< 90 % interval: within the margin exactly where p < 0.05
  double p = 1;              ///< the larger one of the two tests': small where they are equivalent
};
/// Throws Error for samples of unlike size, fewer than two pairs and a margin that is not positive.
Equivalence equivalenceOfPairs(const std::vector<double>& a, const std::vector<double>& b,
                               double margin);

/// One-way analysis of variance of independent groups. Source: Fisher 1925; omega squared: Hays
/// 1963.
struct Anova {
  double f = 0, degrees_between = 0, degrees_within = 0;
  double p = 1;
  double squares_between = 0, squares_within = 0;
  double eta_squared = 0;  ///< share of all squares that lies between groups
  /// the same without its bias, (SSB - dfB MSW) / (SST + MSW); can be below 0
  double omega_squared = 0;
};

/// Throws Error for fewer than two groups, an empty one, no value to spare, and where nothing
/// varies within groups.
Anova oneWayAnova(const std::vector<std::vector<double>>& groups);

/// Share of Fisher's F(d1, d2) above f. Throws Error for degrees that are not positive or f below
/// 0.
double fTail(double f, double d1, double d2);

}  // namespace palpa::statistics
