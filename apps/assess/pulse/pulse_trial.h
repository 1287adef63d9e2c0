#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "apps/assess/metrics/metric_table.h"
#include "apps/training/trial_words.h"

namespace palpa::assess {

/// What an examiner tells apart by feel: a sinus rhythm; the same with premature beats;
/// fibrillation of the atria.
enum class PulseRhythm : std::uint8_t { regular, premature, irregular };
/// "regular", "premature", "irregular": in files and tables.
const std::string& nameOf(PulseRhythm rhythm);
/// None for an unknown name.
std::optional<PulseRhythm> rhythmNamed(std::string_view name);
/// "regular", "regular with premature beats", "irregular".
const char* wordsOf(PulseRhythm rhythm);

/// What a task's file says of how a pulse is judged.
struct PulseRules {
  double found_within_m = 0.006;  ///< of the artery's line
  double count_within = 3;        ///< beats a minute
  double count_s = 30;            ///< so long is counted
  double touch_N = 0.1;           ///< from here on it is touched
  double too_hard_N = 2;
  double time_limit_s = 180;     ///< of all of it
  double most_pressed_pct = 20;  ///< of the count's time the artery may be pressed shut
};

/// One trial: find it, count it, name the rhythm.
struct PulseTrial {
  int trial = 0;
  training::Role role = training::Role::none;
  bool simulated = false, force_feedback = true;
  std::uint64_t seed = 0;
  training::Outcome outcome = training::Outcome::none;
  std::string artery;  ///< "radial", ...
  double depth_m = 0;
  PulseRhythm rhythm = PulseRhythm::regular;
  std::optional<double>
      off_m;  ///< of the last mark from the artery's line; none: nothing was marked
  std::optional<double> found_s;  ///< when that was, of the trial
  std::optional<int>
      delivered;  ///< beats within the counted time; none: it was not counted to its end
  std::optional<int> counted;  ///< as was said
  std::optional<PulseRhythm> said;
  double seconds = 0;       ///< pauses left out
  double peak_N = 0;        ///< largest force on the surface
  double shut_pct = 0;      ///< of the counted time, the artery was pressed shut
  double off_line_pct = 0;  ///< of the counted time, nothing of it was touched

  bool answered() const;
  /// Beats a minute, said less delivered.
  std::optional<double> countError(const PulseRules& rules) const;
  bool found(const PulseRules& rules) const;
  bool counts(const PulseRules& rules) const;  ///< the count was right
  bool told() const;                           ///< the rhythm was
  bool right(const PulseRules& rules) const;   ///< all three
};

/// "Found (2 mm beside it); 74 a minute counted, 72 delivered; irregular: right."
std::string summaryOf(const PulseTrial& trial, const PulseRules& rules);

/// What a good examiner does.
struct PulseItem {
  std::string text;
  bool done = false;
  std::string why;  ///< what was seen
};
std::vector<PulseItem> pulseChecklist(const PulseTrial& trial, const PulseRules& rules);

/// All figures of a trial, as metric_table defines them.
std::vector<metrics::MetricValue> pulseMetrics(const PulseTrial& trial, const PulseRules& rules);

}  // namespace palpa::assess
