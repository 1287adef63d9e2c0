#include <charconv>
#include <chrono>
#include <cmath>
#include <cstdio>

#include "apps/link/statement.h"

namespace palpa::link {
namespace {

/// Digits at a place of a text; -1 where there are none.
int digits(const std::string& text, std::size_t at, std::size_t count) {
  int value = -1;
  if (at + count > text.size() || text.find_first_not_of("0123456789", at) < at + count) return -1;
  std::from_chars(text.data() + at, text.data() + at + count, value);
  return value;
}

}  // namespace

std::string isoDuration(double seconds) {
  const long long hundredths = std::llround(
      100 * std::max(0.0, seconds));  // more than a hundredth may be cut off (xAPI 1.0.3, 2.4.5)
  char text[48];
  std::snprintf(text, sizeof text, "PT%lld.%02lldS", hundredths / 100, hundredths % 100);
  return text;
}

std::string isoTimestamp(const std::string& utc, std::int64_t ns) {
  using namespace std::chrono;
  const year_month_day day{year(digits(utc, 0, 4)), month(static_cast<unsigned>(digits(utc, 5, 2))),
                           std::chrono::day(static_cast<unsigned>(digits(utc, 8, 2)))};
  const int h = digits(utc, 11, 2), m = digits(utc, 14, 2), s = digits(utc, 17, 2);
  if (!day.ok() || h < 0 || m < 0 || s < 0 || utc.size() != 20 || utc.back() != 'Z') return "";
  const auto at = sys_days(day) + hours(h) + minutes(m) + seconds(s) + milliseconds(ns / 1'000'000);
  const auto midnight = floor<days>(at);
  const year_month_day date(midnight);
  const hh_mm_ss time(duration_cast<milliseconds>(at - midnight));
  char text[64];
  std::snprintf(text, sizeof text, "%04d-%02u-%02uT%02d:%02d:%02d.%03dZ",
                static_cast<int>(date.year()), static_cast<unsigned>(date.month()),
                static_cast<unsigned>(date.day()), static_cast<int>(time.hours().count()),
                static_cast<int>(time.minutes().count()), static_cast<int>(time.seconds().count()),
                static_cast<int>(time.subseconds().count()));
  return text;
}

}  // namespace palpa::link
