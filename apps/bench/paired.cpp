#include "apps/bench/paired.h"

#include <algorithm>
#include <limits>

#include "apps/runtime/quantile.h"
#include "apps/runtime/random.h"

namespace palpa::bench {

std::vector<Turn> abbaOrder(int blocks) {
  std::vector<Turn> order;
  for (int i = 0; i < blocks; ++i) order.insert(order.end(), {Turn::a, Turn::b, Turn::b, Turn::a});
  return order;
}

double median(std::vector<double> values) {
  if (values.empty()) return std::numeric_limits<double>::quiet_NaN();
  std::sort(values.begin(), values.end());
  const std::size_t half = values.size() / 2;
  return values.size() % 2 ? values[half] : 0.5 * (values[half - 1] + values[half]);
}

Interval bootstrapMedian(const std::vector<double>& values, int resamples, std::uint64_t seed) {
  if (values.empty()) return {median({}), median({})};
  runtime::RandomStream random(seed, "bench.bootstrap");
  std::vector<double> medians, drawn(values.size());
  for (int i = 0; i < resamples; ++i) {
    for (double& value : drawn)
      value =
          values[static_cast<std::size_t>(random.uniform() * static_cast<double>(values.size()))];
    medians.push_back(median(drawn));
  }
  return {runtime::quantile(medians, 0.025), runtime::quantile(medians, 0.975)};
}

}  // namespace palpa::bench
