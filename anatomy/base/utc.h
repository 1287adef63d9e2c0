#pragma once

#include <cstdint>
#include <string>

namespace palpa {

/// Seconds since 1970 of "2026-03-01T12:30:00Z"; 0 for a text that is no such time.
std::int64_t utcSecondsOf(const std::string& utc);
/// Days since 1970 (UTC) of "2026-03-01", with or without a time behind it; 0 for a text that is no
/// date.
std::int64_t utcDayOf(const std::string& utc);
/// "2026-03-01"
std::string isoDate(std::int64_t day);

std::string isoDuration(double seconds);  ///< "PT31.52S"
/// `ns` after a UTC time such as "2026-03-01T10:00:00Z", to the millisecond; empty where that is no
/// time.
std::string isoTimestamp(const std::string& utc, std::int64_t ns);

}  // namespace palpa
