#include <gtest/gtest.h>

#include <filesystem>

#include "apps/assess/metrics/metric_table.h"
#include "tests/support/files.h"

namespace palpa::metrics {
namespace {

/// A figure that no test of a hand-made trial names has no known answer.
TEST(MetricTable, EveryFigureIsNamedInATestOfAssessment) {
  std::string tests;
  for (const char* folder : {"assess", "competence", "palpation_score", "pulse_score",
                             "search_score", "comparison_score"})
    for (const auto& entry : std::filesystem::directory_iterator(
             std::filesystem::path(PALPA_SOURCE_DIR) / "tests" / folder))
      if (entry.path().extension() == ".cpp" && entry.path().filename() != "every_metric_test.cpp")
        tests += test::slurp(entry.path());
  for (const MetricDefinition& d : metricTable())
    EXPECT_NE(tests.find('"' + std::string(d.name) + '"'), std::string::npos) << d.name;
}

}  // namespace
}  // namespace palpa::metrics
