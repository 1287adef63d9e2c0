// The tables of Tzafestas 2008: trials drawn so that they have the printed means and standard
// deviations give the published figures; hand-made ones give hand-made answers.
#include <gtest/gtest.h>

#include <cmath>

#include "anatomy/base/error.h"
#include "apps/study/analysis/pilot.h"
#include "apps/study/analysis/power_analysis.h"
#include "rows.h"

namespace palpa::study_analysis {
namespace {

using test::at;
using test::exhibit;
using test::pilotDesign;

struct Printed {
  double first, first_sd, last, last_sd;
};

/// Five novices whose first two and last two trials have, pooled, the printed means and SDs; the
/// six trials between have the mean of both.
void addNovices(std::vector<StudyRow>& rows, const std::string& condition, const Printed& time,
                const Printed& total) {
  const auto values = [](const Printed& p) {
    return std::pair{test::valuesWith(p.first, p.first_sd, 10),
                     test::valuesWith(p.last, p.last_sd, 10)};
  };
  const auto [time_first, time_last] = values(time);
  const auto [total_first, total_last] = values(total);
  for (std::size_t s = 0; s < 5; ++s)
    for (std::size_t t = 0; t < 10; ++t) {
      const bool first = t < 2, last = t >= 8;
      const std::size_t i = 2 * s + (last ? t - 8 : t % 2);
      rows.push_back(test::row(condition + std::to_string(s), "novice", condition, "trials",
                               static_cast<int>(t) + 1,
                               {{"time_s", first  ? time_first[i]
                                           : last ? time_last[i]
                                                  : (time.first + time.last) / 2},
                                {"total", first  ? total_first[i]
                                          : last ? total_last[i]
                                                 : (total.first + total.last) / 2}}));
    }
}

void addExperienced(std::vector<StudyRow>& rows, const std::string& condition, double time,
                    double time_sd, double total, double total_sd) {
  const std::vector<double> times = test::valuesWith(time, time_sd, 50),
                            totals = test::valuesWith(total, total_sd, 50);
  for (std::size_t i = 0; i < 50; ++i)
    rows.push_back(test::row("E" + condition + std::to_string(i / 10), "experienced", condition,
                             "trials", static_cast<int>(i % 10) + 1,
                             {{"time_s", times[i]}, {"total", totals[i]}}));
}

std::vector<StudyRow> printedStudy() {
  std::vector<StudyRow> rows;
  addNovices(rows, "NO", {71.5, 27.1, 55.2, 42.3}, {1918.99, 1163.55, 1223.76, 767.60});
  addNovices(rows, "FF", {89.9, 41.4, 46.3, 28.3}, {1636.37, 1447.34, 859.32, 346.26});
  addExperienced(rows, "NO", 53.4, 35.4, 1580, 900);
  addExperienced(rows, "FF", 32.7, 14.7, 753, 430);
  orderAndNumber(rows, "printed");
  return rows;
}

TEST(Pilot, TheWayOfThePaperGivesItsTables) {
  const StudyResult result = analyseStudy(printedStudy(), pilotDesign());
  const Exhibit &three = exhibit(result, "table_3_as_published"),
                &four = exhibit(result, "table_4_as_published"),
                &five = exhibit(result, "table_5_as_published");
  EXPECT_NEAR(at(three, 0, "learning_rate_percent"), 22.8, 0.05);
  EXPECT_NEAR(at(three, 1, "learning_rate_percent"), 36.2, 0.05);
  EXPECT_NEAR(at(four, 0, "learning_rate_percent"), 48.5, 0.05);
  EXPECT_NEAR(at(four, 1, "learning_rate_percent"), 47.5, 0.05);
  EXPECT_EQ(at(three, 0, "n"), 10);
  EXPECT_NEAR(at(three, 0, "p_one_tailed"), 0.1604, 5e-5);  // printed .162
  EXPECT_NEAR(at(four, 0, "p_one_tailed"), 0.0072, 5e-5);   // printed .007
  EXPECT_NEAR(at(four, 1, "p_one_tailed"), 0.0648,
              5e-5);  // printed .065; pooled variances would give .058
  EXPECT_NEAR(at(three, 0, "sd_first"), 27.1, 1e-9);
  EXPECT_NEAR(at(four, 1, "sd_last"), 346.26, 1e-9);
  EXPECT_NEAR(at(five, 0, "mean"), 53.4, 1e-9);
  EXPECT_NEAR(at(five, 3, "sd"), 430, 1e-9);
  EXPECT_EQ(at(exhibit(result, "table_6_as_published"), 0, "n_a"), 50);
  EXPECT_FALSE(result.published_words.empty());
}

TEST(Pilot, BySubjectTheRatesStayAndNoTrialCountsTwice) {
  StudyDesign design = pilotDesign();
  design.as_published = false;
  const StudyResult result = analyseStudy(printedStudy(), design);
  EXPECT_NEAR(at(exhibit(result, "table_3"), 0, "learning_rate_percent"), 22.8, 0.05);
  EXPECT_NEAR(at(exhibit(result, "table_4"), 1, "learning_rate_percent"), 47.5, 0.05);
  EXPECT_EQ(at(exhibit(result, "table_4"), 0, "n"), 5);
  EXPECT_EQ(at(exhibit(result, "table_4"), 0, "df"), 4);
  EXPECT_EQ(at(exhibit(result, "table_6"), 0, "n_a"), 5);
  EXPECT_TRUE(result.published_words.empty());
  EXPECT_TRUE(exhibit(result, "table_3_as_published").id.empty());
}

/// Three novices, six trials: first means 10, 20, 30, last 8, 14, 26; differences -2, -6, -4 have
/// mean -4, SD 2, so t = -4 / (2 / sqrt 3) = -3.4641 with 2 degrees, p = .0742.
std::vector<StudyRow> threeNovices() {
  std::vector<StudyRow> rows;
  const std::vector<std::vector<double>> trials{
      {9, 11, 5, 5, 7, 9}, {20, 20, 5, 5, 13, 15}, {28, 32, 5, 5, 26, 26}};
  for (std::size_t s = 0; s < 3; ++s)
    for (std::size_t t = 0; t < 6; ++t)
      rows.push_back(test::row("N" + std::to_string(s), "novice", "FF", "trials",
                               static_cast<int>(t) + 1, {{"time_s", trials[s][t]}}));
  return rows;
}

TEST(Pilot, HandMadeTrialsGiveHandMadeAnswers) {
  std::vector<StudyRow> rows = threeNovices();
  for (int t = 1; t <= 3; ++t)
    rows.push_back(test::row("short", "novice", "FF", "trials", t, {{"time_s", 1.0}}));
  orderAndNumber(rows, "hand");
  const Pilot pilot = pilotOf(rows, pilotDesign());
  const LearningCell& cell = pilot.learning[0];
  EXPECT_EQ(cell.left_out, 1u);
  EXPECT_NEAR(cell.rate.value, 1 - 48.0 / 60, 1e-12);
  EXPECT_NEAR(cell.test.t, -2 * std::sqrt(3.0), 1e-12);
  EXPECT_NEAR(cell.test.p, 0.0742, 5e-5);
  EXPECT_EQ(cell.test.p_holm, cell.test.p) << "the only one that can be tested";
  EXPECT_NEAR(cell.rateHigh(), (4 + 4.302653 * 2 / std::sqrt(3.0)) / 20, 1e-6)
      << "Student's t with two degrees";
  EXPECT_GE(cell.rate.value, cell.rate.low);
  EXPECT_LE(cell.rate.value, cell.rate.high);
  ASSERT_EQ(cell.rates.size(), 3u);
  EXPECT_NEAR(cell.rates[1], 0.3, 1e-12);
  const StudyResult result = analyseStudy(rows, pilotDesign());
  EXPECT_TRUE(
      result.findings[0].starts_with("Novice, with force feedback: 20 % faster in the last two "
                                     "trials than in the first two (95 % interval of the fall "))
      << result.findings[0];
  EXPECT_NE(exhibit(result, "table_3").notes[0].find("1 subject had fewer than four trials"),
            std::string::npos);
  const Exhibit& curve = exhibit(result, "figure_5");
  EXPECT_NEAR(at(curve, 0, "mean"), (9 + 20 + 28 + 1) / 4.0, 1e-12);
  EXPECT_NEAR(at(curve, 5, "mean"), (9 + 15 + 26) / 3.0, 1e-12);
  EXPECT_NE(result.findings.back().find("one group only"), std::string::npos);
}

TEST(Pilot, PlantedEffectsComeOutInTheirDirection) {
  std::vector<StudyRow> rows = drawStudy(pilotModels(), 40, 10, 5);
  const StudyResult result = analyseStudy(rows, pilotDesign());
  for (const char* table : {"table_3", "table_4"})
    for (const std::size_t metric : {0u, 1u}) {
      EXPECT_GT(at(exhibit(result, table), metric, "rate_low_percent"), 0) << table << metric;
      EXPECT_LT(at(exhibit(result, table), metric, "p_holm"), 0.05);
    }
  EXPECT_LT(at(exhibit(result, "table_6"), 2, "high"), 0)
      << "experienced people with force feedback are faster";
  EXPECT_EQ(result.simulated_trials, 1600u);
  const Exhibit& mixed = exhibit(result, "mixed_model_time_s");
  ASSERT_EQ(mixed.table.rows.size(), 7u);
  EXPECT_LT(at(mixed, 1, "high"), 0) << "experienced against novice";
  EXPECT_LT(at(mixed, 3, "high"), 0) << "each further trial";
  EXPECT_GT(at(mixed, 5, "low"), 0) << "experienced people fall less from trial to trial";
}

/// With equally many trials a subject, the mixed model's question between subjects has the degrees
/// of freedom of subjects, not of trials.
TEST(Pilot, TheSecondLookCountsSubjects) {
  const StudyResult result = analyseStudy(drawStudy(pilotModels(), 5, 10, 1), pilotDesign());
  const Exhibit& mixed = exhibit(result, "mixed_model_total");
  EXPECT_EQ(at(mixed, 1, "df"), 16);
  EXPECT_EQ(at(mixed, 3, "df"), 177);
}

TEST(Pilot, SaysWhatCannotBeTested) {
  std::vector<StudyRow> rows{test::row("A", "novice", "FF", "trials", 1, {{"time_s", 5.0}})};
  orderAndNumber(rows, "one");
  const StudyResult result = analyseStudy(rows, pilotDesign());
  EXPECT_NE(result.findings[0].find("cannot be tested"), std::string::npos);
  EXPECT_NE(exhibit(result, "mixed_model_time_s").notes[0].find("Not fitted"), std::string::npos);
  rows[0].metrics = {{"other", 1.0}};
  EXPECT_THROW(analyseStudy(rows, pilotDesign()), UsageError);
  EXPECT_THROW(analyseStudy({}, pilotDesign()), UsageError);
}

TEST(Pilot, MixturesOfPeopleAndSimulationAndVersionsAreSaid) {
  std::vector<StudyRow> rows = drawStudy(pilotModels(), 3, 5, 1);
  rows[0].simulated = false;
  rows[0].software = "palpa 0.1.0";
  rows[1].software = "palpa 0.2.0";
  std::string all;
  for (const std::string& caution : analyseStudy(rows, pilotDesign()).cautions) all += caution;
  EXPECT_NE(all.find("must not be mixed"), std::string::npos);
  EXPECT_NE(all.find("palpa 0.1.0 and palpa 0.2.0"), std::string::npos);
  EXPECT_NE(all.find("With 3 subjects to a group"), std::string::npos);
}

}  // namespace
}  // namespace palpa::study_analysis
