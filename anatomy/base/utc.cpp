#include "anatomy/base/utc.h"

#include <chrono>
#include <cstdio>

namespace palpa::study {

using std::chrono::day;
using std::chrono::month;
using std::chrono::sys_days;
using std::chrono::year;
using std::chrono::year_month_day;

std::int64_t dayOf(const std::string& utc) {
  int y = 0;
  unsigned m = 0, d = 0;
  if (std::sscanf(utc.c_str(), "%4d-%2u-%2u", &y, &m, &d) != 3) return 0;
  const year_month_day date{year{y}, month{m}, day{d}};
  return date.ok() ? sys_days(date).time_since_epoch().count() : 0;
}

std::int64_t secondsOf(const std::string& utc) {
  constexpr std::int64_t kDay_s = 24 * 3600;
  int hour = 0, minute = 0, second = 0;
  if (utc.size() < 19 ||
      std::sscanf(utc.c_str() + 10, "T%2d:%2d:%2d", &hour, &minute, &second) != 3)
    return 0;
  return dayOf(utc) * kDay_s + 3600 * hour + 60 * minute + second;
}

std::string dateText(std::int64_t days) {
  const year_month_day date{sys_days(std::chrono::days(days))};
  char text[32];
  std::snprintf(text, sizeof text, "%04d-%02u-%02u", static_cast<int>(date.year()),
                static_cast<unsigned>(date.month()), static_cast<unsigned>(date.day()));
  return text;
}

}  // namespace palpa::study
