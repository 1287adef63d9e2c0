#pragma once

#include <chrono>
#include <cstdint>
#include <optional>
#include <string>

namespace palpa {

/// The date of "2026-03-01", with or without a time behind it; nothing for a text that is no date
/// of the calendar.
std::optional<std::chrono::year_month_day> dateIn(const std::string& utc);
/// The same as days since 1970 (UTC); 1970-01-01 for a text that is no date.
std::chrono::sys_days utcDayOf(const std::string& utc);
/// Of "2026-03-01T12:30:00Z"; the start of 1970 for a text that is no such time.
std::chrono::sys_seconds utcSecondsOf(const std::string& utc);

std::string isoDate(std::chrono::year_month_day date);  ///< "2026-03-01"
std::string isoTime(std::chrono::sys_seconds utc);      ///< "2026-03-01T12:30:00Z"
std::string isoDuration(double seconds);                ///< "PT31.52S"
/// `ns` after a UTC time such as "2026-03-01T10:00:00Z", to the millisecond; empty where that is no
/// time.
std::string isoTimestamp(const std::string& utc, std::int64_t ns);

}  // namespace palpa
