#pragma once

#include <cstdint>
#include <string>

namespace palpa::study {

/// Seconds since 1970 of "2026-03-01T12:30:00Z"; of a text that is none: 0.
std::int64_t secondsOf(const std::string& utc);
/// Days since 1970 (UTC) of "2026-03-01", with or without a time behind it; of a text that is none:
/// 0.
std::int64_t dayOf(const std::string& utc);
/// "2026-03-01"
std::string dateText(std::int64_t day);

}  // namespace palpa::study
