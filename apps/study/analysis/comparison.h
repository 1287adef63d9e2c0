#pragma once

#include <cstdint>
#include <limits>
#include <string>
#include <vector>

#include "apps/assess/statistics/sample.h"
#include "apps/study/analysis/exhibit.h"
#include "apps/study/analysis/study_design.h"

namespace palpa::study_analysis {

enum class Test { paired, welch };

/// One question: is `a` larger or smaller than `b`? Values are one a subject, unless the published
/// way is asked for.
struct Comparison {
  std::string metric, about;   ///< "time_s"; "novice, force feedback: last two against first two"
  std::string a_name, b_name;  ///< of the two samples, in words
  Test test = Test::welch;
  statistics::Description a, b;
  double difference = kNone, low = kNone,
         high = kNone;                         ///< mean a - mean b, 95 % interval of Student's t
  double boot_low = kNone, boot_high = kNone;  ///< the same by resampling subjects (BCa)
  double t = kNone, degrees = kNone;
  double p = kNone;                   ///< two-sided; one-tailed (a is smaller) in the published way
  double p_holm = kNone;              ///< with all that are tested together
  double effect = kNone;              ///< Hedges' g
  std::vector<std::string> concerns;  ///< why the p-value may be off
  std::string not_tested;             ///< why there is none
  bool tested() const { return not_tested.empty(); }

 private:
  static constexpr double kNone = std::numeric_limits<double>::quiet_NaN();
};

/// Two-sided, with intervals and concerns; `a` and `b` hold a value a subject, pairs in one order.
/// Never throws for samples that cannot be tested: says why.
Comparison compare(Test test, const std::vector<double>& a, const std::vector<double>& b,
                   const std::string& a_name, const std::string& b_name, std::uint64_t seed);

/// Welch, one-tailed (a is smaller), trials pooled as if independent: the way of Tzafestas 2008.
Comparison compareAsPublished(const std::vector<double>& a, const std::vector<double>& b,
                              const std::string& a_name, const std::string& b_name);

/// Fills p_holm of those that were tested.
void correctTogether(const std::vector<Comparison*>& family);

/// 95 % interval of a mean over subjects by Student's t; equal ends for fewer than two.
PlotPoint meanPoint(double x, const std::vector<double>& values);

/// Answers, a row each: what, both samples, difference with intervals, test, p and p after Holm,
/// effect.
Table comparisonTable(const std::vector<Comparison>& all);

/// The same in the published way: p one-tailed, trials counted as n.
Table publishedTable(const std::vector<Comparison>& all);

/// Why something was not tested, what puts a test in doubt; each sentence once.
std::vector<std::string> notesOf(const std::vector<Comparison>& all);

/// Mean, SD, n over subjects (a value each) of every group and condition, a row each, under
/// `metric`'s title.
void addCellRows(Table& table, const std::string& metric, const std::vector<StudyRow>& rows,
                 const StudyDesign& design);
std::vector<Column> cellColumns();

/// All trials of a figure at once, in a mixed model with an intercept a subject: group, condition,
/// trial (per trial, from the middle of the course) and their products by two, groups and
/// conditions as -1/2 and +1/2, so that each question is asked at the mean of the others; what has
/// one level is left out. Where it cannot be fitted, a note says why and the table is empty.
Exhibit mixedExhibit(const std::vector<StudyRow>& rows, const StudyDesign& design,
                     const std::string& metric);

}  // namespace palpa::study_analysis
