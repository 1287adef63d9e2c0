#pragma once

#include <cstdint>
#include <vector>

namespace palpa::bench {

/// Two things measured in turn, so that a machine that warms up or slows down meets both alike.
enum class Turn { a, b };

/// A B B A, `blocks` times: within a block a steady drift adds the same to both.
std::vector<Turn> abbaOrder(int blocks);

/// Middle value, the mean of the two in the middle of an even number; NaN for none.
double median(std::vector<double> values);

struct Interval {
  double low = 0, high = 0;
};
/// 95 % interval of the median by the percentile bootstrap (Efron 1979): `resamples` times as many
/// draws with replacement as there are values; the 2.5 % and 97.5 % quantiles of their medians.
/// Same seed, same interval; NaN for no values.
Interval bootstrapMedian(const std::vector<double>& values, int resamples, std::uint64_t seed);

}  // namespace palpa::bench
