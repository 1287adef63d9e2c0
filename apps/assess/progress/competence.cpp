#include "apps/assess/progress/competence.h"

#include <algorithm>
#include <cmath>

#include "anatomy/base/utc.h"
#include "apps/assess/statistics/bootstrap.h"
#include "apps/assess/statistics/sample.h"

namespace palpa::progress {

using statistics::CusumVerdict;

Competence competenceOf(const std::vector<bool>& failures, const statistics::CusumRates& rates) {
  Competence c;
  c.rates = rates;
  c.limits = statistics::cusumLimits(rates);
  c.chart = statistics::cusum(failures, c.limits);
  c.minimum = static_cast<std::size_t>(c.limits.shortest_clean_run);
  for (std::size_t i = 0; i < c.chart.verdicts.size(); ++i) {
    const CusumVerdict verdict = c.chart.verdicts[i];
    if (verdict == CusumVerdict::unacceptable) {
      c.reached.reset();
      c.lost = i + 1;
    }
    if (verdict == CusumVerdict::acceptable) {
      if (!c.reached) c.reached = i + 1;
      c.lost.reset();
    }
  }
  if (c.reached) return c;
  const bool anew = c.chart.sums.empty() || c.chart.verdicts.back() != CusumVerdict::undecided;
  const double sum = anew ? 0 : c.chart.sums.back();
  c.still_clean =
      static_cast<std::size_t>(std::ceil((sum + c.limits.h_accept) / c.limits.s - 1e-9));
  return c;
}

namespace {

constexpr std::size_t kAroundPause =
    3;  // trials on each side: more of them would relearn what was lost

RetentionGap gapAt(const Series& series, const std::string& metric, std::size_t first, int days) {
  std::vector<double> before, after;
  for (std::size_t i = first - std::min(first, kAroundPause); i < first; ++i)
    before.push_back(series.trials[i].metric(metric));
  for (std::size_t i = first; i < std::min(series.trials.size(), first + kAroundPause); ++i)
    after.push_back(series.trials[i].metric(metric));
  before = finite(std::move(before));
  after = finite(std::move(after));
  RetentionGap gap{series.trials[first - 1].started_utc,
                   series.trials[first].started_utc,
                   days,
                   before.size(),
                   after.size(),
                   statistics::meanOf(before),
                   statistics::meanOf(after),
                   0,
                   std::nullopt};
  const double sign = metrics::metricNamed(metric)->better == metrics::Better::lower ? 1 : -1;
  gap.loss = sign * (gap.after - gap.before);
  if (before.size() < kAroundPause || after.size() < kAroundPause) return gap;
  const auto interval = statistics::bootstrap({before, after}, [&](const statistics::Samples& s) {
    return sign * (statistics::meanOf(s[1]) - statistics::meanOf(s[0]));
  });
  gap.interval = {interval.low, interval.high};
  return gap;
}

}  // namespace

std::optional<int> daysBetween(const std::string& from, const std::string& to) {
  const auto a = dateIn(from), b = dateIn(to);
  if (!a || !b) return std::nullopt;
  return static_cast<int>((std::chrono::sys_days(*b) - std::chrono::sys_days(*a)).count());
}

std::string monthsLater(const std::string& date, int months) {
  const auto from = dateIn(date);
  if (!from) return "";
  std::chrono::year_month_day later = *from + std::chrono::months(months);
  if (!later.ok()) later = later.year() / later.month() / std::chrono::last;
  return isoDate(later);
}

std::vector<RetentionGap> retentionGaps(const Series& series, const std::string& metric) {
  std::vector<RetentionGap> gaps;
  const metrics::MetricDefinition* definition = metrics::metricNamed(metric);
  if (!definition || definition->better == metrics::Better::neither) return gaps;
  for (std::size_t i = 1; i < series.trials.size(); ++i) {
    const std::optional<int> days =
        daysBetween(series.trials[i - 1].started_utc, series.trials[i].started_utc);
    if (!days || *days < kShortestPause_days) continue;
    if (const RetentionGap gap = gapAt(series, metric, i, *days);
        gap.before_n > 0 && gap.after_n > 0)
      gaps.push_back(gap);
  }
  return gaps;
}

std::optional<RetentionTests> retentionTests(const std::string& competent_utc) {
  const std::string six = monthsLater(competent_utc, 6), twelve = monthsLater(competent_utc, 12);
  if (six.empty()) return std::nullopt;
  return RetentionTests{six, twelve};
}

}  // namespace palpa::progress
