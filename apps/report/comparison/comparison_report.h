#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "apps/assess/comparison/comparison_trial.h"
#include "apps/report/page/html.h"
#include "apps/report/page/session_page.h"

namespace palpa::report {

struct ComparisonReport : SessionPage {
  double too_hard_N = 0;
  std::vector<assess::ComparisonTrial> trials;
  std::vector<Picture> pictures;
};

/// One self-contained HTML page: what was told apart and how well, by difference, then each answer;
/// of orders, each beside the true one. All or nothing on disk.
void writeComparisonReport(const ComparisonReport& report, const std::filesystem::path& file);

/// trials.csv: header row, then one row a trial that counts. No date, no path. Factors are of the
/// real object's; forces in N; yes and no as 1 and 0.
///   USER_ID TRIAL SEED SIMULATED FF OUTCOME PROPERTY (stiffness, weight, friction)
/// of two things
///   FIRST SECOND SAID (which has more: 1, 2; 0: nothing was said) RIGHT PEAK_N TIME_S, and how
///   often each was touched: GRIPS_FIRST GRIPS_SECOND, of friction TOUCHES_FIRST TOUCHES_SECOND
/// of more, lists with spaces between, numbers 1, 2, ... in the order in which they lay there
///   FACTORS ORDER (said, from the smoothest) TRUE_ORDER RIGHT TAU (Kendall's; empty: no order was
///   said) PEAK_N TIME_S TOUCHES
/// All trials are of one kind, the first one's.
void writeComparisonCsv(const std::string& user_id,
                        const std::vector<assess::ComparisonTrial>& trials,
                        const std::filesystem::path& file);

/// How much more than the other, of a ratio: "25 %" of 1.25.
std::string percentMore(double ratio);

/// Shares of right answers with their 95 % intervals over how much more the one had, and what
/// chance would give.
void writeComparisonChart(Html& html, const assess::Discrimination& answers, const char* what);

}  // namespace palpa::report
