#pragma once

#include <cmath>
#include <string>
#include <variant>
#include <vector>

#include "apps/study/analysis/study_design.h"

namespace palpa::study_analysis::test {

inline StudyRow row(const std::string& subject, const std::string& group,
                    const std::string& condition, const std::string& block, int trial,
                    std::map<std::string, double> metrics) {
  return {subject, group, condition, block, 1, trial, 0, false, "palpa 0.1.0", std::move(metrics)};
}

/// n values with exactly this mean and standard deviation.
inline std::vector<double> valuesWith(double mean, double sd, int n) {
  std::vector<double> z;
  double sum = 0, squares = 0;
  for (int i = 0; i < n; ++i) {
    z.push_back(std::sin(1.7 * i) + 0.3 * (i % 3));
    sum += z.back();
  }
  for (double& v : z) {
    v -= sum / n;
    squares += v * v;
  }
  for (double& v : z) v = mean + v * sd / std::sqrt(squares / (n - 1));
  return z;
}

inline Exhibit exhibit(const StudyResult& result, const std::string& id) {
  for (const Exhibit& e : result.exhibits)
    if (e.id == id) return e;
  return {};
}

/// The number in a column of a row; not a number where there is none.
inline double at(const Exhibit& e, std::size_t row, const std::string& column) {
  for (std::size_t c = 0; c < e.table.columns.size(); ++c)
    if (e.table.columns[c].name == column && row < e.table.rows.size())
      return std::get<double>(e.table.rows[row][c]);
  return std::nan("");
}

/// The pilot as Tzafestas et al. 2008 had it, the published way beside.
inline StudyDesign pilotDesign() {
  StudyDesign design;
  design.kind = StudyKind::paracentesis_pilot;
  design.title = "Pilot";
  design.groups = {"novice", "experienced"};
  design.conditions = {"NO", "FF"};
  design.words = {{"NO", "without force feedback"}, {"FF", "with force feedback"}};
  design.as_published = true;
  return design;
}

}  // namespace palpa::study_analysis::test
