#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "apps/assess/metrics/metric_table.h"
#include "apps/assess/statistics/sample.h"

namespace palpa::progress {

/// y(n) = a + b exp(-(n - 1) / c) fitted to values of trials n = 1, 2, ... by least squares: c from
/// a grid of 120 values between half a trial and three times their number, a and b exactly for
/// each. Source of the form: Heathcote, Brown, Mewhort, Psychon. Bull. Rev. 7, 2000 (a single
/// learner's curve is exponential; the power law is what averages of many look like). The band
/// holds the curve at each trial in 95 of 100 draws of the residuals (1000 draws, residuals times
/// sqrt(N / (N - 3)), seeded): a band about the curve, not about single trials.
struct LearningCurve {
  double asymptote = 0, gain = 0, constant = 0;  ///< a; b: above it at the first trial; c, trials
  double spread = 0;           ///< of trials about the curve: sqrt(sum of squares / (N - 3))
  std::vector<double> trials;  ///< n of the values that apply
  std::vector<double> fitted, low, high;               ///< at n = 1 ... N
  double change = 0, change_low = 0, change_high = 0;  ///< y(N) - y(1), and its 95 % interval
  /// 95 of 100 draws have the same sign of change.
  bool changed() const { return change_low > 0 || change_high < 0; }
};

/// Fewest values that a curve is fitted to.
inline constexpr std::size_t kFewestForCurve = 8;

/// None for fewer than eight values that are numbers, and where nothing varies.
std::optional<LearningCurve> learningCurve(const std::vector<double>& values,
                                           std::uint64_t seed = 1);

/// What a metric was at first and is now: means of the first and the last k trials, k a third of
/// them, at least 3 and at most 5.
struct Change {
  std::string metric;
  std::size_t each = 0;  ///< k
  double first = 0, last = 0;
  double difference = 0, low = 0,
         high = 0;  ///< last - first; 95 % interval (bootstrap over trials, BCa)
  enum class ChangeVerdict {
    better,
    worse,
    unclear
  } verdict = ChangeVerdict::unclear;  ///< unclear: the interval holds 0
};

/// None for fewer than six values that are numbers, and for a figure of which neither direction is
/// better.
std::optional<Change> changeOf(const std::string& metric, const std::vector<double>& values);

/// Successes among trials `from` ... `to` (from 1).
struct SuccessBlock {
  std::size_t from = 0, to = 0;
  int hits = 0, of = 0;
  statistics::ShareInterval share;
};
/// Blocks of `size` trials one after the other; what is left over joins the last.
std::vector<SuccessBlock> successBlocks(const std::vector<bool>& successes, std::size_t size = 5);

}  // namespace palpa::progress
