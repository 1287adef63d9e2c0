#pragma once

#include <nlohmann/json.hpp>
#include <string>

namespace palpa::bench {

/// One line of JSON: {"metric": ..., "value": ..., "unit": ..., "params": {...}}.
void print(const std::string& metric, double value, const std::string& unit,
           const nlohmann::json& params);

}  // namespace palpa::bench
