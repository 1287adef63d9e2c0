#pragma once

#include <optional>
#include <vector>

#include "apps/assess/statistics/cusum.h"

namespace palpa::progress {

/// What a trainee's trials in their order say by the rates that the educator set.
struct Competence {
  statistics::CusumRates rates;
  statistics::CusumLimits limits;
  statistics::Cusum chart;
  std::optional<std::size_t>
      reached;  ///< trial (from 1) at which the acceptable rate was accepted; none: never, or an
                ///< unacceptable rate was found after it
  std::optional<std::size_t>
      lost;  ///< trial at which an unacceptable rate was found, and no acceptable one since
  std::size_t minimum = 0;      ///< fewest trials that can certify anybody: the shortest clean run
  std::size_t still_clean = 0;  ///< trials without failure from now on until the acceptable rate is
                                ///< accepted; 0 once it was
  bool tooFew() const { return chart.sums.size() < minimum; }
};

/// Throws UsageError for rates out of range.
Competence competenceOf(const std::vector<bool>& failures, const statistics::CusumRates& rates);

}  // namespace palpa::progress
