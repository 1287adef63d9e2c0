#pragma once

#include <vector>

namespace palpa {

/// Value below which the share q of all lies; nearest rank. 0 for none.
double quantile(std::vector<double> values, double q);

/// Mean of the two middle values of an even count; NaN for none.
double median(std::vector<double> values);

/// The upper of the two middle values of an even count: always one of the values. 0 for none.
double upperMedian(std::vector<double> values);

}  // namespace palpa
