#include "apps/study/analysis/search_study.h"

#include <algorithm>
#include <cmath>

#include "anatomy/base/error.h"
#include "apps/assess/statistics/assumptions.h"
#include "apps/assess/statistics/sample.h"
#include "apps/study/analysis/exhibit.h"
#include "apps/study/analysis/study_design.h"

namespace palpa::study_analysis {
namespace {

double meanIn(const std::vector<StudyRow>& rows, const std::string& subject,
              const std::string& block, const char* metric) {
  std::vector<double> values;
  for (const StudyRow& r : rows)
    if (r.subject == subject && r.block == block && std::isfinite(r.metric(metric)))
      values.push_back(r.metric(metric));
  return statistics::meanOf(values);
}

void requireBlocks(const std::vector<StudyRow>& rows, const StudyDesign& design) {
  for (const char* block : {"baseline", "training", "evaluation"})
    if (std::none_of(rows.begin(), rows.end(), [&](const StudyRow& r) { return r.block == block; }))
      throw UsageError(std::string("no trial of the block \"") + block + "\"", design.title,
                       "A search study has the blocks baseline, training and evaluation");
  for (const char* metric : {"success", "time_s"})
    if (std::none_of(rows.begin(), rows.end(),
                     [&](const StudyRow& r) { return std::isfinite(r.metric(metric)); }))
      throw UsageError(std::string("no trial has the figure ") + metric, design.title,
                       "A search study needs success (0 or 1) and time_s");
}

std::vector<StudyRow> trainingRows(const std::vector<StudyRow>& rows) {
  std::vector<StudyRow> some;
  std::copy_if(rows.begin(), rows.end(), std::back_inserter(some),
               [](const StudyRow& r) { return r.block == "training"; });
  return some;
}

std::string trainingOf(const std::vector<StudyRow>& training, const std::string& subject,
                       bool by_group) {
  for (const StudyRow& r : training)
    if (r.subject == subject) return by_group ? r.group : r.condition;
  return "";
}

void addSubject(SearchStudy& study, const std::vector<StudyRow>& rows, const std::string& subject,
                const std::string& training) {
  SearchSubject s{subject,
                  training,
                  meanIn(rows, subject, "baseline", "success"),
                  meanIn(rows, subject, "evaluation", "success"),
                  meanIn(rows, subject, "baseline", "time_s"),
                  meanIn(rows, subject, "evaluation", "time_s"),
                  0,
                  0,
                  0,
                  0};
  s.improvement = s.success_after - s.success_before;
  s.decrease = (s.seconds_before - s.seconds_after) / s.seconds_before;
  const bool whole = !training.empty() && std::isfinite(s.improvement) && std::isfinite(s.decrease);
  if (whole)
    study.subjects.push_back(s);
  else
    study.left_out.push_back(subject);
}

std::vector<double> valuesOf(const SearchStudy& study, double SearchSubject::*of) {
  std::vector<double> values;
  for (const SearchSubject& s : study.subjects) values.push_back(s.*of);
  return values;
}

/// Over the standard deviation of all subjects; where nothing varies there is nothing to scale by.
void normalise(SearchStudy& study, double SearchSubject::*from, double SearchSubject::*to) {
  const double sd = statistics::describe(valuesOf(study, from)).sd;
  for (SearchSubject& s : study.subjects) s.*to = sd > 0 ? s.*from / sd : 0;
}

template <class Value>
SearchAnova anovaOf(const SearchStudy& study, const char* id, const char* title, Value value) {
  SearchAnova a{id, title, {}, {}, 1, ""};
  for (const std::string& training : study.trainings) {
    a.groups.emplace_back();
    for (const SearchSubject& s : study.subjects)
      if (s.training == training) a.groups.back().push_back(value(s));
  }
  try {
    a.anova = statistics::oneWayAnova(a.groups);
  } catch (const Error& e) {
    a.why_not = e.what();
  }
  return a;
}

void correct(std::vector<SearchAnova>& anovas) {
  std::vector<double> p;
  for (const SearchAnova& a : anovas)
    if (a.anova) p.push_back(a.anova->p);
  const std::vector<double> corrected = statistics::holm(p);
  std::size_t i = 0;
  for (SearchAnova& a : anovas)
    if (a.anova) a.p_holm = corrected[i++];
}

}  // namespace

SearchStudy searchStudyOf(const std::vector<StudyRow>& rows, const StudyDesign& design) {
  requireBlocks(rows, design);
  const std::vector<StudyRow> training = trainingRows(rows);
  const std::vector<std::string> groups = groupsOf(rows, design);
  const bool by_group = groups.size() > 1;
  SearchStudy study;
  study.trainings = by_group ? groups : conditionsOf(training, design);
  std::vector<std::string> subjects;
  for (const StudyRow& r : rows) addOnce(subjects, r.subject);
  for (const std::string& subject : subjects)
    addSubject(study, rows, subject, trainingOf(training, subject, by_group));
  normalise(study, &SearchSubject::improvement, &SearchSubject::improvement_sd);
  normalise(study, &SearchSubject::decrease, &SearchSubject::decrease_sd);
  study.anovas = {anovaOf(study, "success_improvement", "Improvement of the success rate",
                          [](const SearchSubject& s) { return s.improvement; }),
                  anovaOf(study, "duration_decrease", "Relative decrease of the duration",
                          [](const SearchSubject& s) { return s.decrease; }),
                  anovaOf(study, "sum", "Sum of both, normalised",
                          [](const SearchSubject& s) { return s.sum(); }),
                  anovaOf(study, "maximum", "Larger of both, normalised",
                          [](const SearchSubject& s) { return s.largest(); })};
  correct(study.anovas);
  return study;
}

StudyResult analyseSearchStudy(const std::vector<StudyRow>& rows, const StudyDesign& design) {
  const SearchStudy study = searchStudyOf(rows, design);
  StudyResult result = framedResult(rows, design, "search study");
  result.findings = searchFindings(design, study);
  result.exhibits = searchFigures(rows, design, study);
  result.exhibits.push_back(anovaTable(design, study));
  std::size_t smallest = result.subjects;
  for (const std::vector<double>& group : study.anovas[0].groups)
    smallest = std::min(smallest, group.size());
  result.cautions = cautionsOf(result, smallest);
  result.cautions.push_back(
      "Sum and larger of the two improvements are made of the same figures as the first two "
      "analyses; Edmunds and Pai 2012 chose the last after they had seen the scatter. Only Holm's "
      "p-values allow for looking four times.");
  if (!study.left_out.empty())
    result.cautions.push_back("Left out, since baseline, training or evaluation is missing: " +
                              joined(study.left_out) + ".");
  if (design.as_published)
    result.published_words = {
        "The published analyses take one value a subject, as the table above does: there is no "
        "other way to show. They were not corrected for being four; the column p is as they were, "
        "the column p (Holm) allows for it."};
  return result;
}

}  // namespace palpa::study_analysis
