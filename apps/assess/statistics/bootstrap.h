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

/// The same of the mean of each sample: every interval is the one that `bootstrap` gives of it
/// alone (same draws; to rounding). Draws depend on a sample's size only, so those of one size
/// share them: a thousand intervals cost little more than one.
std::vector<BootstrapInterval> bootstrapMeans(const Samples& samples,
                                              const BootstrapSettings& settings = {});

}  // namespace palpa::statistics
