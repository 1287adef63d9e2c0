#pragma once

#include <vector>

namespace palpa::statistics {

/// P-values of tests made together, so adjusted that the chance of any false alarm stays at the
/// level that each is held against: the i-th smallest of m times m - i + 1, never below one before
/// it, at most 1. In the order given. Source: Holm, Scand. J. Stat. 6, 1979. Throws Error for a
/// value outside [0, 1].
std::vector<double> holm(const std::vector<double>& p_values);

}  // namespace palpa::statistics
