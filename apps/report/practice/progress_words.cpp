#include "apps/report/practice/progress_words.h"

#include <cctype>
#include <cmath>

#include "apps/report/page/page_parts.h"

namespace palpa::report {
namespace {

bool isShare(const std::string& metric) {
  return metric == "success" || metric == "first_pass_success" || metric == "chosen";
}

std::string amount(double value) { return trimmed(value, std::abs(value) >= 100 ? 0 : 1); }

/// "12 s to 30 s less", "−3 s to 8 s" where the sign is open.
std::string differenceRange(const progress::Change& c) {
  if (c.verdict == progress::Change::ChangeVerdict::unclear)
    return figureOf(c.metric, c.low) + " to " + figureOf(c.metric, c.high);
  const double one = std::abs(c.low), other = std::abs(c.high);
  return figureOf(c.metric, std::min(one, other)) + " to " +
         figureOf(c.metric, std::max(one, other));
}

}  // namespace

std::string titleWithin(const std::string& metric) {
  const metrics::MetricDefinition* definition = metrics::metricNamed(metric);
  if (!definition) return metric;
  if (metric == "econ_var_mm2")
    return "variance of the distance from the taught line";  // its title leans on the one before it
  std::string title = definition->title;
  title[0] = static_cast<char>(std::tolower(static_cast<unsigned char>(title[0])));
  return title;
}

std::pair<double, std::string> scaleOf(const std::string& metric) {
  if (isShare(metric)) return {100, "%"};
  if (metric == "total") return {1, "points"};
  const metrics::MetricDefinition* definition = metrics::metricNamed(metric);
  const std::string unit = definition ? definition->unit : "";
  return {1, unit == "1" ? "" : unit == "mm2" ? "mm²" : unit == "mm3" ? "mm³" : unit};
}

std::string figureOf(const std::string& metric, double mean) {
  const auto [factor, unit] = scaleOf(metric);
  return (isShare(metric) ? fixed(factor * mean, 0) : amount(factor * mean)) +
         (unit.empty() ? "" : " " + unit);
}

std::string fieldOf(const std::string& metric, double value) {
  if (isShare(metric) && std::isfinite(value)) return value == 1 ? "yes" : "no";
  return trimmed(value, std::abs(value) >= 100 ? 0 : 2);
}

std::string intervalWords(const std::string& metric,
                          const std::optional<std::pair<double, double>>& interval) {
  if (!interval) return "";
  return " (95 % interval " + figureOf(metric, interval->first) + " to " +
         figureOf(metric, interval->second) + ")";
}

std::string changeWords(const progress::Change& c) {
  const std::string means = titleWithin(c.metric) + ", from " + figureOf(c.metric, c.first) +
                            " to " + figureOf(c.metric, c.last) +
                            " (means of the first and the last " + std::to_string(c.each) +
                            " trials)";
  if (c.verdict == progress::Change::ChangeVerdict::unclear)
    return means + "; the difference's 95 % interval is " + differenceRange(c);
  return means + ", " + figureOf(c.metric, std::abs(c.difference)) +
         (c.difference < 0 ? " less" : " more") + " (95 % interval " + differenceRange(c) + ')';
}

}  // namespace palpa::report
