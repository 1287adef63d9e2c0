#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "apps/assess/metrics/metric_table.h"
#include "apps/training/trial_words.h"

namespace palpa::assess {

/// Of what things differ that are felt one after the other.
enum class ComparedProperty { stiffness, weight, friction };

/// Two things or more that differed in one property, felt one after the other. Of two: which has
/// more of it? Of more: their order, from the one with the least.
struct ComparisonTrial {
  int trial = 0;
  training::Role role = training::Role::none;
  bool simulated = false, force_feedback = true;
  std::uint64_t seed = 0;
  training::Outcome outcome = training::Outcome::none;
  ComparedProperty property = ComparedProperty::stiffness;
  std::vector<double> factors{1, 1};  ///< of each thing in turn: times the real one
  int said = 0;                       ///< of two, which has more: 1 or 2; 0: nothing was said
  std::vector<int> order;  ///< of more, their numbers 1, 2, ... as they were said: least first
  double seconds = 0;
  double peak_N = 0;               ///< largest force that was felt: of squeezing, of stroking
  std::vector<int> touches{0, 0};  ///< how often each was held, or stroked over

  bool sorting() const { return factors.size() > 2; }
  bool answered() const;
  bool right() const;
  /// Of two, the larger factor by the smaller.
  double ratio() const;
  /// The numbers of the things in their true order, least first.
  std::vector<int> trueOrder() const;
  /// How near the order that was said is to the true one (Kendall 1938): of all n (n - 1) / 2 pairs
  ///     tau = (pairs said in their true order - pairs said reversed) / all pairs
  /// from -1 to 1. None where no order was said.
  std::optional<double> tau() const;
};

/// "Right: the second one was harder, by 33 %."; of a sorting "Wrong: said 2, 1, 3, 4; from the
/// smoothest it is 1, 2, 3, 4 (tau 0.67)."
std::string summaryOf(const ComparisonTrial& trial);
/// "harder", "heavier", "rougher".
const char* moreOf(ComparedProperty property);
/// "stiffness", "weight", "friction": in files and tables.
const std::string& nameOf(ComparedProperty property);
/// None for an unknown name.
std::optional<ComparedProperty> propertyNamed(std::string_view name);
/// "2, 1, 3, 4".
std::string orderText(const std::vector<int>& order);

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

/// Of the answered trials of two things about one property.
Discrimination discriminationIn(const std::vector<ComparisonTrial>& trials,
                                ComparedProperty property);

}  // namespace palpa::assess
