#include "apps/cli/trial_samples.h"

namespace palpa::cli {

std::vector<assess::TrialSample> thinned(const std::vector<assess::TrialSample>& samples) {
  constexpr std::size_t kKeep = 10;
  std::vector<assess::TrialSample> kept;
  std::uint32_t events = 0;
  for (std::size_t i = 0; i < samples.size(); ++i) {
    events |= samples[i].events;
    if (i % kKeep != 0 && i + 1 != samples.size()) continue;
    kept.push_back(samples[i]);
    kept.back().events = events;
    events = 0;
  }
  return kept;
}

}  // namespace palpa::cli
