#include "apps/bench/metric.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

namespace palpa::bench {

void print(const std::string& metric, double value, const std::string& unit, const nlohmann::json& params) {
  nlohmann::ordered_json line;
  line["metric"] = metric;
  if (std::isfinite(value)) line["value"] = value; else line["value"] = nullptr;
  line["unit"] = unit;
  line["params"] = params;
  std::printf("%s\n", line.dump().c_str());
  std::fflush(stdout);
}

double quantile(std::vector<double> values, double q) {
  if (values.empty()) return 0;
  const auto rank = static_cast<std::size_t>(std::clamp(std::ceil(q * double(values.size())) - 1, 0.0, double(values.size() - 1)));
  std::nth_element(values.begin(), values.begin() + std::ptrdiff_t(rank), values.end());
  return values[rank];
}

}  // namespace palpa::bench
