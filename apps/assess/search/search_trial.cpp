#include "apps/assess/search/search_trial.h"
#include "apps/assess/trial_role.h"

namespace palpa::assess {

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
  return countsAsScored(trial.role) && trial.outcome != "void";
}

bool chose(const SearchTrial& trial) { return trial.outcome == "done" && trial.chosen >= 0; }

std::string summaryOf(const SearchTrial& trial) {
  if (trial.outcome == "void") return "Void: it does not count.";
  if (trial.outcome == "time") return "The time was over before the probe stayed in a pit.";
  if (trial.outcome == "aborted") return "Aborted before the probe stayed in a pit.";
  if (!chose(trial)) return "The probe stayed in no pit.";
  const std::string after = " after " + std::to_string(std::lround(trial.seconds)) + " s.";
  return trial.found() ? "Found: the probe stayed in the target's pit" + after
                       : "Not found: the probe stayed in the pit of another element" + after;
}

}  // namespace palpa::assess
