#include <algorithm>
#include <cmath>

#include "apps/assess/statistics/assumptions.h"
#include "apps/assess/statistics/sample.h"
#include "apps/study/analysis/exhibit.h"
#include "apps/study/analysis/search_study.h"

namespace palpa::study_analysis {
namespace {

constexpr double kAlike =
    1e-9;  ///< distances closer than this are ties: the first subject is shown
constexpr std::size_t kConsecutive = 4;  ///< trials to a point of figures 9 and 10

int familyOf(const SearchStudy& study, const SearchSubject& s) {
  return static_cast<int>(std::find(study.trainings.begin(), study.trainings.end(), s.training) -
                          study.trainings.begin());
}

std::vector<std::string> familiesOf(const StudyDesign& design, const SearchStudy& study) {
  std::vector<std::string> names;
  for (const std::string& t : study.trainings) names.push_back(inWords(design, t));
  return names;
}

Exhibit slopes(const StudyDesign& design, const SearchStudy& study, const char* id,
               const char* title, const char* unit, double scale, double SearchSubject::*before,
               double SearchSubject::*after) {
  Exhibit e{id,
            title,
            "A line a subject, from baseline to evaluation; a panel a kind of training.",
            ExhibitPart::figure,
            {{{"subject", "Subject", 0},
              {"training", "Training", 0},
              {"baseline", "Baseline", 2},
              {"evaluation", "Evaluation", 2},
              {"change", "Change", 2}},
             {}},
            {},
            {}};
  Plot plot{PlotKind::slopes,          "", unit, {"baseline", "evaluation"},
            familiesOf(design, study), {}, {}};
  for (const SearchSubject& s : study.subjects) {
    const double b = scale * s.*before, a = scale * s.*after;
    plot.series.push_back({s.subject, familyOf(study, s), {{0, b, b, b}, {1, a, a, a}}});
    e.table.rows.push_back({s.subject, inWords(design, s.training), b, a, a - b});
  }
  e.plots.push_back(std::move(plot));
  return e;
}

Exhibit scatter(const StudyDesign& design, const SearchStudy& study) {
  Exhibit e{"figure_8",
            "Both improvements together",
            "A mark a subject; each improvement over the standard deviation of all subjects. Right "
            "and up is better.",
            ExhibitPart::figure,
            {{{"subject", "Subject", 0},
              {"training", "Training", 0},
              {"improvement", "Success, + share", 3},
              {"decrease", "Duration, − share", 3},
              {"improvement_sd", "Success, in SD", 2},
              {"decrease_sd", "Duration, in SD", 2},
              {"sum", "Sum", 2},
              {"maximum", "Larger", 2}},
             {}},
            {},
            {}};
  Plot plot{PlotKind::scatter,
            "improvement of the success rate, in SD",
            "decrease of the duration, in SD",
            {},
            familiesOf(design, study),
            {},
            {}};
  for (const std::string& name : plot.families)
    plot.series.push_back({name, static_cast<int>(plot.series.size()), {}});
  for (const SearchSubject& s : study.subjects) {
    plot.series[static_cast<std::size_t>(familyOf(study, s))].points.push_back(
        {s.improvement_sd, s.decrease_sd, s.decrease_sd, s.decrease_sd});
    e.table.rows.push_back({s.subject, inWords(design, s.training), s.improvement, s.decrease,
                            s.improvement_sd, s.decrease_sd, s.sum(), s.largest()});
  }
  e.plots.push_back(std::move(plot));
  return e;
}

/// Who lies nearest the median of his kind of training; null: nobody trained so.
const SearchSubject* typicalOf(const SearchStudy& study, const std::string& training) {
  std::vector<double> sums;
  for (const SearchSubject& s : study.subjects)
    if (s.training == training) sums.push_back(s.sum());
  if (sums.empty()) return nullptr;
  const double median = statistics::interpolatedQuantile(sums, 0.5);
  const SearchSubject* nearest = nullptr;
  for (const SearchSubject& s : study.subjects)
    if (s.training == training &&
        (!nearest || std::abs(s.sum() - median) < std::abs(nearest->sum() - median) - kAlike))
      nearest = &s;
  return nearest;
}

/// Blocks as they follow each other, whatever session; averages never reach across blocks.
void addDurations(Exhibit& e, Plot& plot, const std::vector<StudyRow>& rows,
                  const SearchSubject& subject) {
  std::string block;
  std::vector<double> values;
  double first = 0;
  PlotSeries* series = nullptr;
  const auto flush = [&](double last) {
    if (values.empty()) return;
    const double mean = statistics::meanOf(values), middle = (first + last) / 2;
    series->points.push_back({middle, mean, mean, mean});
    e.table.rows.push_back({block, first, last, mean});
    values.clear();
  };
  double before = 0;
  for (const StudyRow& r : rows) {
    if (r.subject != subject.subject || !std::isfinite(r.metric("time_s"))) continue;
    if (r.block != block || !series) {
      flush(before);
      block = r.block;
      plot.dividers.push_back({r.overall - 0.5, block});
      plot.series.push_back({block, 0, {}});
      series = &plot.series.back();
    }
    if (values.empty()) first = r.overall;
    values.push_back(r.metric("time_s"));
    before = r.overall;
    if (values.size() == kConsecutive) flush(before);
  }
  flush(before);
}

Exhibit durations(const std::vector<StudyRow>& rows, const StudyDesign& design,
                  const SearchSubject& subject, const std::string& id) {
  Exhibit e{
      id,
      "Trial by trial: one subject, " + inWords(design, subject.training),
      "Durations of subject " + subject.subject +
          ", means of four consecutive trials of a block. Of those who trained so, this subject's "
          "summed improvement lies nearest the median: a typical one, not the best.",
      ExhibitPart::figure,
      {{{"block", "Block", 0},
        {"from_trial", "From trial", 0},
        {"to_trial", "to", 0},
        {"mean_s", "Mean, s", 2}},
       {}},
      {},
      {}};
  Plot plot{PlotKind::curves, "trial", "Time, s", {}, {}, {}, {}};
  addDurations(e, plot, rows, subject);
  e.plots.push_back(std::move(plot));
  return e;
}

}  // namespace

std::vector<Exhibit> searchFigures(const std::vector<StudyRow>& rows, const StudyDesign& design,
                                   const SearchStudy& study) {
  std::vector<Exhibit> all{
      slopes(design, study, "figure_6", "Success rate before and after training", "success rate, %",
             100, &SearchSubject::success_before, &SearchSubject::success_after),
      slopes(design, study, "figure_7", "Duration of a trial before and after training",
             "mean duration, s", 1, &SearchSubject::seconds_before, &SearchSubject::seconds_after),
      scatter(design, study)};
  int number = 9;  // Edmunds and Pai 2012 show the augmented simulator first, the second kind
  for (auto training = study.trainings.rbegin(); training != study.trainings.rend(); ++training)
    if (const SearchSubject* typical = typicalOf(study, *training))
      all.push_back(durations(rows, design, *typical, "figure_" + std::to_string(number++)));
  return all;
}

Exhibit anovaTable(const StudyDesign& design, const SearchStudy& study) {
  Exhibit e{
      "anova",
      "Does the kind of training matter?",
      "One-way analyses of variance between the kinds of training, one value a subject. Sizes of "
      "effects: share of all squares (eta squared), and without its bias (omega squared).",
      ExhibitPart::table,
      {{{"what", "Figure", 0},
        {"f", "F", 2},
        {"df_between", "df", 0},
        {"df_within", "df within", 0},
        {"p", "p", 3, Format::p_value},
        {"p_holm", "p (Holm)", 3, Format::p_value},
        {"eta_squared", "eta²", 3},
        {"omega_squared", "omega²", 3}},
       {}},
      {},
      {}};
  const std::vector<std::string> names = familiesOf(design, study);
  for (std::size_t g = 0; g < names.size(); ++g) {
    e.table.columns.push_back({"mean_" + std::to_string(g + 1), "Mean, " + names[g], 3});
    e.table.columns.push_back({"sd_" + std::to_string(g + 1), "SD", 3});
  }
  const double none = std::nan("");
  for (const SearchAnova& a : study.anovas) {
    std::vector<Cell> row{a.title};
    if (a.anova)
      row.insert(row.end(), {a.anova->f, a.anova->degrees_between, a.anova->degrees_within,
                             a.anova->p, a.p_holm, a.anova->eta_squared, a.anova->omega_squared});
    else
      row.insert(row.end(), 7, none);
    for (const std::vector<double>& group : a.groups) {
      const statistics::Description d = statistics::describe(group);
      row.insert(row.end(), {d.mean, d.sd});
    }
    e.table.rows.push_back(std::move(row));
    if (!a.anova)
      e.notes.push_back(a.title + ": not tested: " + a.why_not);
    else
      for (const std::string& concern : statistics::concernsAbout(a.groups, names))
        e.notes.push_back(a.title + ": " + concern);
  }
  return e;
}

std::vector<std::string> searchFindings(const StudyDesign& design, const SearchStudy& study) {
  std::vector<std::string> findings;
  const std::vector<std::string> names = familiesOf(design, study);
  for (const SearchAnova& a : study.anovas) {
    if (!a.anova) {
      findings.push_back(a.title + " cannot be compared: " + a.why_not);
      continue;
    }
    const bool share = a.id == "success_improvement" || a.id == "duration_decrease";
    std::vector<std::string> means;
    for (std::size_t g = 0; g < names.size(); ++g) {
      const double mean = statistics::meanOf(a.groups[g]);
      means.push_back((share ? percent(mean) : number(mean, 2)) + " after training with " +
                      names[g]);
    }
    findings.push_back(
        a.title + ": " + joined(means) + ". F(" + number(a.anova->degrees_between, 0) + ", " +
        number(a.anova->degrees_within, 0) + ") = " + number(a.anova->f, 2) + ", " +
        pWords(a.anova->p) + ", " + pWords(a.p_holm) + " with all four tests: " +
        (a.p_holm < 0.05 ? "more than chance explains." : "chance may explain the difference."));
  }
  return findings;
}

}  // namespace palpa::study_analysis
