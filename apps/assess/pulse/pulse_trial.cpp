#include "apps/assess/pulse/pulse_trial.h"

#include <cmath>
#include <cstdio>
#include <limits>

#include "anatomy/base/enum_names.h"

namespace palpa::assess {
namespace {

const EnumNames<PulseRhythm>& rhythmNames() {
  static const EnumNames<PulseRhythm> kNames{"regular", "premature", "irregular"};
  return kNames;
}

constexpr double kMinute_s = 60;
constexpr double kNotFelt_pct = 10;  // of the counted time

std::string rounded(double value, int digits = 0) {
  char text[32];
  std::snprintf(text, sizeof text, "%.*f", digits, value);
  return text;
}

double aMinute(int beats, const PulseRules& rules) { return beats * kMinute_s / rules.count_s; }

std::string foundText(const PulseTrial& trial, const PulseRules& rules) {
  if (!trial.off_m) return "No place was marked";
  return (trial.found(rules) ? "Found (" : "Not found (marked ") + rounded(1e3 * *trial.off_m) +
         " mm beside it)";
}

std::string countText(const PulseTrial& trial, const PulseRules& rules) {
  if (!trial.delivered) return "not counted to the end";
  const std::string delivered = rounded(aMinute(*trial.delivered, rules)) + " a minute delivered";
  return trial.counted ? rounded(aMinute(*trial.counted, rules)) + " counted, " + delivered
                       : "no number was said, " + delivered;
}

std::string rhythmText(const PulseTrial& trial) {
  if (!trial.said) return "the rhythm was not named";
  return trial.told()
             ? std::string(wordsOf(trial.rhythm)) + ": right"
             : std::string("said ") + wordsOf(*trial.said) + ", it was " + wordsOf(trial.rhythm);
}

}  // namespace

const std::string& nameOf(PulseRhythm rhythm) { return rhythmNames().of(rhythm); }

std::optional<PulseRhythm> rhythmNamed(std::string_view name) { return rhythmNames().named(name); }

const char* wordsOf(PulseRhythm rhythm) {
  switch (rhythm) {
    case PulseRhythm::regular:
      return "regular";
    case PulseRhythm::premature:
      return "regular with premature beats";
    case PulseRhythm::irregular:
      break;
  }
  return "irregular";
}

bool PulseTrial::answered() const {
  return outcome == training::Outcome::done && counted.has_value() && said.has_value();
}

std::optional<double> PulseTrial::countError(const PulseRules& rules) const {
  if (!counted || !delivered) return std::nullopt;
  return aMinute(*counted - *delivered, rules);
}

bool PulseTrial::found(const PulseRules& rules) const {
  return off_m && *off_m <= rules.found_within_m;
}

bool PulseTrial::counts(const PulseRules& rules) const {
  const std::optional<double> error = countError(rules);
  return error && std::abs(*error) <= rules.count_within;
}

bool PulseTrial::told() const { return said && *said == rhythm; }

bool PulseTrial::right(const PulseRules& rules) const {
  return answered() && found(rules) && counts(rules) && told();
}

std::string summaryOf(const PulseTrial& trial, const PulseRules& rules) {
  if (trial.outcome == training::Outcome::voided) return "Void";
  return foundText(trial, rules) + "; " + countText(trial, rules) + "; " + rhythmText(trial) + ".";
}

std::vector<PulseItem> pulseChecklist(const PulseTrial& trial, const PulseRules& rules) {
  const auto seen = [](bool known, const std::string& what) {
    return known ? what : std::string("it was not counted");
  };
  return {
      {"The pulse was found", trial.found(rules), foundText(trial, rules)},
      {"It was never pressed too hard", trial.peak_N <= rules.too_hard_N,
       "pressed up to " + rounded(trial.peak_N, 1) + " N"},
      {"The finger stayed on it while counting",
       trial.delivered && trial.off_line_pct <= kNotFelt_pct,
       seen(trial.delivered.has_value(),
            "off the surface for " + rounded(trial.off_line_pct) + " % of the time")},
      {"The artery was not pressed shut while counting",
       trial.delivered && trial.shut_pct <= rules.most_pressed_pct,
       seen(trial.delivered.has_value(), "shut for " + rounded(trial.shut_pct) + " % of the time")},
      {"It was counted right", trial.counts(rules), countText(trial, rules)},
      {"The rhythm was named right", trial.told(), rhythmText(trial)},
      {"It was done in time", trial.answered(), rounded(trial.seconds) + " s"}};
}

std::vector<metrics::MetricValue> pulseMetrics(const PulseTrial& t, const PulseRules& rules) {
  const double none = std::numeric_limits<double>::quiet_NaN();
  const std::optional<double> error = t.countError(rules);
  return {{"success", t.right(rules) ? 1.0 : 0.0},
          {"time_s", t.seconds},
          {"pulse_found", t.found(rules) ? 1.0 : 0.0},
          {"pulse_off_mm", t.off_m ? 1e3 * *t.off_m : none},
          {"pulse_find_s", t.found_s.value_or(none)},
          {"count_error_per_min", error ? std::abs(*error) : none},
          {"rhythm_told", t.told() ? 1.0 : 0.0},
          {"pressed_shut_pct", t.delivered ? t.shut_pct : none},
          {"peak_force_N", t.peak_N}};
}

}  // namespace palpa::assess
