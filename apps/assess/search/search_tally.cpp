#include <algorithm>
#include <iterator>
#include <limits>

#include "apps/assess/search/search_trial.h"
#include "apps/assess/statistics/wilson.h"

namespace palpa::assess {
namespace {

bool sameKind(const SearchTrial& trial, const SearchTally& tally) {
  return counts(trial) && trial.mode == tally.mode && trial.block == tally.block;
}

void fill(SearchTally& tally, const std::vector<SearchTrial>& trials) {
  std::vector<SearchTrial> alike;
  std::copy_if(trials.begin(), trials.end(), std::back_inserter(alike),
               [&](const SearchTrial& trial) { return sameKind(trial, tally); });
  tally.episodes = static_cast<int>(alike.size());
  for (const SearchTrial& trial : alike) {
    tally.chosen += chose(trial);
    tally.found += chose(trial) && trial.found();
  }
  tally.seconds_median = medianSeconds(alike);
  const statistics::ShareInterval interval = statistics::wilson(tally.found, tally.episodes);
  tally.found_share = interval.share;
  tally.found_low = interval.low;
  tally.found_high = interval.high;
}

}  // namespace

double medianSeconds(const std::vector<SearchTrial>& trials) {
  std::vector<double> seconds;
  for (const SearchTrial& trial : trials)
    if (chose(trial)) seconds.push_back(trial.seconds);
  if (seconds.empty()) return std::numeric_limits<double>::quiet_NaN();
  std::sort(seconds.begin(), seconds.end());
  const std::size_t half = seconds.size() / 2;
  return seconds.size() % 2 ? seconds[half] : 0.5 * (seconds[half - 1] + seconds[half]);
}

std::vector<SearchTally> talliesOf(const std::vector<SearchTrial>& trials) {
  std::vector<SearchTally> tallies;
  for (const SearchTrial& trial : trials) {
    if (!counts(trial)) continue;
    if (std::any_of(tallies.begin(), tallies.end(),
                    [&](const SearchTally& tally) { return sameKind(trial, tally); }))
      continue;
    SearchTally& tally = tallies.emplace_back();
    tally.mode = trial.mode;
    tally.block = trial.block;
    fill(tally, trials);
  }
  return tallies;
}

}  // namespace palpa::assess
