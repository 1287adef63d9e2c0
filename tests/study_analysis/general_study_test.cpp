#include <gtest/gtest.h>

#include "anatomy/base/error.h"
#include "apps/assess/statistics/tests_of_means.h"
#include "apps/study/analysis/study_design.h"
#include "rows.h"

namespace palpa::study_analysis {
namespace {

using test::at;
using test::exhibit;

/// Two groups of three; each subject does two trials in both conditions.
std::vector<StudyRow> crossed() {
  std::vector<StudyRow> rows;
  const std::vector<std::vector<double>> off{{1, 3}, {4, 4}, {6, 8}, {10, 12}, {15, 15}, {13, 15}},
      on{{1, 1}, {2, 4}, {6, 6}, {9, 9}, {12, 14}, {10, 12}};
  for (std::size_t s = 0; s < 6; ++s)
    for (std::size_t t = 0; t < 2; ++t) {
      rows.push_back(test::row("S" + std::to_string(s), s < 3 ? "a" : "b", "off", "x",
                               static_cast<int>(t) + 1, {{"time_s", off[s][t]}, {"constant", 4}}));
      rows.push_back(test::row("S" + std::to_string(s), s < 3 ? "a" : "b", "on", "y",
                               static_cast<int>(t) + 1, {{"time_s", on[s][t]}, {"constant", 4}}));
    }
  orderAndNumber(rows, "crossed");
  return rows;
}

TEST(GeneralStudy, GroupsByWelchConditionsOfTheSameSubjectsAsPairs) {
  StudyDesign design;
  const StudyResult result = analyseStudy(crossed(), design);
  const Exhibit& cells = exhibit(result, "by_group_and_condition");
  ASSERT_EQ(cells.table.rows.size(), 4u) << "what never varies is not analysed";
  EXPECT_NEAR(at(cells, 0, "mean"), 13.0 / 3, 1e-12);
  const Exhibit& tests = exhibit(result, "comparisons");
  ASSERT_EQ(tests.table.rows.size(), 4u);
  EXPECT_NEAR(at(tests, 0, "p"), statistics::welch({11, 15, 14}, {2, 4, 7}).p_two_sided, 1e-12);
  EXPECT_NEAR(at(tests, 3, "p"), statistics::paired({9, 13, 11}, {11, 15, 14}).p_two_sided, 1e-12);
  EXPECT_EQ(at(tests, 3, "df"), 2);
  EXPECT_NEAR(at(tests, 3, "difference"), -7.0 / 3, 1e-12);
}

TEST(GeneralStudy, FiguresAskedForHaveASecondLookOrAreRefused) {
  StudyDesign design;
  design.metrics = {"time_s"};
  EXPECT_EQ(exhibit(analyseStudy(crossed(), design), "mixed_model_time_s").table.rows.size(), 7u);
  design.metrics = {"nothing"};
  EXPECT_THROW(analyseStudy(crossed(), design), UsageError);
}

TEST(GeneralStudy, KindsAreKnownByName) {
  EXPECT_EQ(studyKindNamed("", "x"), StudyKind::general);
  EXPECT_EQ(studyKindNamed("paracentesis pilot", "x"), StudyKind::paracentesis_pilot);
  EXPECT_EQ(studyKindNamed("search study", "x"), StudyKind::search_study);
  EXPECT_THROW(studyKindNamed("pilot", "x"), UsageError);
}

}  // namespace
}  // namespace palpa::study_analysis
