#pragma once

#include "apps/report/search/search_report.h"
#include "apps/training/trial_words.h"

namespace palpa::report::test {

inline assess::SearchTrial searched(int trial, assess::SearchMode mode, bool found,
                                    double seconds) {
  assess::SearchTrial t;
  t.trial = trial;
  t.role = training::Role::scored;
  t.outcome = training::Outcome::done;
  t.seed = static_cast<std::uint64_t>(100 + trial);
  t.mode = mode;
  t.orientation_deg = 37.0 * trial;
  t.target = trial % 3;
  t.chosen = found ? t.target : (t.target + 1) % 3;
  t.seconds = seconds;
  t.path_m = 0.02 * seconds;
  t.mean_force_N = 0.8;
  t.peak_force_N = 3.25;
  t.visited_s[static_cast<std::size_t>(t.target)] = 0.5 * seconds;
  t.visited_s[static_cast<std::size_t>((t.target + 1) % 3)] = 0.25 * seconds;
  const bool cues = mode == assess::SearchMode::augmented;
  t.doses = {{"scan", 0.5 * seconds, 7, cues ? 0.5 : 0, cues ? 0.25 : 0},
             {"shape assessment", 0.25 * seconds, 4, cues ? 2.0 : 0, cues ? 3.0 : 0},
             {"identification", 0.125 * seconds, 5, 0, 0}};
  return t;
}

/// Ten episodes with full stiffness, all found; ten degraded, four found; ten augmented, eight
/// found.
inline SearchReport searchedSession() {
  SearchReport report;
  report.title = "Find the rough one";
  report.trainee = "T007";
  report.subtasks = {{"scan", "the probe moves fast over the floor"},
                     {"shape assessment", "the probe moves slowly, along a groove or a pit"},
                     {"identification", "the probe strokes a rough disc"}};
  report.unit_note = "1 U = 0.06 mm in the hand";
  report.station = {{"Device", "virtual", "no hardware"}, {"Software", "palpa 0.1.0", ""}};
  report.notes = {{"Late ticks", "0 of 1 200 000", ""}};
  report.taxonomy = {{"Where it is real", "nowhere", "everything is rendered"}};
  int trial = 0;
  for (int i = 0; i < 10; ++i) {
    report.trials.push_back(searched(++trial, assess::SearchMode::real, true, 12 + i % 7));
    report.trials.push_back(
        searched(++trial, assess::SearchMode::degraded, i % 5 < 2, 31 + 3 * (i % 6)));
    report.trials.push_back(
        searched(++trial, assess::SearchMode::augmented, i % 5 < 4, 19 + 2 * (i % 5)));
  }
  return report;
}

}  // namespace palpa::report::test
