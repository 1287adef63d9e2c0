#include "anatomy/base/utc.h"

#include <algorithm>
#include <charconv>
#include <chrono>
#include <cmath>
#include <cstdio>

namespace palpa {
namespace {

using std::chrono::day;
using std::chrono::month;
using std::chrono::sys_days;
using std::chrono::year;
using std::chrono::year_month_day;

/// Digits at a place of a text; -1 where there is none.
int digits(const std::string& text, std::size_t at, std::size_t count) {
  int value = -1;
  if (at + count > text.size() || text.find_first_not_of("0123456789", at) < at + count) return -1;
  std::from_chars(text.data() + at, text.data() + at + count, value);
  return value;
}

}  // namespace

std::int64_t utcDayOf(const std::string& utc) {
  int y = 0;
  unsigned m = 0, d = 0;
  if (std::sscanf(utc.c_str(), "%4d-%2u-%2u", &y, &m, &d) != 3) return 0;
  const year_month_day date{year{y}, month{m}, day{d}};
  return date.ok() ? sys_days(date).time_since_epoch().count() : 0;
}

std::int64_t utcSecondsOf(const std::string& utc) {
  constexpr std::int64_t kDay_s = 24 * 3600;
  int hour = 0, minute = 0, second = 0;
  if (utc.size() < 19 ||
      std::sscanf(utc.c_str() + 10, "T%2d:%2d:%2d", &hour, &minute, &second) != 3)
    return 0;
  return utcDayOf(utc) * kDay_s + 3600 * hour + 60 * minute + second;
}

std::string isoDate(std::int64_t days) {
  const year_month_day date{sys_days(std::chrono::days(days))};
  char text[32];
  std::snprintf(text, sizeof text, "%04d-%02u-%02u", static_cast<int>(date.year()),
                static_cast<unsigned>(date.month()), static_cast<unsigned>(date.day()));
  return text;
}

std::string isoDuration(double seconds) {
  const long long hundredths = std::llround(
      100 * std::max(0.0, seconds));  // more than a hundredth may be cut off (xAPI 1.0.3, 2.4.5)
  char text[48];
  std::snprintf(text, sizeof text, "PT%lld.%02lldS", hundredths / 100, hundredths % 100);
  return text;
}

std::string isoTimestamp(const std::string& utc, std::int64_t ns) {
  using namespace std::chrono;
  const year_month_day date{year(digits(utc, 0, 4)),
                            month(static_cast<unsigned>(digits(utc, 5, 2))),
                            day(static_cast<unsigned>(digits(utc, 8, 2)))};
  const int h = digits(utc, 11, 2), m = digits(utc, 14, 2), s = digits(utc, 17, 2);
  if (!date.ok() || h < 0 || m < 0 || s < 0 || utc.size() != 20 || utc.back() != 'Z') return "";
  const auto at =
      sys_days(date) + hours(h) + minutes(m) + seconds(s) + milliseconds(ns / 1'000'000);
  const auto midnight = floor<days>(at);
  const hh_mm_ss time(duration_cast<milliseconds>(at - midnight));
  char text[32];
  std::snprintf(text, sizeof text, "T%02d:%02d:%02d.%03dZ", static_cast<int>(time.hours().count()),
                static_cast<int>(time.minutes().count()), static_cast<int>(time.seconds().count()),
                static_cast<int>(time.subseconds().count()));
  return isoDate(midnight.time_since_epoch().count()) + text;
}

}  // namespace palpa
