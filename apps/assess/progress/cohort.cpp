#include "apps/assess/progress/cohort.h"

#include <algorithm>
#include <cmath>

#include "anatomy/base/error.h"
#include "apps/assess/progress/competence.h"
#include "apps/assess/statistics/sample.h"

namespace palpa::progress {
namespace {

constexpr std::size_t kLatest = 5, kFewestForInterval = 3;
constexpr std::size_t kFailuresInARow = 3;

std::vector<double> lastKnown(const Series& series, const std::string& metric, std::size_t most) {
  std::vector<double> known;
  for (const double value : series.values(metric))
    if (std::isfinite(value)) known.push_back(value);
  if (known.size() > most)
    known.erase(known.begin(), known.end() - static_cast<std::ptrdiff_t>(most));
  return known;
}

/// Of a mean; none for too few.
std::optional<std::pair<double, double>> intervalOf(const std::vector<double>& values) {
  if (values.size() < kFewestForInterval) return std::nullopt;
  const statistics::BootstrapInterval interval = statistics::bootstrapMean(values);
  return std::pair{interval.low, interval.high};
}

std::string times(int count, int of) {
  return std::to_string(count) + " of the last " + std::to_string(of) + " trials";
}

bool failedLately(const Series& own) {
  if (own.trials.size() < kFailuresInARow) return false;
  return std::all_of(own.trials.end() - static_cast<std::ptrdiff_t>(kFailuresInARow),
                     own.trials.end(), failed);
}

std::vector<std::string> reasonsFor(const Series& own, const statistics::CusumRates& rates) {
  std::vector<std::string> reasons;
  for (const ErrorCount& count : errorsIn(own))
    if (const std::string metric = count.kind->metric;
        count.recurs() && (metric == "col_lung" || metric == "col_artery"))
      reasons.push_back(count.kind->words + std::string(" in ") +
                        times(count.lately, count.lately_of));
  std::vector<bool> failures;
  for (const PracticeTrial& trial : own.trials) failures.push_back(failed(trial));
  if (const Competence c = competenceOf(failures, rates); c.lost)
    reasons.push_back("the CUSUM found the unacceptable failure rate at trial " +
                      std::to_string(*c.lost));
  if (failedLately(own))
    reasons.push_back("the last " + std::to_string(kFailuresInARow) + " trials failed");
  return reasons;
}

}  // namespace

GroupMean groupMean(const std::vector<double>& of_trainees) {
  return {statistics::meanOf(of_trainees), of_trainees.size(), intervalOf(of_trainees)};
}

std::vector<CommonError> commonErrors(const Series& group) {
  std::vector<CommonError> common;
  const std::vector<Series> trainees = byTrainee(group);
  for (const ErrorKind& kind : errorKinds(group.engine)) {
    CommonError error{&kind, 0, 0, 0, 0, {}};
    std::vector<double> shares;
    for (const Series& own : trainees) {
      int with = 0, of = 0;
      for (const PracticeTrial& trial : own.trials) {
        if (!std::isfinite(trial.metric(kind.metric))) continue;
        ++of;
        with += happened(kind, trial) ? 1 : 0;
      }
      if (of == 0) continue;
      error.trials += of;
      error.with += with;
      ++error.trainees;
      error.trainees_with += with > 0 ? 1 : 0;
      shares.push_back(static_cast<double>(with) / of);
    }
    if (error.with == 0) continue;
    error.share = groupMean(shares);
    common.push_back(error);
  }
  std::stable_sort(common.begin(), common.end(), [](const CommonError& a, const CommonError& b) {
    return a.share.mean > b.share.mean;
  });
  return common;
}

std::vector<TraineeFigure> traineeFigures(const Series& group, const std::string& metric) {
  std::vector<TraineeFigure> figures;
  for (const Series& own : byTrainee(group)) {
    TraineeFigure figure{own.trials.front().trainee, lastKnown(own, metric, kLatest), 0, {}};
    if (figure.values.empty()) continue;
    figure.mean = statistics::meanOf(figure.values);
    figure.interval = intervalOf(figure.values);
    figures.push_back(std::move(figure));
  }
  return figures;
}

GroupCurve groupCurve(const Series& group, const std::string& metric) {
  GroupCurve curve;
  std::size_t longest = 0;
  for (const Series& own : byTrainee(group)) {
    curve.trainees.push_back(own.trials.front().trainee);
    curve.curves.push_back(own.values(metric));
    longest = std::max(longest, own.trials.size());
  }
  for (std::size_t n = 0; n < longest; ++n) {
    std::vector<double> values;
    for (const std::vector<double>& own : curve.curves)
      if (n < own.size() && std::isfinite(own[n])) values.push_back(own[n]);
    if (values.size() < kFewestForInterval || 2 * values.size() < curve.curves.size()) break;
    curve.mean.push_back(groupMean(values));
  }
  return curve;
}

std::vector<Attention> whoNeedsAttention(const Series& group, const statistics::CusumRates& rates) {
  std::vector<Attention> all;
  for (const Series& own : byTrainee(group))
    if (std::vector<std::string> reasons = reasonsFor(own, rates); !reasons.empty())
      all.push_back({own.trials.front().trainee, std::move(reasons)});
  std::stable_sort(all.begin(), all.end(), [](const Attention& a, const Attention& b) {
    return a.reasons.size() > b.reasons.size();
  });
  return all;
}

std::optional<Reliability> reliabilityOf(const Series& group, const std::string& metric) {
  std::vector<std::vector<double>> rows;
  for (const Series& own : byTrainee(group))
    if (std::vector<double> cases = lastKnown(own, metric, kFewestCases);
        cases.size() == kFewestCases)
      rows.push_back(std::move(cases));
  if (rows.size() < 2) return std::nullopt;
  Eigen::MatrixXd table(static_cast<Eigen::Index>(rows.size()),
                        static_cast<Eigen::Index>(kFewestCases));
  for (std::size_t r = 0; r < rows.size(); ++r)
    for (std::size_t c = 0; c < kFewestCases; ++c)
      table(static_cast<Eigen::Index>(r), static_cast<Eigen::Index>(c)) = rows[r][c];
  try {
    return Reliability{rows.size(), kFewestCases,
                       statistics::raterAgreement(table).consistency_mean};
  } catch (const Error&) {  // they do not differ at all
    return std::nullopt;
  }
}

}  // namespace palpa::progress
