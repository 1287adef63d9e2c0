#pragma once

#include <vector>

namespace palpa::statistics {

/// A test on ranks: for values far from normal, and few of them. Exact for samples below 50 without
/// ties; otherwise by the normal distribution, corrected for ties and continuity.
struct RankTest {
  double statistic = 0;  ///< U of the first sample; sum of the ranks of positive differences
  bool exact = false;
  double p_less = 1;  ///< one-tailed: a tends to be smaller
  double p_greater = 1;
  double p_two_sided = 1;
  double effect =
      0;  ///< rank-biserial correlation, -1 to 1; positive: a tends to be larger (Kerby 2014)
};

/// Two independent samples. Source: Mann and Whitney 1947. Throws Error for an empty sample.
RankTest mannWhitney(const std::vector<double>& a, const std::vector<double>& b);

/// Pairs; those without a difference are left out. Source: Wilcoxon 1945. Throws Error for samples
/// of unlike size and where no pair differs.
RankTest wilcoxon(const std::vector<double>& a, const std::vector<double>& b);

}  // namespace palpa::statistics
