#pragma once

#include <vector>

namespace palpa::statistics {

/// Successes and failures of two groups:  a b / c d, a row a group.
struct FisherTest {
  double p_less = 1, p_greater = 1;  ///< one-tailed: the odds ratio is below, above 1
  double p_two_sided = 1;  ///< of all tables with these margins, those no likelier than this one
  double odds_ratio = 1;   ///< a d / (b c) of the sample; infinite or not a number where b c is 0
};

/// Exact. Source: Fisher 1935. Throws Error for a negative count and an empty table.
FisherTest fisherExact(int a, int b, int c, int d);

struct ChiSquareTest {
  double chi_square = 0, degrees = 0;
  double p = 1;
  double cramers_v = 0;  ///< 0: independent, 1: one tells the other
  double smallest_expected =
      0;  ///< below 5 the p-value is not to be trusted (Cochran 1954): use Fisher's
};

/// Whether rows and columns are independent; without Yates' correction. Source: Pearson 1900. Rows
/// and columns of zeros are left out. Throws Error for rows of unlike length, a negative count, and
/// fewer than two rows or columns that hold something.
ChiSquareTest chiSquare(const std::vector<std::vector<int>>& table);

}  // namespace palpa::statistics
