#include "apps/assess/statistics/holm.h"

#include <algorithm>
#include <numeric>

#include "anatomy/geometry/error.h"

namespace palpa::statistics {

std::vector<double> holm(const std::vector<double>& p_values) {
  for (const double p : p_values)
    if (!(p >= 0 && p <= 1))
      throw Error("a p-value is not between 0 and 1", "Holm's correction", "Check the figures");
  std::vector<std::size_t> order(p_values.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(),
                   [&](std::size_t a, std::size_t b) { return p_values[a] < p_values[b]; });
  std::vector<double> adjusted(p_values.size());
  double before = 0;
  for (std::size_t i = 0; i < order.size(); ++i) {
    before =
        std::max(before, std::min(1.0, p_values[order[i]] * static_cast<double>(order.size() - i)));
    adjusted[order[i]] = before;
  }
  return adjusted;
}

}  // namespace palpa::statistics
