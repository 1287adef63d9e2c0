#pragma once

#include <cstddef>
#include <functional>
#include <span>
#include <vector>

#include "apps/assess/needle/trial_assessment.h"

namespace palpa::assess {

using Samples = std::span<const TrialSample>;
using Condition = std::function<bool(const TrialSample&)>;

/// A stretch of the record in which a condition held. Sample i stands for [t_i, t_i+1).
struct Interval {
  std::size_t first = 0, last = 0;  ///< samples, inclusive
  double from_s = 0, to_s = 0;
  double held_s = 0;  ///< time the condition held; bridged gaps left out
};

/// One and a half periods of an 8-12 Hz tremor: contact that returns sooner has not been given up.
inline constexpr double kTremorGap_s = 0.15;

/// All stretches, in order; those closer than `bridge_s` are one.
std::vector<Interval> intervals(Samples samples, const Condition& holds,
                                double bridge_s = kTremorGap_s);

double heldTime(const std::vector<Interval>& stretches);
std::vector<double> startsOf(const std::vector<Interval>& stretches);

/// Indices of the samples in force at 0, 1/rate, 2/rate, ... (the newest not later than each), so
/// that a count means the same at any recording rate. Times before the first sample are left out.
std::vector<std::size_t> scoringSamples(Samples samples, double rate_Hz);

}  // namespace palpa::assess
