#include "anatomy/base/utc.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdio>

namespace palpa {
namespace {

using std::chrono::day;
using std::chrono::days;
using std::chrono::hours;
using std::chrono::milliseconds;
using std::chrono::minutes;
using std::chrono::month;
using std::chrono::seconds;
using std::chrono::sys_days;
using std::chrono::sys_seconds;
using std::chrono::year;
using std::chrono::year_month_day;

/// Digits at a place of a text; -1 where there is none.
int digits(const std::string& text, std::size_t at, std::size_t count) {
  int value = -1;
  if (at + count > text.size() || text.find_first_not_of("0123456789", at) < at + count) return -1;
  std::from_chars(text.data() + at, text.data() + at + count, value);
  return value;
}

/// "12:30:00"
template <class Duration>
std::string timeOfDay(const std::chrono::hh_mm_ss<Duration>& time) {
  char text[32];
  std::snprintf(text, sizeof text, "%02d:%02d:%02d", static_cast<int>(time.hours().count()),
                static_cast<int>(time.minutes().count()), static_cast<int>(time.seconds().count()));
  return text;
}

}  // namespace

std::optional<year_month_day> dateIn(const std::string& utc) {
  int y = 0;
  unsigned m = 0, d = 0;
  if (std::sscanf(utc.c_str(), "%4d-%2u-%2u", &y, &m, &d) != 3) return std::nullopt;
  const year_month_day date{year{y}, month{m}, day{d}};
  return date.ok() ? std::optional(date) : std::nullopt;
}

sys_days utcDayOf(const std::string& utc) {
  const std::optional<year_month_day> date = dateIn(utc);
  return date ? sys_days(*date) : sys_days();
}

sys_seconds utcSecondsOf(const std::string& utc) {
  int hour = 0, minute = 0, second = 0;
  if (utc.size() < 19 ||
      std::sscanf(utc.c_str() + 10, "T%2d:%2d:%2d", &hour, &minute, &second) != 3)
    return {};
  return utcDayOf(utc) + hours(hour) + minutes(minute) + seconds(second);
}

std::string isoDate(year_month_day date) {
  char text[32];
  std::snprintf(text, sizeof text, "%04d-%02u-%02u", static_cast<int>(date.year()),
                static_cast<unsigned>(date.month()), static_cast<unsigned>(date.day()));
  return text;
}

std::string isoTime(sys_seconds utc) {
  const sys_days midnight = std::chrono::floor<days>(utc);
  return isoDate(midnight).append(1, 'T').append(timeOfDay(std::chrono::hh_mm_ss(utc - midnight))) +
         'Z';
}

std::string isoDuration(double seconds) {
  const long long hundredths = std::llround(
      100 * std::max(0.0, seconds));  // more than a hundredth may be cut off (xAPI 1.0.3, 2.4.5)
  char text[48];
  std::snprintf(text, sizeof text, "PT%lld.%02lldS", hundredths / 100, hundredths % 100);
  return text;
}

std::string isoTimestamp(const std::string& utc, std::int64_t ns) {
  const year_month_day date{year(digits(utc, 0, 4)),
                            month(static_cast<unsigned>(digits(utc, 5, 2))),
                            day(static_cast<unsigned>(digits(utc, 8, 2)))};
  const int h = digits(utc, 11, 2), m = digits(utc, 14, 2), s = digits(utc, 17, 2);
  if (!date.ok() || h < 0 || m < 0 || s < 0 || utc.size() != 20 || utc.back() != 'Z') return "";
  const auto at =
      sys_days(date) + hours(h) + minutes(m) + seconds(s) + milliseconds(ns / 1'000'000);
  const auto whole = std::chrono::floor<seconds>(at);
  std::string text = isoTime(whole);
  char thousandths[16];
  std::snprintf(thousandths, sizeof thousandths, ".%03dZ", static_cast<int>((at - whole).count()));
  return text.replace(text.size() - 1, 1, thousandths);
}

}  // namespace palpa
