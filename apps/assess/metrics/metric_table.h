#pragma once

#include <span>
#include <string>
#include <string_view>

namespace palpa::metrics {

enum class Better { lower, higher, neither };

/// What a figure of a trial is. Names end with their unit and never change their meaning; what
/// means something else gets another name.
struct MetricDefinition {
  const char* name;   ///< "path_length_mm"
  const char* title;  ///< "Length of the tip's path"
  const char* unit;   ///< "mm"; "1": a plain number
  Better better;
  const char* tasks;  ///< "all", or the engines that have it: "needle, search"
  const char* definition;
  const char* valid;  ///< when it does not apply; "" where it always does
};

std::span<const MetricDefinition> metricTable();
bool belongsTo(const MetricDefinition& definition,
               std::string_view engine);                     ///< "needle", "palpation", ...
const MetricDefinition* metricNamed(std::string_view name);  ///< null: none has this name

/// A figure of a trial. Not a number: does not apply.
struct MetricValue {
  std::string name;
  double value = 0;
};

/// The table as Markdown: the generated documentation.
std::string metricsAsMarkdown();

}  // namespace palpa::metrics
