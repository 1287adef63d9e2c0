#include "apps/bench/metric.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

namespace palpa::bench {

void print(const std::string& metric, double value, const std::string& unit,
           const nlohmann::json& params) {
  nlohmann::ordered_json line;
  line["metric"] = metric;
  if (std::isfinite(value))
    line["value"] = value;
  else
    line["value"] = nullptr;
  line["unit"] = unit;
  line["params"] = params;
  std::printf("%s\n", line.dump().c_str());
  std::fflush(stdout);
}

}  // namespace palpa::bench
