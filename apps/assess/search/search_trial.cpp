#include "apps/assess/search/search_trial.h"

#include <algorithm>
#include <iterator>
#include <limits>

#include "anatomy/base/quantile.h"
#include "anatomy/base/random.h"
#include "apps/assess/statistics/sample.h"

namespace palpa::assess {

using training::Outcome;

const char* name(SearchMode mode) {
  switch (mode) {
    case SearchMode::degraded:
      return "degraded";
    case SearchMode::augmented:
      return "augmented";
    default:
      return "real";
  }
}

std::optional<SearchMode> searchModeOf(const std::string& text) {
  for (const SearchMode mode : {SearchMode::real, SearchMode::degraded, SearchMode::augmented})
    if (text == name(mode)) return mode;
  return std::nullopt;
}

bool counts(const SearchTrial& trial) {
  return training::countsAsScored(trial.role, trial.outcome);
}

bool chose(const SearchTrial& trial) { return trial.outcome == Outcome::done && trial.chosen >= 0; }

std::string summaryOf(const SearchTrial& trial) {
  if (trial.outcome == Outcome::voided) return "Void: it does not count.";
  if (trial.outcome == Outcome::time) return "The time was over before the probe stayed in a pit.";
  if (trial.outcome == Outcome::aborted) return "Aborted before the probe stayed in a pit.";
  if (!chose(trial)) return "The probe stayed in no pit.";
  const std::string after = " after " + std::to_string(std::lround(trial.seconds)) + " s.";
  return trial.found() ? "Found: the probe stayed in the target's pit" + after
                       : "Not found: the probe stayed in the pit of another element" + after;
}

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
  return median(std::move(seconds));
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

namespace {

constexpr int kResamples = 10'000;
constexpr std::size_t kBeyond = kResamples / 40;  // 2.5 % of the resamples lie beyond either end
constexpr double kNoEnd = std::numeric_limits<double>::infinity();

struct FoundOf {
  int found = 0, of = 0;
  double share() const { return static_cast<double>(found) / of; }
};

FoundOf foundIn(const std::vector<SearchTrial>& trials, SearchMode mode) {
  FoundOf sum;
  for (const SearchTrial& trial : trials) {
    if (!counts(trial) || trial.mode != mode) continue;
    ++sum.of;
    sum.found += chose(trial) && trial.found();
  }
  return sum;
}

double resampledShare(const FoundOf& seen, RandomStream& random) {
  const double likely = (seen.found + 0.5) / (seen.of + 1);
  FoundOf drawn{0, seen.of};
  for (int i = 0; i < seen.of; ++i) drawn.found += random.openUniform() < likely;
  return drawn.share();
}

}  // namespace

std::optional<Recovery> recoveryOf(const std::vector<SearchTrial>& trials, std::uint64_t seed) {
  const FoundOf real = foundIn(trials, SearchMode::real),
                degraded = foundIn(trials, SearchMode::degraded),
                augmented = foundIn(trials, SearchMode::augmented);
  if (real.of == 0 || degraded.of == 0 || augmented.of == 0 || !(real.share() > degraded.share()))
    return std::nullopt;
  Recovery recovery{(augmented.share() - degraded.share()) / (real.share() - degraded.share()),
                    -kNoEnd, kNoEnd};
  RandomStream random = RandomStream::ofSeed(seed);
  std::vector<double> shares;
  for (int i = 0; i < kResamples; ++i) {
    const double r = resampledShare(real, random), d = resampledShare(degraded, random),
                 a = resampledShare(augmented, random);
    if (r > d) shares.push_back((a - d) / (r - d));
  }
  const std::size_t without = kResamples - shares.size();  // a ratio
  if (without > kBeyond) return recovery;
  std::sort(shares.begin(), shares.end());
  recovery.low = shares[kBeyond - without];
  recovery.high = shares[shares.size() - 1 - (kBeyond - without)];
  return recovery;
}

std::vector<metrics::MetricValue> searchMetrics(const SearchTrial& t) {
  return {{"success", t.found() ? 1.0 : 0.0},
          {"time_s", t.seconds},
          {"chosen", chose(t) ? 1.0 : 0.0},
          {"path_length_mm", 1e3 * t.path_m},
          {"mean_speed_mm_s",
           t.seconds > 0 ? 1e3 * t.path_m / t.seconds : std::numeric_limits<double>::quiet_NaN()},
          {"peak_force_N", t.peak_force_N},
          {"mean_force_N",
           t.peak_force_N > 0 ? t.mean_force_N : std::numeric_limits<double>::quiet_NaN()}};
}

}  // namespace palpa::assess
