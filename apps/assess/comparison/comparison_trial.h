#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "apps/assess/metrics/metric_table.h"
#include "apps/training/trial_words.h"

namespace palpa::assess {

enum class ComparedProperty { stiffness, weight };

/// Two things that differed in one property, felt one after the other; which has more of it?
/// Factors: of the real thing's.
struct ComparisonTrial {
  int trial = 0;
  training::Role role = training::Role::none;
  bool simulated = false, force_feedback = true;
  std::uint64_t seed = 0;
  training::Outcome outcome = training::Outcome::none;
  ComparedProperty property = ComparedProperty::stiffness;
  std::array<double, 2> factors{1, 1};  ///< of the first thing and of the second
  int said = 0;                         ///< which has more: 1 or 2; 0: nothing was said
  double seconds = 0;
  double peak_N = 0;               ///< largest squeezing force that was felt
  std::array<int, 2> grips{0, 0};  ///< how often each was held

  bool answered() const { return outcome == training::Outcome::done && (said == 1 || said == 2); }
  bool right() const { return answered() && (said == 2) == (factors[1] > factors[0]); }
  /// Above 1
  double ratio() const {
    return factors[1] > factors[0] ? factors[1] / factors[0] : factors[0] / factors[1];
  }
};

/// "Right: the second one was harder, by 33 %."
std::string summaryOf(const ComparisonTrial& trial);
/// "harder", "heavier".
const char* moreOf(ComparedProperty property);

/// All figures of a comparison, as metric_table defines them.
std::vector<metrics::MetricValue> comparisonMetrics(const ComparisonTrial& trial);

/// Right answers where the larger was `ratio` times the smaller.
struct SharesAtRatio {
  double ratio = 1;
  int right = 0, of = 0;
};

/// The ratio that is told right in three of four answers. With two things felt one after the other,
/// each with a standard deviation s of the logarithm,
///     P(right) = Phi(|ln ratio| / (sqrt(2) s)),   ratio_75 = exp(0.6745 sqrt(2) s)
/// (Green & Swets 1966: two intervals, a forced choice),
/// s by maximum likelihood; the interval holds what the likelihood ratio does not refuse at 95 %
/// (Wilks 1938). Neither end: the answers do not bound it there.
struct Threshold {
  double ratio = 1;
  std::optional<double> low, high;
};

struct Discrimination {
  std::vector<SharesAtRatio> shares;  ///< by rising ratio
  int right = 0, of = 0;
  /// none: fewer than 8 answers, all right, or no better than chance
  std::optional<Threshold> threshold;
};

/// Of the answered trials about one property.
Discrimination discriminationIn(const std::vector<ComparisonTrial>& trials, ComparedProperty property);

}  // namespace palpa::assess
