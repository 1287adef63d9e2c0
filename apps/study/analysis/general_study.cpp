#include "apps/study/analysis/study_design.h"

#include <algorithm>
#include <cmath>
#include <set>

#include "anatomy/base/counted.h"
#include "anatomy/base/error.h"
#include "apps/study/analysis/comparison.h"
#include "apps/study/analysis/exhibit.h"
#include "apps/study/analysis/series.h"

namespace palpa::study_analysis {
namespace {

/// Those asked for, else all that are not the same in every trial, in the order of their names.
std::vector<std::string> metricsOf(const std::vector<StudyRow>& rows, const StudyDesign& design) {
  std::map<std::string, std::set<double>> values;
  for (const StudyRow& row : rows)
    for (const auto& [name, value] : row.metrics)
      if (std::isfinite(value)) values[name].insert(value);
  for (const std::string& name : design.metrics)
    if (!values.contains(name))
      throw UsageError("no trial has the figure " + name, design.title,
                       "See palpa records metrics for their names");
  if (!design.metrics.empty()) return design.metrics;
  std::vector<std::string> names;
  for (const auto& [name, different] : values)
    if (different.size() > 1) names.push_back(name);
  return names;
}

Comparison named(Comparison c, const std::string& metric, const std::string& about) {
  c.metric = metric;
  c.about = about;
  return c;
}

/// Of subjects who did both, in one order.
bool asPairs(const std::vector<SubjectSeries>& a, const std::vector<SubjectSeries>& b,
             std::vector<double>& of_a, std::vector<double>& of_b) {
  for (const SubjectSeries& s : a)
    for (const SubjectSeries& other : b)
      if (s.subject == other.subject) {
        of_a.push_back(subjectMeans({s})[0]);
        of_b.push_back(subjectMeans({other})[0]);
      }
  return of_a.size() == a.size() && of_b.size() == b.size() && !of_a.empty();
}

Comparison betweenConditions(const std::vector<SubjectSeries>& series, const StudyDesign& design,
                             const std::string& group, const std::string& condition,
                             const std::string& first) {
  const std::vector<SubjectSeries> a = within(series, group, condition),
                                   b = within(series, group, first);
  std::vector<double> of_a, of_b;
  if (asPairs(a, b, of_a, of_b))
    return compare(Test::paired, of_a, of_b, inWords(design, condition), inWords(design, first),
                   design.seed);
  return compare(Test::welch, subjectMeans(a), subjectMeans(b), inWords(design, condition),
                 inWords(design, first), design.seed);
}

std::vector<Comparison> comparisonsOf(const std::vector<StudyRow>& rows, const StudyDesign& design,
                                      const std::string& metric) {
  const std::vector<SubjectSeries> series = seriesOf(rows, metric);
  const std::vector<std::string> groups = groupsOf(rows, design),
                                 conditions = conditionsOf(rows, design);
  std::vector<Comparison> all;
  for (const std::string& condition : conditions)
    for (std::size_t g = 1; g < groups.size(); ++g)
      all.push_back(
          named(compare(Test::welch, subjectMeans(within(series, groups[g], condition)),
                        subjectMeans(within(series, groups[0], condition)),
                        inWords(design, groups[g]), inWords(design, groups[0]), design.seed),
                metric, condition.empty() ? "all trials" : inWords(design, condition)));
  for (const std::string& group : groups)
    for (std::size_t c = 1; c < conditions.size(); ++c)
      all.push_back(named(betweenConditions(series, design, group, conditions[c], conditions[0]),
                          metric, group.empty() ? "all subjects" : inWords(design, group)));
  return all;
}

std::string sentenceOf(const Comparison& c) {
  const int decimals = decimalsFor(c.difference);
  return metricTitle(c.metric) + ", " + c.about + ": " + c.a_name + " " +
         number(std::abs(c.difference), decimals) + (c.difference >= 0 ? " more" : " less") +
         " than " + c.b_name + " (95 % interval " + number(c.low, decimals) + " to " +
         number(c.high, decimals) + "; " + pWords(c.p) + ", " + pWords(c.p_holm) +
         " with all tests of this page).";
}

std::vector<std::string> generalFindings(const std::vector<Comparison>& all) {
  std::vector<std::string> findings;
  for (const Comparison& c : all)
    if (c.tested() && c.p_holm < 0.05)
      findings.push_back("More than chance explains: " + sentenceOf(c));
  if (findings.empty())
    findings.push_back("Among " + counted(all.size(), "comparison") +
                       " none differs by more than chance may explain.");
  return findings;
}

}  // namespace

StudyResult analyseGeneral(const std::vector<StudyRow>& rows, const StudyDesign& design) {
  StudyResult result = framedResult(rows, design, "general");
  Exhibit cells{
      "by_group_and_condition",
      "By group and condition",
      "Each subject counts once, by the mean of their trials; 95 % interval by Student's t.",
      ExhibitPart::table,
      {cellColumns(), {}},
      {},
      {}};
  std::vector<Comparison> all;
  const std::vector<std::string> names = metricsOf(rows, design);
  for (const std::string& metric : names) {
    addCellRows(cells.table, metric, rows, design);
    for (Comparison& c : comparisonsOf(rows, design, metric)) all.push_back(std::move(c));
  }
  std::vector<Comparison*> family;
  std::size_t smallest = result.subjects;
  for (Comparison& c : all) {
    family.push_back(&c);
    smallest = std::min({smallest, c.a.n, c.b.n});
  }
  correctTogether(family);
  result.findings = generalFindings(all);
  result.exhibits.push_back(std::move(cells));
  if (!all.empty())
    result.exhibits.push_back(
        {"comparisons",
         "Comparisons",
         "Each subject counts once. Two-sided; Holm's correction is over all rows of this table.",
         ExhibitPart::table,
         comparisonTable(all),
         {},
         notesOf(all)});
  for (const std::string& metric : names)
    if (!design.metrics.empty()) result.exhibits.push_back(mixedExhibit(rows, design, metric));
  result.cautions = cautionsOf(result, smallest);
  return result;
}

}  // namespace palpa::study_analysis
