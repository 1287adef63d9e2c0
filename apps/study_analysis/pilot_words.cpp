#include <cmath>

#include "apps/study_analysis/pilot.h"
#include "apps/study_analysis/words.h"

namespace palpa::study_analysis {
namespace {

constexpr double kLevel = 0.05;

/// "31 % faster", "12 % more penalty points".
std::string changeWords(const std::string& metric, double fall) {
  const bool less = fall >= 0;
  const std::string size = percent(std::abs(fall));
  if (metric == "time_s") return size + (less ? " faster" : " slower");
  return size + (less ? " fewer" : " more") + " penalty points";
}

/// What the p-value after Holm's correction allows to say.
std::string verdictOf(const Comparison& c) {
  const std::string p = pWords(c.p) + ", " + pWords(c.p_holm) + " with all tests of this page";
  if (c.p_holm < kLevel) return "More than chance explains (" + p + ").";
  if (c.p < kLevel)
    return "Taken alone more than chance explains, but not among all tests of this page (" + p +
           ").";
  return "Chance may explain it (" + p + ").";
}

std::string learningFinding(const StudyDesign& design, const LearningCell& cell) {
  const std::string who =
      inWords(design, cell.group) + ", " + inWords(design, cell.condition) + ": ";
  if (!cell.test.tested())
    return who + "learning in " + metricTitle(cell.metric) +
           " cannot be tested: " + cell.test.not_tested;
  return who + changeWords(cell.metric, cell.rate.value) +
         " in the last two trials than in the first two (95 % interval of the fall " +
         percent(cell.rateLow()) + " to " + percent(cell.rateHigh()) + "; " +
         counted(cell.test.a.n, "subject") + "). " + verdictOf(cell.test);
}

std::string betweenFinding(const StudyDesign& design, const Comparison& c, const Pilot& pilot) {
  const std::string what =
      (c.metric == "time_s" ? "Speed: " : "Penalty: ") + inWords(design, pilot.learners);
  if (!c.tested())
    return what + ": whether the condition changes learning cannot be tested: " + c.not_tested;
  return what + " learned " + number(100 * std::abs(c.difference), 0) + " points " +
         (c.difference >= 0 ? "more" : "less") + " " + c.a_name + " than " + c.b_name + " (rates " +
         percent(c.a.mean) + " and " + percent(c.b.mean) + ", 95 % interval of the difference " +
         number(100 * c.low, 0) + " to " + number(100 * c.high, 0) + " points). " + verdictOf(c);
}

std::string groupFinding(const Comparison& c) {
  const std::string what = c.a_name + " against " + c.b_name + ", " + c.about + ": ";
  if (!c.tested()) return what + metricTitle(c.metric) + " cannot be tested: " + c.not_tested;
  const std::string unit = c.metric == "time_s" ? " s" : " points";
  const int decimals = decimalsFor(c.difference);
  return what + changeWords(c.metric, -c.difference / c.b.mean) + " (difference " +
         number(c.difference, decimals) + unit + ", 95 % interval " + number(c.low, decimals) +
         " to " + number(c.high, decimals) + "). " + verdictOf(c);
}

}  // namespace

std::vector<std::string> pilotFindings(const StudyDesign& design, const Pilot& pilot) {
  std::vector<std::string> findings;
  for (const LearningCell& cell : pilot.learning) findings.push_back(learningFinding(design, cell));
  for (const Comparison& c : pilot.learning_between)
    findings.push_back(betweenFinding(design, c, pilot));
  for (const Comparison& c : pilot.groups) findings.push_back(groupFinding(c));
  if (pilot.experts.empty())
    findings.push_back(
        "There is one group only: whether the score tells experienced people from novices cannot "
        "be said.");
  return findings;
}

}  // namespace palpa::study_analysis
