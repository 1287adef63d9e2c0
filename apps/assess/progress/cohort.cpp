#include "apps/assess/progress/cohort.h"

#include <algorithm>
#include <cmath>
#include <iterator>

#include "anatomy/base/error.h"
#include "apps/assess/progress/competence.h"
#include "apps/assess/statistics/sample.h"

namespace palpa::progress {
namespace {

constexpr std::size_t kLatest = 5, kFewestForInterval = 3;
constexpr std::size_t kFailuresInARow = 3;

std::vector<double> lastKnown(const PracticeView& practice, std::size_t figure, std::size_t most) {
  std::vector<double> known;
  for (std::size_t i = practice.trials.size(); i-- > 0 && known.size() < most;)
    if (const double value = practice.trials[i].figures[figure]; std::isfinite(value))
      known.push_back(value);
  std::reverse(known.begin(), known.end());
  return known;
}

using Interval = std::optional<std::pair<double, double>>;

/// Of the means of these samples; none for too few values.
std::vector<Interval> intervalsOf(const statistics::Samples& samples) {
  statistics::Samples enough;
  for (const std::vector<double>& sample : samples)
    if (sample.size() >= kFewestForInterval) enough.push_back(sample);
  const std::vector<statistics::BootstrapInterval> theirs = statistics::bootstrapMeans(enough);
  std::vector<Interval> all;
  auto next = theirs.begin();
  for (const std::vector<double>& sample : samples) {
    all.emplace_back();
    if (sample.size() < kFewestForInterval) continue;
    all.back() = {next->low, next->high};
    ++next;
  }
  return all;
}

std::vector<GroupMean> groupMeans(const statistics::Samples& of_trainees) {
  const std::vector<Interval> intervals = intervalsOf(of_trainees);
  std::vector<GroupMean> means;
  for (std::size_t i = 0; i < of_trainees.size(); ++i)
    means.push_back({statistics::meanOf(of_trainees[i]), of_trainees[i].size(), intervals[i]});
  return means;
}

std::string times(int count, int of) {
  return std::to_string(count) + " of the last " + std::to_string(of) + " trials";
}

bool failedLately(const std::vector<bool>& failures) {
  return failures.size() >= kFailuresInARow &&
         std::all_of(failures.end() - static_cast<std::ptrdiff_t>(kFailuresInARow), failures.end(),
                     [](bool failure) { return failure; });
}

std::vector<std::string> reasonsFor(const PracticeView& own, const statistics::CusumRates& rates) {
  std::vector<std::string> reasons;
  for (const ErrorCount& count : errorsIn(own))
    if (const std::string metric = count.kind->metric;
        count.recurs() && (metric == "col_lung" || metric == "col_artery"))
      reasons.push_back(count.kind->words + std::string(" in ") +
                        times(count.lately.with, count.lately.of));
  const std::vector<bool> failures = failuresIn(own);
  if (const Competence c = competenceOf(failures, rates); c.lost)
    reasons.push_back("the CUSUM found the unacceptable failure rate at trial " +
                      std::to_string(*c.lost));
  if (failedLately(failures))
    reasons.push_back("the last " + std::to_string(kFailuresInARow) + " trials failed");
  return reasons;
}

}  // namespace

GroupMean groupMean(const std::vector<double>& of_trainees) {
  return groupMeans({of_trainees}).front();
}

std::vector<CommonError> commonErrors(const Series& group) {
  std::vector<CommonError> common;
  statistics::Samples shares;  ///< of each error
  const std::vector<PracticeView> trainees = byTrainee(group);
  for (const ErrorKind& kind : errorKinds(group.engine)) {
    CommonError error{&kind, 0, 0, 0, 0, {}};
    std::vector<double> share;
    for (const PracticeView& own : trainees) {
      const Happened happened = happenedIn(kind, own.trials);
      if (happened.of == 0) continue;
      error.trials += happened.of;
      error.with += happened.with;
      ++error.trainees;
      error.trainees_with += happened.with > 0 ? 1 : 0;
      share.push_back(static_cast<double>(happened.with) / happened.of);
    }
    if (error.with == 0) continue;
    common.push_back(error);
    shares.push_back(std::move(share));
  }
  const std::vector<GroupMean> means = groupMeans(shares);
  for (std::size_t i = 0; i < common.size(); ++i) common[i].share = means[i];
  std::stable_sort(common.begin(), common.end(), [](const CommonError& a, const CommonError& b) {
    return a.share.mean > b.share.mean;
  });
  return common;
}

std::vector<TraineeFigure> traineeFigures(const Series& group, const std::string& metric) {
  std::vector<TraineeFigure> figures;
  statistics::Samples samples;
  const std::size_t number = figureNumber(metric);
  for (const PracticeView& own : byTrainee(group)) {
    std::vector<double> values = lastKnown(own, number, kLatest);
    if (values.empty()) continue;
    figures.push_back({own.trainee(), values, statistics::meanOf(values), {}});
    samples.push_back(std::move(values));
  }
  const std::vector<Interval> intervals = intervalsOf(samples);
  for (std::size_t i = 0; i < figures.size(); ++i) figures[i].interval = intervals[i];
  return figures;
}

namespace {

/// The values at trial 1, 2, ..., as long as enough trainees have one.
statistics::Samples valuesAtTrials(const std::vector<std::vector<double>>& curves) {
  statistics::Samples at_trial;
  for (std::size_t n = 0;; ++n) {
    std::vector<double> values;
    for (const std::vector<double>& own : curves)
      if (n < own.size() && std::isfinite(own[n])) values.push_back(own[n]);
    if (values.size() < kFewestForInterval || 2 * values.size() < curves.size()) return at_trial;
    at_trial.push_back(std::move(values));
  }
}

}  // namespace

GroupCurve groupCurve(const Series& group, const std::string& metric) {
  return groupCurves(group, {metric}).front();
}

std::vector<GroupCurve> groupCurves(const Series& group, const std::vector<std::string>& metrics) {
  std::vector<GroupCurve> all;
  std::vector<std::size_t> lengths;
  statistics::Samples together;
  for (const std::string& metric : metrics) {
    GroupCurve& curve = all.emplace_back();
    for (const PracticeView& own : byTrainee(group)) {
      curve.trainees.push_back(own.trainee());
      curve.curves.push_back(own.values(metric));
    }
    statistics::Samples at_trial = valuesAtTrials(curve.curves);
    lengths.push_back(at_trial.size());
    std::move(at_trial.begin(), at_trial.end(), std::back_inserter(together));
  }
  const std::vector<GroupMean> means = groupMeans(together);
  auto next = means.begin();
  for (std::size_t m = 0; m < all.size(); ++m) {
    const auto end = next + static_cast<std::ptrdiff_t>(lengths[m]);
    all[m].mean.assign(next, end);
    next = end;
  }
  return all;
}

std::vector<Attention> whoNeedsAttention(const Series& group, const statistics::CusumRates& rates) {
  std::vector<Attention> all;
  for (const PracticeView& own : byTrainee(group))
    if (std::vector<std::string> reasons = reasonsFor(own, rates); !reasons.empty())
      all.push_back({own.trainee(), std::move(reasons)});
  std::stable_sort(all.begin(), all.end(), [](const Attention& a, const Attention& b) {
    return a.reasons.size() > b.reasons.size();
  });
  return all;
}

std::optional<Reliability> reliabilityOf(const Series& group, const std::string& metric) {
  std::vector<std::vector<double>> rows;
  const std::size_t number = figureNumber(metric);
  for (const PracticeView& own : byTrainee(group))
    if (std::vector<double> cases = lastKnown(own, number, kFewestCases);
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
