#include "apps/calibrate/result.h"

#include <cmath>
#include <cstdio>

namespace palpa::calibrate {

station::CalibrationFile begun(const Origin& origin, station::CalibrationKind kind,
                               int valid_days) {
  station::CalibrationFile file;
  file.kind = kind;
  file.station = origin.station;
  file.date = origin.date;
  file.made_by = origin.command;
  file.simulated = origin.simulated;
  file.valid_days = valid_days;
  file.data.source = origin.source;
  file.data.files = origin.files;
  return file;
}

std::string verdictOf(const std::vector<station::CalibrationFile::Check>& checks) {
  std::string words;
  for (const auto& check : checks) {
    if (check.passed()) continue;
    words += (words.empty() ? "" : "; ") + check.name + " is " + quantity(check.value, check.unit) +
             ", at most " + quantity(check.limit, check.unit) + " is good";
  }
  return words.empty() ? std::string(station::kPassed) : words;
}

std::string quantity(double value, const std::string& unit) {
  const double size = std::abs(value);
  char text[64];
  std::snprintf(text, sizeof text,
                size >= 100                ? "%.0f"
                : size >= 10               ? "%.1f"
                : size >= 0.1 || size == 0 ? "%.2f"
                                           : "%.3f",
                value);
  return text + (unit.empty() ? std::string() : " " + unit);
}

}  // namespace palpa::calibrate
