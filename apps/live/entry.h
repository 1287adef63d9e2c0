#pragma once

#include <cstdint>
#include <nlohmann/json.hpp>
#include <string>

namespace palpa::live {

/// An entry of the log as it is told; what is no UTF-8 is replaced, so that it can be read.
inline std::string entryOf(const nlohmann::json& entry) {
  return entry.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
}

/// Session time, to the millisecond.
inline double secondsOf(std::int64_t ns) { return static_cast<double>(ns / 1'000'000) * 1e-3; }

}  // namespace palpa::live
