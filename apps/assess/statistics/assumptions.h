#pragma once

#include <string>
#include <vector>

namespace palpa::statistics {

/// Whether values may come from a normal distribution: W is 1 for a straight normal plot; p small:
/// they do not. Source: Shapiro and Wilk 1965, p after Royston, Appl. Stat. 44, 1995 (AS R94).
/// Throws Error for fewer than 3 or more than 5000 values and where nothing varies.
struct NormalityTest {
  double w = 1, p = 1;
};
NormalityTest shapiroWilk(const std::vector<double>& values);

/// Whether groups vary alike: analysis of variance of the distances from each group's median; p
/// small: they do not. Source: Brown and Forsythe 1974. Throws Error as oneWayAnova does.
double spreadDiffers(const std::vector<std::vector<double>>& groups);

/// What speaks against tests of means on these groups, a sentence each for a reader who is no
/// statistician; empty: nothing does. Looks at size (fewer than 5), shape (p below 0.05) and spread
/// (p below 0.05). `names`: of the groups, in words. Never throws for groups that are too small:
/// says so.
std::vector<std::string> concernsAbout(const std::vector<std::vector<double>>& groups,
                                       const std::vector<std::string>& names);

/// P-values of tests made together, so adjusted that the chance of any false alarm stays at the
/// level that each is held against: the i-th smallest of m times m - i + 1, never below one before
/// it, at most 1. In the order given. Source: Holm, Scand. J. Stat. 6, 1979. Throws Error for a
/// value outside [0, 1].
std::vector<double> holm(const std::vector<double>& p_values);

}  // namespace palpa::statistics
