#include "anatomy/base/quantile.h"

#include <algorithm>
#include <cmath>

namespace palpa::runtime {

double quantile(std::vector<double> values, double q) {
  if (values.empty()) return 0;
  const double count = static_cast<double>(values.size());
  const auto rank =
      static_cast<std::ptrdiff_t>(std::clamp(std::ceil(q * count) - 1, 0.0, count - 1));
  std::nth_element(values.begin(), values.begin() + rank, values.end());
  return values[static_cast<std::size_t>(rank)];
}

}  // namespace palpa::runtime
