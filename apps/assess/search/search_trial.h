#pragma once

#include <array>
#include <cmath>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "apps/assess/metrics/metric_table.h"
#include "apps/assess/trial.h"
#include "apps/training/trial_words.h"

namespace palpa::assess {

/// How the floor of a search is rendered: as stiff as the device bears, a fifth of that, or that
/// with cues added.
enum class SearchMode : std::uint8_t { real, degraded, augmented };
const char* name(SearchMode mode);  ///< "real", "degraded", "augmented"
std::optional<SearchMode> searchModeOf(const std::string& name);

/// One episode of the haptic search task: three elements that look alike in the hand but for their
/// texture; in which pit did the probe stay?
struct SearchTrial {
  int trial = 0;
  training::Role role = training::Role::none;
  bool simulated = false, force_feedback = true;
  std::uint64_t seed = 0;
  training::Outcome outcome = training::Outcome::none;
  std::string block;  ///< "baseline", "training", "evaluation"; empty: none
  SearchMode mode = SearchMode::real;
  /// Of the triangle: where element 0 lies, seen from above, counted from x toward y; the next
  /// follow by 120 each
  double orientation_deg = 0;
  int target = 0;   ///< element, 0 to 2
  int chosen = -1;  ///< element; -1: none
  bool found() const { return chosen == target; }
  double seconds = 0;  ///< pauses left out
  double path_m = 0;   ///< of the probe, in the hand
  /// of the floor and its cues in contact; what holds the handle up is not counted
  double mean_force_N = 0, peak_force_N = 0;
  std::array<double, 3> visited_s{};  ///< seconds on each element
  std::vector<SubtaskDose> doses;
};
std::string summaryOf(const SearchTrial& trial);  ///< one sentence
bool counts(const SearchTrial& trial);            ///< in tallies: scored and not void
bool chose(const SearchTrial& trial);             ///< an element, before the end of the time
double medianSeconds(const std::vector<SearchTrial>&
                         trials);  ///< of the episodes with a choice; no number where there is none

/// What a run of episodes of one mode comes to.
struct SearchTally {
  SearchMode mode = SearchMode::real;
  std::string block;
  int episodes = 0, chosen = 0, found = 0;
  double seconds_median = 0;                              ///< as medianSeconds
  double found_share = 0, found_low = 0, found_high = 0;  ///< Wilson, 95 %
};
/// Of every block and mode that occurs, in the order of their first episode; void and unscored
/// episodes are left out.
std::vector<SearchTally> talliesOf(const std::vector<SearchTrial>& trials);

/// How much of what the degraded device loses the augmented one gives back, of shares found:
///   (augmented - degraded) / (real - degraded)
/// The interval, 95 %, is by the bootstrap over episodes, each mode drawn by itself (Efron 1979):
/// 2.5 % and 97.5 % quantiles of 10,000 resamples.
/// * With k found of n, a resample's episodes are found with probability (k + 1/2) / (n + 1), not
///   k / n: a mode in which all or none was found would not vary at all, and the interval be far
///   too short.
/// * In a resample whose real device is not better than its degraded one the ratio means nothing.
///   It counts against both ends, as minus infinity for the low one and as plus infinity for the
///   high one: where more than 2.5 % are so, the interval is unbounded, as Fieller's is when the
///   denominator may be zero.
/// So `low` is above 0 only if augmented > degraded and real > degraded in 97.5 % of the resamples.
struct Recovery {
  double share = 0, low = 0, high = 0;  ///< low and high may be infinite
  bool bounded() const { return std::isfinite(low) && std::isfinite(high); }
};
/// Nothing where a mode is missing or the real device is not better than the degraded one. The
/// blocks are taken together. Same seed, same interval.
std::optional<Recovery> recoveryOf(const std::vector<SearchTrial>& trials, std::uint64_t seed);

/// All figures of an episode, as metric_table defines them.
std::vector<metrics::MetricValue> searchMetrics(const SearchTrial& trial);

}  // namespace palpa::assess
