#include <algorithm>

#include "anatomy/base/counted.h"
#include "apps/study/analysis/comparison.h"
#include "apps/study/analysis/exhibit.h"
#include "apps/study/analysis/pilot.h"

namespace palpa::study_analysis {
namespace {

double countOf(std::size_t n) { return static_cast<double>(n); }

/// As Tzafestas et al. 2008 number them: "table_3" without, "table_4" with force feedback.
std::string learningId(std::size_t condition) {
  return condition < 2 ? "table_" + std::to_string(3 + condition)
                       : "learning_" + std::to_string(condition + 1);
}

const std::vector<Column>& learningColumns() {
  static const std::vector<Column> columns{{"figure", "Figure", 0},
                                           {"n", "n", 0},
                                           {"mean_first", "Mean, first two", 1},
                                           {"sd_first", "SD", 1},
                                           {"mean_last", "Mean, last two", 1},
                                           {"sd_last", "SD", 1},
                                           {"learning_rate_percent", "Learning rate, %", 1},
                                           {"rate_low_percent", "95 % from", 1},
                                           {"rate_high_percent", "to", 1},
                                           {"resampled_low_percent", "Resampled from", 1},
                                           {"resampled_high_percent", "to", 1},
                                           {"t", "t", 2, Format::number, false},
                                           {"df", "df", 1, Format::number, false},
                                           {"p", "p", 3, Format::p_value},
                                           {"p_holm", "p (Holm)", 3, Format::p_value},
                                           {"hedges_g", "Effect g", 2}};
  return columns;
}

std::vector<Column> publishedLearningColumns() {
  std::vector<Column> columns(learningColumns().begin(), learningColumns().begin() + 7);
  columns.insert(
      columns.end(),
      {{"t", "t", 2}, {"df", "df", 1}, {"p_one_tailed", "p, one-tailed", 4, Format::p_value}});
  return columns;
}

std::vector<Cell> learningRow(const LearningCell& cell) {
  const Comparison& c = cell.test;
  return {metricTitle(c.metric),
          countOf(c.b.n),
          c.b.mean,
          c.b.sd,
          c.a.mean,
          c.a.sd,
          100 * cell.rate.value,
          100 * cell.rateLow(),
          100 * cell.rateHigh(),
          100 * cell.rate.low,
          100 * cell.rate.high,
          c.t,
          c.degrees,
          c.p,
          c.p_holm,
          c.effect};
}

Exhibit learningTable(const StudyDesign& design, const Pilot& pilot, std::size_t condition) {
  const std::string words =
      inWords(design, pilot.learners) + ", " + inWords(design, pilot.conditions[condition]);
  Exhibit e{learningId(condition),
            "Learning: " + words,
            "Means and standard deviations over subjects, each counted once by the mean of two "
            "trials. Learning rate: 1 − mean of the last two / mean of the first two; its interval "
            "by Student's t of the fall, over the mean of the first two, and by resampling "
            "subjects (too narrow for so few as five). Test: paired t, two-sided.",
            ExhibitPart::table,
            {learningColumns(), {}},
            {},
            {}};
  std::vector<Comparison> tests;
  for (const LearningCell& cell : pilot.learning) {
    if (cell.condition != pilot.conditions[condition]) continue;
    e.table.rows.push_back(learningRow(cell));
    tests.push_back(cell.test);
    if (cell.left_out > 0)
      addOnce(e.notes, counted(cell.left_out, "subject") +
                           " had fewer than four trials with this figure and is left out: " +
                           metricTitle(cell.metric) + ".");
  }
  for (const std::string& note : notesOf(tests)) addOnce(e.notes, note);
  return e;
}

Exhibit secondGroup(const std::vector<StudyRow>& rows, const StudyDesign& design,
                    const Pilot& pilot) {
  Exhibit e{"table_5",
            "Overall: " + inWords(design, pilot.experts),
            "Over all trials; each subject counts once, by the mean of their trials.",
            ExhibitPart::table,
            {cellColumns(), {}},
            {},
            {}};
  std::vector<StudyRow> of_group;
  std::copy_if(rows.begin(), rows.end(), std::back_inserter(of_group),
               [&](const StudyRow& r) { return r.group == pilot.experts; });
  for (const std::string& metric : kPilotMetrics) addCellRows(e.table, metric, of_group, design);
  return e;
}

Exhibit groupTable(const StudyDesign& design, const Pilot& pilot) {
  return {"table_6",
          inWords(design, pilot.experts) + " against " + inWords(design, pilot.learners),
          "Each subject counts once, by the mean of all trials. Welch's t-test, two-sided; Holm's "
          "correction is over all learning and group tests of this page.",
          ExhibitPart::table,
          comparisonTable(pilot.groups),
          {},
          notesOf(pilot.groups)};
}

Exhibit betweenTable(const Pilot& pilot) {
  std::vector<Comparison> in_percent = pilot.learning_between;
  for (Comparison& c : in_percent) {
    for (double* v : {&c.a.mean, &c.a.sd, &c.b.mean, &c.b.sd, &c.difference, &c.low, &c.high,
                      &c.boot_low, &c.boot_high})
      *v *= 100;
    c.about += ", %";
  }
  return {"learning_by_condition",
          "Does the condition change how much is learned?",
          "Learning rates of the subjects, %, one each; Welch's t-test, two-sided. Tzafestas et "
          "al. 2008 compare the rates by eye.",
          ExhibitPart::table,
          comparisonTable(in_percent),
          {},
          notesOf(pilot.learning_between)};
}

Exhibit successTable(const std::vector<StudyRow>& rows, const StudyDesign& design) {
  Exhibit e{"success",
            "Success",
            "Share of successful trials, over subjects. Times and penalties of failed trials are "
            "in the tables above; where success differs, read them together.",
            ExhibitPart::table,
            {cellColumns(), {}},
            {},
            {}};
  addCellRows(e.table, "success", rows, design);
  return e;
}

}  // namespace

std::vector<Exhibit> pilotTables(const std::vector<StudyRow>& rows, const StudyDesign& design,
                                 const Pilot& pilot) {
  std::vector<Exhibit> all;
  for (std::size_t c = 0; c < pilot.conditions.size(); ++c)
    all.push_back(learningTable(design, pilot, c));
  if (!pilot.learning_between.empty()) all.push_back(betweenTable(pilot));
  if (!pilot.experts.empty()) {
    all.push_back(secondGroup(rows, design, pilot));
    all.push_back(groupTable(design, pilot));
  }
  Exhibit success = successTable(rows, design);
  if (!success.table.rows.empty()) all.push_back(std::move(success));
  return all;
}

std::vector<Exhibit> pilotPublished(const StudyDesign& design, const Pilot& pilot) {
  std::vector<Exhibit> all;
  for (std::size_t c = 0; c < pilot.conditions.size(); ++c) {
    Exhibit e{learningId(c) + "_as_published",
              "Learning, as published: " + inWords(design, pilot.learners) + ", " +
                  inWords(design, pilot.conditions[c]),
              "Trials pooled: n = subjects × two trials. Welch's t-test, one-tailed.",
              ExhibitPart::published,
              {publishedLearningColumns(), {}},
              {},
              {}};
    for (std::size_t m = 0; m < kPilotMetrics.size(); ++m) {
      const Comparison& test = pilot.learning_published[c * kPilotMetrics.size() + m];
      e.table.rows.push_back({metricTitle(test.metric), countOf(test.b.n), test.b.mean, test.b.sd,
                              test.a.mean, test.a.sd, 100 * (1 - test.a.mean / test.b.mean), test.t,
                              test.degrees, test.p});
      if (!test.tested())
        e.notes.push_back(metricTitle(test.metric) + ": not tested: " + test.not_tested);
    }
    all.push_back(std::move(e));
  }
  if (pilot.experts.empty()) return all;
  Exhibit five{"table_5_as_published",
               "Overall, as published: " + inWords(design, pilot.experts),
               "Over all trials, pooled.",
               ExhibitPart::published,
               {{{"figure", "Figure", 0},
                 {"condition", "Condition", 0},
                 {"trials", "Trials", 0},
                 {"mean", "Mean", 2},
                 {"sd", "SD", 2}},
                {}},
               {},
               {}};
  for (const Comparison& c : pilot.groups_published)
    five.table.rows.push_back({metricTitle(c.metric), c.about, countOf(c.a.n), c.a.mean, c.a.sd});
  all.push_back(std::move(five));
  all.push_back({"table_6_as_published",
                 "Groups, as published",
                 "Trials pooled: n = subjects × trials. Welch's t-test, one-tailed.",
                 ExhibitPart::published,
                 publishedTable(pilot.groups_published),
                 {},
                 {}});
  return all;
}

}  // namespace palpa::study_analysis
