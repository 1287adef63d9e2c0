#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

namespace palpa::bench {

/// One line of JSON: {"metric": ..., "value": ..., "unit": ..., "params": {...}}.
void print(const std::string& metric, double value, const std::string& unit, const nlohmann::json& params);

/// Value below which the share q of all lies; nearest rank. 0 for none.
double quantile(std::vector<double> values, double q);

}  // namespace palpa::bench
