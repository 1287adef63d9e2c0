#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "apps/assess/pulse/pulse_trial.h"
#include "apps/report/page/html.h"
#include "apps/report/page/session_page.h"

namespace palpa::report {

struct PulseReport : SessionPage {
  assess::PulseRules rules;
  std::vector<assess::PulseTrial> trials;
  std::vector<Picture> pictures;
};

/// One self-contained HTML page: how many were found, counted and told; each trial with what was
/// wrong; the checklist over all trials. All or nothing on disk.
void writePulseReport(const PulseReport& report, const std::filesystem::path& file);

/// trials.csv: header row, then one row a trial that counts. No date, no path. Yes and no as 1 and
/// 0; empty: it does not apply.
///   USER_ID TRIAL SEED SIMULATED FF OUTCOME ARTERY DEPTH_MM RHYTHM (regular, premature, irregular)
///   SAID RIGHT FOUND OFF_MM FIND_S DELIVERED COUNTED (beats in the counted time) ERROR_PER_MIN
///   RHYTHM_TOLD SHUT_PCT PEAK_N TIME_S
void writePulseCsv(const std::string& user_id, const std::vector<assess::PulseTrial>& trials,
                   const assess::PulseRules& rules, const std::filesystem::path& file);

/// Beats a minute said over those delivered, every trial a dot, the line where both are equal and
/// the margin of what counts as right.
void writeCountChart(Html& html, const PulseReport& report);

}  // namespace palpa::report
