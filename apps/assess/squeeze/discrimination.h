#pragma once

#include <optional>
#include <vector>

#include "apps/assess/squeeze/squeeze_trial.h"

namespace palpa::assess {

/// Right answers where the larger was `ratio` times the smaller.
struct SharesAtRatio {
  double ratio = 1;
  int right = 0, of = 0;
};

/// The ratio that is told right in three of four answers. With two things felt one after the other,
/// each with a standard deviation s of the logarithm,
///     P(right) = Phi(|ln ratio| / (sqrt(2) s)),   ratio_75 = exp(0.6745 sqrt(2) s) (Green & Swets
///     1966: two intervals, a forced choice)
/// s by maximum likelihood; the interval holds what the likelihood ratio does not refuse at 95 %
/// (Wilks 1938). Neither end: the answers do not bound it there.
struct Threshold {
  double ratio = 1;
  std::optional<double> low, high;
};

struct Discrimination {
  std::vector<SharesAtRatio> shares;  ///< by rising ratio
  int right = 0, of = 0;
  std::optional<Threshold>
      threshold;  ///< none: fewer than 8 answers, all right, or no better than chance
};

/// Of the answered trials about one property.
Discrimination discriminationIn(const std::vector<SqueezeTrial>& trials, SqueezedProperty property);

}  // namespace palpa::assess
