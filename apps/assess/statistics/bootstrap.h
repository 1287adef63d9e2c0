#pragma once

#include <cstdint>
#include <functional>
#include <vector>

namespace palpa::statistics {

using Samples = std::vector<std::vector<double>>;  ///< one sample, or several drawn from apart

struct BootstrapInterval {
  double value = 0;  ///< of the samples themselves
  double low = 0, high = 0;
};

struct BootstrapSettings {
  int draws = 2000;
  double level = 0.95;
  std::uint64_t seed = 1;  ///< the same seed gives the same interval
};

/// Interval of any figure of one or several samples: resampled with replacement, corrected for bias
/// and acceleration (BCa). Resample what is independent: subjects, not their trials. Source: Efron,
/// J. Am. Stat. Assoc. 82, 1987. Where the figure is the same in all draws the interval is that
/// point. Throws Error for an empty sample and settings out of range (200 draws at least, level
/// within (0, 1)).
BootstrapInterval bootstrap(const Samples& samples,
                            const std::function<double(const Samples&)>& figure,
                            const BootstrapSettings& settings = {});

/// The same of one sample's mean.
BootstrapInterval bootstrapMean(const std::vector<double>& values,
                                const BootstrapSettings& settings = {});

}  // namespace palpa::statistics
