#include "apps/study/analysis/pilot.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "anatomy/base/counted.h"
#include "anatomy/base/error.h"
#include "apps/study/analysis/comparison.h"
#include "apps/study/analysis/exhibit.h"
#include "apps/study/analysis/study_design.h"

namespace palpa::study_analysis {
namespace {

std::string cellWords(const StudyDesign& design, const std::string& group,
                      const std::string& condition) {
  return inWords(design, group) + (condition.empty() ? "" : ", " + inWords(design, condition));
}

/// Subjects are drawn by their numbers, so that first and last stay together.
statistics::BootstrapInterval rateInterval(const std::vector<Learning>& all, std::uint64_t seed) {
  std::vector<double> numbers(all.size());
  std::iota(numbers.begin(), numbers.end(), 0.0);
  const auto rate = [&](const statistics::Samples& drawn) {
    double first = 0, last = 0;
    for (const double i : drawn[0]) {
      first += all[static_cast<std::size_t>(i)].first;
      last += all[static_cast<std::size_t>(i)].last;
    }
    return 1 - last / first;
  };
  return statistics::bootstrap({numbers}, rate, {2000, 0.95, seed});
}

LearningCell learningCell(const std::vector<SubjectSeries>& series, const StudyDesign& design,
                          const std::string& metric, const std::string& group,
                          const std::string& condition) {
  const std::vector<SubjectSeries> cell = within(series, group, condition);
  const std::vector<Learning> all = learningOf(cell);
  LearningCell learning{
      metric,
      group,
      condition,
      cell.size() - all.size(),
      compare(Test::paired, lastOf(all), firstOf(all), "last two trials", "first two", design.seed),
      {std::nan(""), std::nan(""), std::nan("")},
      {}};
  learning.test.metric = metric;
  learning.test.about = cellWords(design, group, condition);
  for (const Learning& l : all)
    if (l.first != 0) learning.rates.push_back(1 - l.last / l.first);
  if (learning.rates.size() == all.size() && all.size() >= 2)
    learning.rate = rateInterval(all, design.seed);
  return learning;
}

Comparison betweenRates(const StudyDesign& design, const LearningCell& without,
                        const LearningCell& with) {
  Comparison c = compare(Test::welch, with.rates, without.rates, inWords(design, with.condition),
                         inWords(design, without.condition), design.seed);
  c.metric = with.metric;
  c.about = "learning of " + inWords(design, with.group);
  return c;
}

Comparison betweenGroups(const std::vector<SubjectSeries>& series, const StudyDesign& design,
                         const std::string& metric, const Pilot& pilot,
                         const std::string& condition, bool published) {
  const std::vector<SubjectSeries> experts = within(series, pilot.experts, condition),
                                   learners = within(series, pilot.learners, condition);
  const std::string a = inWords(design, pilot.experts), b = inWords(design, pilot.learners);
  Comparison c = published ? compareAsPublished(pooledTrials(experts), pooledTrials(learners), a, b)
                           : compare(Test::welch, subjectMeans(experts), subjectMeans(learners), a,
                                     b, design.seed);
  c.metric = metric;
  c.about = condition.empty() ? "all trials" : inWords(design, condition);
  return c;
}

Comparison publishedLearning(const std::vector<SubjectSeries>& series, const StudyDesign& design,
                             const std::string& metric, const std::string& group,
                             const std::string& condition) {
  std::vector<double> first, last;
  for (const Learning& l : learningOf(within(series, group, condition))) {
    first.insert(first.end(), l.first_trials.begin(), l.first_trials.end());
    last.insert(last.end(), l.last_trials.begin(), l.last_trials.end());
  }
  Comparison c = compareAsPublished(last, first, "last two trials", "first two");
  c.metric = metric;
  c.about = cellWords(design, group, condition);
  return c;
}

void correctPilot(Pilot& pilot) {
  std::vector<Comparison*> family;
  for (LearningCell& cell : pilot.learning) family.push_back(&cell.test);
  for (Comparison& c : pilot.learning_between) family.push_back(&c);
  for (Comparison& c : pilot.groups) family.push_back(&c);
  correctTogether(family);
}

bool hasMetric(const std::vector<StudyRow>& rows, const std::string& metric) {
  return std::any_of(rows.begin(), rows.end(),
                     [&](const StudyRow& r) { return std::isfinite(r.metric(metric)); });
}

}  // namespace

Pilot pilotOf(const std::vector<StudyRow>& rows, const StudyDesign& design) {
  Pilot pilot;
  const std::vector<std::string> groups = groupsOf(rows, design);
  if (groups.empty())
    throw UsageError("no trial to analyse", design.title,
                     "Bring sessions of the study into the records first");
  pilot.learners = groups[0];
  if (groups.size() > 1) pilot.experts = groups[1];
  pilot.conditions = conditionsOf(rows, design);
  if (std::none_of(kPilotMetrics.begin(), kPilotMetrics.end(),
                   [&](const std::string& m) { return hasMetric(rows, m); }))
    throw UsageError("no trial has the figures time_s or total", design.title,
                     "Name the columns so, or use --kind general");
  for (const std::string& condition : pilot.conditions)
    for (const std::string& metric : kPilotMetrics) {
      const std::vector<SubjectSeries> series = seriesOf(rows, metric);
      pilot.learning.push_back(learningCell(series, design, metric, pilot.learners, condition));
      pilot.learning_published.push_back(
          publishedLearning(series, design, metric, pilot.learners, condition));
      if (pilot.experts.empty()) continue;
      pilot.groups.push_back(betweenGroups(series, design, metric, pilot, condition, false));
      pilot.groups_published.push_back(
          betweenGroups(series, design, metric, pilot, condition, true));
    }
  for (std::size_t m = 0; pilot.conditions.size() > 1 && m < kPilotMetrics.size(); ++m)
    pilot.learning_between.push_back(
        betweenRates(design, pilot.learning[m], pilot.learning[kPilotMetrics.size() + m]));
  correctPilot(pilot);
  return pilot;
}

StudyResult analysePilot(const std::vector<StudyRow>& rows, const StudyDesign& design) {
  const Pilot pilot = pilotOf(rows, design);
  StudyResult result = framedResult(rows, design, "paracentesis pilot");
  result.findings = pilotFindings(design, pilot);
  const auto add = [&](std::vector<Exhibit> more) {
    std::move(more.begin(), more.end(), std::back_inserter(result.exhibits));
  };
  add(pilotFigures(rows, design, pilot));
  add(pilotTables(rows, design, pilot));
  for (const std::string& metric : kPilotMetrics)
    result.exhibits.push_back(mixedExhibit(rows, design, metric));
  if (design.as_published) {
    add(pilotPublished(design, pilot));
    result.published_words = publishedWords();
  }
  std::size_t smallest = result.subjects;
  for (const LearningCell& cell : pilot.learning) smallest = std::min(smallest, cell.test.a.n);
  result.cautions = cautionsOf(result, smallest);
  return result;
}

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
