#pragma once

#include <optional>
#include <string>
#include <vector>

#include "apps/assess/progress/history.h"
#include "apps/assess/statistics/cusum.h"

namespace palpa::progress {

/// What a trainee's trials in their order say by the rates that the educator set.
struct Competence {
  statistics::CusumRates rates;
  statistics::CusumLimits limits;
  statistics::Cusum chart;
  std::optional<std::size_t>
      /// Trial (from 1) at which the acceptable rate was accepted; none: never, or an unacceptable
      /// rate was found after it
      reached;
  /// trial at which an unacceptable rate was found, and no acceptable one since
  std::optional<std::size_t> lost;
  std::size_t minimum = 0;  ///< fewest trials that can certify anybody: the shortest clean run
  /// Trials without failure from now on until the acceptable rate is accepted; 0 once it was
  std::size_t still_clean = 0;
  bool tooFew() const { return chart.sums.size() < minimum; }
};

/// Throws UsageError for rates out of range.
Competence competenceOf(const std::vector<bool>& failures, const statistics::CusumRates& rates);

/// Days between two times or dates (ISO 8601), the second minus the first; none where one of them
/// is none.
std::optional<int> daysBetween(const std::string& from, const std::string& to);
/// The same day of the month so many months later, or the last day of that month; empty for what is
/// no date.
std::string monthsLater(const std::string& date, int months);

/// A pause of a week or more between two sessions of a series, and what it cost: means of up to
/// three trials before and after it.
struct RetentionGap {
  std::string before_utc, after_utc;
  int days = 0;
  std::size_t before_n = 0, after_n = 0;
  double before = 0, after = 0;
  double loss = 0;  ///< positive: worse than before, in the metric's unit
  /// 95 % of `loss` (bootstrap over trials); none for fewer than three on a side
  std::optional<std::pair<double, double>> interval;
};

inline constexpr int kShortestPause_days = 7;

/// Of a metric with a better direction; a clock that ran backwards makes no pause.
std::vector<RetentionGap> retentionGaps(const Series& series, const std::string& metric);

/// When to test again what was learnt: 6 and 12 months after competence. 82 to 87 % of trainees
/// still pass then (PMID 20881713).
struct RetentionTests {
  std::string six_months, twelve_months;  ///< dates
};
std::optional<RetentionTests> retentionTests(const std::string& competent_utc);

}  // namespace palpa::progress
