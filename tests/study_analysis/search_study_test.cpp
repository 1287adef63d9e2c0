// The search study of Edmunds and Pai: printed F values from data made to have them, and four
// subjects by hand.
#include <gtest/gtest.h>

#include <array>
#include <cmath>

#include "anatomy/base/error.h"
#include "apps/study/analysis/search_study.h"
#include "rows.h"

namespace palpa::study_analysis {
namespace {

using test::at;
using test::exhibit;

StudyDesign searchDesign() {
  StudyDesign design;
  design.kind = StudyKind::search_study;
  design.title = "Search";
  design.conditions = {"full", "degraded", "augmented"};
  return design;
}

/// One subject with `trials` in each block, all alike.
void addSubject(std::vector<StudyRow>& rows, const std::string& subject,
                const std::string& training, const std::array<double, 3>& success,
                const std::array<double, 3>& seconds, int trials = 4) {
  const std::array<std::string, 3> blocks{"baseline", "training", "evaluation"};
  for (std::size_t b = 0; b < 3; ++b)
    for (int t = 1; t <= trials; ++t) {
      StudyRow row =
          test::row(subject, "trainee", b == 1 ? training : "full", blocks[b], t,
                    {{"success", success[b]}, {"time_s", seconds[b] + (b == 1 ? t : 0)}});
      row.session = b == 0 ? 1 : 2;
      rows.push_back(row);
    }
}

/// Values of two groups, 10 and 11, whose means are given and whose spread makes F.
std::pair<std::vector<double>, std::vector<double>> groupsWith(double f, double mean_a,
                                                               double mean_b) {
  const double between = 10.0 * 11 / 21 * (mean_a - mean_b) * (mean_a - mean_b),
               sd = std::sqrt(between / f);
  return {test::valuesWith(mean_a, sd, 10), test::valuesWith(mean_b, sd, 11)};
}

TEST(SearchStudy, TwentyOneSubjectsGiveThePrintedAnovas) {
  const auto [success_a, success_b] = groupsWith(1.41, 0.05, 0.11);  // the printed improvements
  const auto [time_a, time_b] = groupsWith(0.03, 0.20, 0.21);
  std::vector<StudyRow> rows;
  for (std::size_t i = 0; i < 21; ++i) {
    const bool augmented = i >= 10;
    const double up = augmented ? success_b[i - 10] : success_a[i],
                 down = augmented ? time_b[i - 10] : time_a[i];
    addSubject(rows, "S" + std::to_string(i), augmented ? "augmented" : "degraded",
               {0.5, 0.5, 0.5 + up}, {40, 50, 40 * (1 - down)});
  }
  orderAndNumber(rows, "printed");
  const Exhibit anova = exhibit(analyseStudy(rows, searchDesign()), "anova");
  EXPECT_NEAR(at(anova, 0, "f"), 1.41, 1e-9);
  EXPECT_EQ(at(anova, 0, "df_within"), 19);
  EXPECT_NEAR(at(anova, 0, "p"), 0.250, 0.0005);
  EXPECT_NEAR(at(anova, 1, "f"), 0.03, 1e-9);
  EXPECT_NEAR(at(anova, 1, "p"), 0.864, 0.0005);
  EXPECT_NEAR(at(anova, 0, "mean_1"), 0.05, 1e-12);
  EXPECT_NEAR(at(anova, 0, "mean_2"), 0.11, 1e-12);
  EXPECT_NEAR(at(anova, 0, "eta_squared"), 1.41 / (1.41 + 19), 1e-9);
}

/// Improvements 0, .2, .2, .4: SD over all .1633; decreases .5, 0, .25, .25: SD .2041.
std::vector<StudyRow> fourSubjects() {
  std::vector<StudyRow> rows;
  addSubject(rows, "A", "degraded", {0.5, 0.5, 0.5}, {20, 30, 10});
  addSubject(rows, "B", "degraded", {0.5, 0.5, 0.7}, {20, 30, 20});
  addSubject(rows, "C", "augmented", {0.5, 0.5, 0.7}, {20, 30, 15});
  addSubject(rows, "D", "augmented", {0.5, 0.5, 0.9}, {40, 60, 30});
  orderAndNumber(rows, "hand");
  return rows;
}

TEST(SearchStudy, ImprovementsAreScaledByTheSpreadOfAllSubjects) {
  const SearchStudy study = searchStudyOf(fourSubjects(), searchDesign());
  ASSERT_EQ(study.subjects.size(), 4u);
  EXPECT_EQ(study.trainings, (std::vector<std::string>{"degraded", "augmented"}));
  const double up = std::sqrt(0.08 / 3), down = std::sqrt(0.125 / 3);
  EXPECT_NEAR(study.subjects[3].improvement_sd, 0.4 / up, 1e-12);
  EXPECT_NEAR(study.subjects[0].decrease_sd, 0.5 / down, 1e-12);
  EXPECT_NEAR(study.subjects[2].sum(), 0.2 / up + 0.25 / down, 1e-12);
  EXPECT_NEAR(study.subjects[2].largest(), 0.25 / down, 1e-12);
  // success: groups {0, .2} and {.2, .4}: between .04, within .02 + .02 with 2 degrees
  EXPECT_NEAR(study.anovas[0].anova->f, 2, 1e-9);
  EXPECT_NEAR(study.anovas[0].anova->p, 0.29289,
              5e-6);  // 1 - sqrt(F / (F + 2)) for 1 and 2 degrees
}

TEST(SearchStudy, FiguresShowWhatTheyClaim) {
  const StudyResult result = analyseStudy(fourSubjects(), searchDesign());
  const Exhibit& before_after = exhibit(result, "figure_6");
  ASSERT_EQ(before_after.plots[0].series.size(), 4u);
  EXPECT_NEAR(at(before_after, 3, "evaluation"), 90, 1e-9);
  EXPECT_EQ(before_after.plots[0].series[3].family, 1);
  EXPECT_NEAR(at(exhibit(result, "figure_7"), 0, "change"), -10, 1e-9);
  const Exhibit& durations = exhibit(
      result,
      "figure_9");  // the second kind of training; of C and D, as near the median, the first
  EXPECT_NE(durations.caption.find("subject C"), std::string::npos);
  ASSERT_EQ(durations.table.rows.size(), 3u);
  EXPECT_NEAR(at(durations, 1, "mean_s"), 32.5, 1e-12);
  EXPECT_EQ(at(durations, 1, "from_trial"), 5);
  ASSERT_EQ(durations.plots[0].dividers.size(), 3u);
  EXPECT_EQ(durations.plots[0].dividers[2].x, 8.5);
  EXPECT_NE(exhibit(result, "figure_10").title.find("degraded"), std::string::npos);
}

TEST(SearchStudy, AveragesNeverReachAcrossBlocks) {
  std::vector<StudyRow> rows;
  addSubject(rows, "A", "degraded", {0, 0, 1}, {20, 30, 10}, 6);
  addSubject(rows, "B", "augmented", {0, 0, 1}, {20, 30, 12}, 6);
  orderAndNumber(rows, "six");
  const Exhibit& durations = exhibit(analyseStudy(rows, searchDesign()), "figure_10");
  ASSERT_EQ(durations.table.rows.size(), 6u);
  EXPECT_EQ(at(durations, 1, "from_trial"), 5);
  EXPECT_EQ(at(durations, 1, "to_trial"), 6);
  EXPECT_NEAR(at(durations, 1, "mean_s"), 20, 1e-12);
  EXPECT_NEAR(at(durations, 2, "mean_s"), 32.5, 1e-12);
}

TEST(SearchStudy, WhoLacksABlockIsLeftOutAndNamed) {
  std::vector<StudyRow> rows = fourSubjects();
  std::erase_if(rows,
                [](const StudyRow& r) { return r.subject == "B" && r.block == "evaluation"; });
  const StudyResult result = analyseStudy(rows, searchDesign());
  EXPECT_NE(result.cautions.back().find(
                "Left out, since baseline, training or evaluation is missing: B."),
            std::string::npos);
  std::erase_if(rows, [](const StudyRow& r) { return r.block == "training"; });
  EXPECT_THROW(analyseStudy(rows, searchDesign()), UsageError);
}

TEST(SearchStudy, GroupsTellTheTrainingWhereThereAreSeveral) {
  std::vector<StudyRow> rows = fourSubjects();
  for (StudyRow& r : rows) r.group = r.subject < "C" ? "plain" : "cues";
  EXPECT_EQ(searchStudyOf(rows, searchDesign()).trainings,
            (std::vector<std::string>{"plain", "cues"}));
}

}  // namespace
}  // namespace palpa::study_analysis
