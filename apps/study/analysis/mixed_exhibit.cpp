#include "apps/study/analysis/comparison.h"

#include <Eigen/Core>
#include <algorithm>

#include "anatomy/base/counted.h"
#include "anatomy/base/error.h"
#include "apps/assess/statistics/mixed_model.h"
#include "apps/study/analysis/exhibit.h"
#include "apps/study/analysis/series.h"

namespace palpa::study_analysis {
namespace {

struct ModelTable {
  std::vector<std::string> names{"Mean of all"};
  std::vector<std::vector<double>> columns{{}};
  std::vector<double> y;
  std::vector<int> subject;
};

struct Factor {
  std::string name;
  std::vector<double> values;  ///< a value a trial
};

/// -1/2 for the first level, +1/2 for the second.
Factor halves(const std::vector<SubjectSeries>& series, const std::vector<std::string>& levels,
              const StudyDesign& design, std::string SubjectSeries::*of) {
  Factor factor{inWords(design, levels[1]) + " against " + inWords(design, levels[0]), {}};
  for (const SubjectSeries& s : series)
    factor.values.insert(factor.values.end(), s.values.size(), s.*of == levels[1] ? 0.5 : -0.5);
  return factor;
}

Factor courseOf(const std::vector<SubjectSeries>& series) {
  Factor factor{"Each further trial", {}};
  int last = 1;
  for (const SubjectSeries& s : series) last = std::max(last, s.trials.back());
  for (const SubjectSeries& s : series)
    for (const int trial : s.trials) factor.values.push_back(trial - (1 + last) / 2.0);
  return factor;
}

std::vector<Factor> factorsOf(const std::vector<SubjectSeries>& series,
                              const std::vector<std::string>& groups,
                              const std::vector<std::string>& conditions,
                              const StudyDesign& design) {
  std::vector<Factor> factors;
  if (groups.size() == 2) factors.push_back(halves(series, groups, design, &SubjectSeries::group));
  if (conditions.size() == 2)
    factors.push_back(halves(series, conditions, design, &SubjectSeries::condition));
  factors.push_back(courseOf(series));
  return factors;
}

ModelTable tableOf(const std::vector<SubjectSeries>& series, const std::vector<Factor>& factors) {
  ModelTable table;
  std::vector<std::string> subjects;
  for (const SubjectSeries& s : series) {
    const auto known = std::find(subjects.begin(), subjects.end(), s.subject);
    const int id = static_cast<int>(known - subjects.begin());
    if (known == subjects.end()) subjects.push_back(s.subject);
    table.y.insert(table.y.end(), s.values.begin(), s.values.end());
    table.subject.insert(table.subject.end(), s.values.size(), id);
  }
  table.columns[0].assign(table.y.size(), 1);
  for (const Factor& f : factors) {
    table.names.push_back(f.name);
    table.columns.push_back(f.values);
  }
  for (std::size_t a = 0; a < factors.size(); ++a)
    for (std::size_t b = a + 1; b < factors.size(); ++b) {
      std::vector<double> product = factors[a].values;
      for (std::size_t i = 0; i < product.size(); ++i) product[i] *= factors[b].values[i];
      table.names.push_back(factors[a].name + " × " + factors[b].name);
      table.columns.push_back(std::move(product));
    }
  return table;
}

statistics::MixedModel fit(const ModelTable& table) {
  const auto rows = static_cast<Eigen::Index>(table.y.size());
  Eigen::MatrixXd x(rows, static_cast<Eigen::Index>(table.columns.size()));
  for (std::size_t c = 0; c < table.columns.size(); ++c)
    x.col(static_cast<Eigen::Index>(c)) =
        Eigen::Map<const Eigen::VectorXd>(table.columns[c].data(), rows);
  return statistics::fitMixedModel(Eigen::Map<const Eigen::VectorXd>(table.y.data(), rows), x,
                                   table.names, table.subject);
}

void fillFrom(Exhibit& exhibit, const statistics::MixedModel& model) {
  for (const statistics::FixedEffect& e : model.effects)
    exhibit.table.rows.push_back({e.name, e.estimate, e.error, e.low, e.high, e.t, e.degrees, e.p,
                                  std::string(e.within ? "within subjects" : "between subjects")});
  exhibit.notes.push_back(
      "Subjects differ by a standard deviation of " +
      number(model.sd_subject, decimalsFor(model.sd_subject)) + ", trials of one subject by " +
      number(model.sd_residual, decimalsFor(model.sd_residual)) + ": " + percent(model.alike) +
      " of the spread is the subjects' own (" + counted(model.subjects, "subject") + ", " +
      counted(model.trials, "trial") + ").");
}

/// A figure's name as a part of a file's.
std::string plainName(std::string name) {
  for (char& c : name)
    if (std::string("ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789-_").find(c) ==
        std::string::npos)
      c = '_';
  return name;
}

}  // namespace

Exhibit mixedExhibit(const std::vector<StudyRow>& rows, const StudyDesign& design,
                     const std::string& metric) {
  Exhibit exhibit{"mixed_model_" + plainName(metric),
                  "All trials at once: " + metricTitle(metric),
                  "A check on the tests above: a mixed model with an intercept for each subject "
                  "(REML), so that trials of one subject are not taken as independent. Effects are "
                  "in the figure's own unit; "
                  "learning is taken as a straight line.",
                  ExhibitPart::check,
                  {{{"effect", "Effect", 0},
                    {"estimate", "Estimate", 2},
                    {"error", "Standard error", 2},
                    {"low", "95 % from", 2},
                    {"high", "to", 2},
                    {"t", "t", 2},
                    {"df", "df", 0},
                    {"p", "p", 3, Format::p_value},
                    {"kind", "Differs", 0}},
                   {}},
                  {},
                  {}};
  const std::vector<SubjectSeries> series = seriesOf(rows, metric);
  const std::vector<std::string> groups = groupsOf(rows, design),
                                 conditions = conditionsOf(rows, design);
  if (series.empty() || groups.size() > 2 || conditions.size() > 2) {
    exhibit.notes.push_back(series.empty() ? "No trial has this figure."
                                           : "Fitted for two groups and two conditions only.");
    return exhibit;
  }
  try {
    fillFrom(exhibit, fit(tableOf(series, factorsOf(series, groups, conditions, design))));
  } catch (const Error& e) {
    exhibit.notes.push_back(std::string("Not fitted: ") + e.what());
  }
  return exhibit;
}

}  // namespace palpa::study_analysis
