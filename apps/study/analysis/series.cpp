#include "apps/study/analysis/series.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "apps/assess/metrics/metric_table.h"

namespace palpa::study_analysis {

using statistics::meanOf;

std::vector<SubjectSeries> seriesOf(const std::vector<StudyRow>& rows, const std::string& metric) {
  std::vector<SubjectSeries> all;
  std::vector<int> counts;
  for (const StudyRow& row : rows) {
    const auto found = std::find_if(all.begin(), all.end(), [&](const SubjectSeries& s) {
      return s.subject == row.subject && s.condition == row.condition;
    });
    const auto at = static_cast<std::size_t>(found - all.begin());
    if (found == all.end()) {
      all.push_back({row.subject, row.group, row.condition, {}, {}});
      counts.push_back(0);
    }
    ++counts[at];
    const double value = row.metric(metric);
    if (!std::isfinite(value)) continue;
    all[at].trials.push_back(counts[at]);
    all[at].values.push_back(value);
  }
  std::erase_if(all, [](const SubjectSeries& s) { return s.values.empty(); });
  return all;
}

std::vector<SubjectSeries> within(const std::vector<SubjectSeries>& all, const std::string& group,
                                  const std::string& condition) {
  std::vector<SubjectSeries> some;
  for (const SubjectSeries& s : all)
    if ((group.empty() || s.group == group) && (condition.empty() || s.condition == condition))
      some.push_back(s);
  return some;
}

std::vector<double> subjectMeans(const std::vector<SubjectSeries>& series) {
  std::vector<double> means;
  for (const SubjectSeries& s : series) means.push_back(meanOf(s.values));
  return means;
}

std::vector<double> pooledTrials(const std::vector<SubjectSeries>& series) {
  std::vector<double> values;
  for (const SubjectSeries& s : series)
    values.insert(values.end(), s.values.begin(), s.values.end());
  return values;
}

std::vector<Learning> learningOf(const std::vector<SubjectSeries>& series) {
  std::vector<Learning> all;
  for (const SubjectSeries& s : series) {
    if (s.values.size() < kTrialsToLearn) continue;
    Learning l{s.subject,
               0,
               0,
               {s.values.begin(), s.values.begin() + 2},
               {s.values.end() - 2, s.values.end()}};
    l.first = meanOf(l.first_trials);
    l.last = meanOf(l.last_trials);
    all.push_back(std::move(l));
  }
  return all;
}

std::vector<double> firstOf(const std::vector<Learning>& all) {
  std::vector<double> values;
  for (const Learning& l : all) values.push_back(l.first);
  return values;
}

std::vector<double> lastOf(const std::vector<Learning>& all) {
  std::vector<double> values;
  for (const Learning& l : all) values.push_back(l.last);
  return values;
}

std::string metricTitle(const std::string& metric) {
  const metrics::MetricDefinition* known = metrics::metricNamed(metric);
  if (!known) return metric;
  const std::string unit = metricUnit(metric);
  return known->title + (unit.empty() ? "" : ", " + unit);
}

std::string metricUnit(const std::string& metric) {
  const metrics::MetricDefinition* known = metrics::metricNamed(metric);
  return known && std::string(known->unit) != "1" ? known->unit : "";
}

}  // namespace palpa::study_analysis
