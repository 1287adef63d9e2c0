#pragma once

#include <vector>

namespace palpa::runtime {

/// Value below which the share q of all lies; nearest rank. 0 for none.
double quantile(std::vector<double> values, double q);

}  // namespace palpa::runtime
