#include "apps/report/page/figure_words.h"

#include <cctype>
#include <cmath>

#include "apps/assess/metrics/metric_table.h"
#include "apps/assess/palpation/palpation_words.h"
#include "apps/report/page/page_parts.h"

namespace palpa::report {
namespace {

bool isShare(const std::string& metric) {
  return metric == "success" || metric == "first_pass_success" || metric == "chosen";
}

std::string amount(double value) { return trimmed(value, std::abs(value) >= 100 ? 0 : 1); }

}  // namespace

std::string titleOf(const std::string& metric) {
  const metrics::MetricDefinition* definition = metrics::metricNamed(metric);
  return definition ? definition->title : metric;
}

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
  if (unit == "%" && !isShare(metric) && std::isfinite(mean))
    return assess::percentWords(mean / 100);
  return (isShare(metric) ? fixed(std::floor(factor * mean + 1e-9), 0) : amount(factor * mean)) +
         (unit.empty() ? "" : " " + unit);
}

std::string fieldOf(const std::string& metric, double value) {
  if (isShare(metric) && std::isfinite(value)) return value == 1 ? "yes" : "no";
  return trimmed(value, std::abs(value) >= 100 ? 0 : 2);
}

}  // namespace palpa::report
