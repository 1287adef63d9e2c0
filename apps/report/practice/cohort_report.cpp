#include "apps/report/practice/practice_reports.h"

#include <algorithm>
#include <set>

#include "anatomy/base/counted.h"
#include "anatomy/base/whole_file.h"
#include "apps/assess/progress/cohort.h"
#include "apps/assess/progress/competence.h"
#include "apps/report/page/page_parts.h"
#include "apps/report/practice/practice_charts.h"
#include "apps/report/practice/practice_page.h"
#include "apps/report/practice/progress_words.h"
#include "apps/training/engine.h"

namespace palpa::report {

using training::Engine;

namespace {

struct ShownMetrics {
  std::vector<std::string> distributions, curves;
  std::string reliability;
};

ShownMetrics metricsOf(std::optional<Engine> engine) {
  if (engine == Engine::needle)
    return {
        {"total", "time_s", "closest_pleura_mm", "needle_passes"}, {"total", "time_s"}, "total"};
  if (engine == Engine::palpation)
    return {{"sensitivity_pct", "specificity_pct", "coverage_deep_pct", "time_s"},
            {"sensitivity_pct", "time_s"},
            "sensitivity_pct"};
  return {{"success", "time_s"}, {"time_s"}, "time_s"};
}

void shortItem(Html& html, const std::string& head, const std::string& words) {
  if (words.empty()) return;
  const auto li = html.in("li");
  html.element("strong", head);
  html.text(' ' + words);
}

std::string commonWords(const std::vector<progress::CommonError>& errors) {
  if (errors.empty()) return "none of the errors that figures can tell happened.";
  std::string words;
  for (std::size_t i = 0; i < std::min<std::size_t>(3, errors.size()); ++i)
    words += (i ? "; " : "") + std::string(errors[i].kind->words) + " in " +
             fixed(100 * errors[i].share.mean, 0) + " % of a trainee's trials (" +
             std::to_string(errors[i].trainees_with) + " of " +
             counted(errors[i].trainees, "trainee") + ")";
  return words + '.';
}

std::string reliabilityWords(const progress::Series& group, const std::string& metric) {
  const auto r = progress::reliabilityOf(group, metric);
  const std::string cases = std::to_string(progress::kFewestCases);
  if (!r)
    return "takes two trainees or more who differ, each with at least " + cases +
           " trials; until then nobody should pass or fail by these figures alone.";
  const std::string words = titleWithin(metric) + " over the last " + cases + " trials of " +
                            counted(r->trainees, "trainee") + ": ICC(3,k) " +
                            fixed(r->icc.value, 2) + " (95 % interval " + fixed(r->icc.low, 2) +
                            " to " + fixed(r->icc.high, 2) + ").";
  return words + (r->icc.value < progress::kReliable
                      ? " Below 0.7: nobody should pass or fail by it."
                      : " 0.7 or more: it tells trainees apart well enough to go by.");
}

void writeAttention(Html& html, const std::vector<progress::Attention>& attention,
                    std::size_t trainees) {
  if (attention.empty())
    return shortItem(html, "Needs attention:",
                     "nobody of " + counted(trainees, "trainee") + ", by these figures.");
  const auto li = html.in("li");
  html.element("strong", "Needs attention:");
  html.text(' ' + std::to_string(attention.size()) + " of " + counted(trainees, "trainee") + '.');
  const auto list = html.in("ul");
  for (const progress::Attention& a : attention) {
    std::string words = a.trainee + ": ";
    for (std::size_t i = 0; i < a.reasons.size(); ++i) words += (i ? "; " : "") + a.reasons[i];
    html.element("li", words + '.');
  }
}

void writeCohortSummary(Html& html, const progress::Series& group,
                        const std::vector<progress::CommonError>& errors,
                        const statistics::CusumRates& rates) {
  const auto list = html.in("ul", {{"class", "short"}});
  const std::vector<progress::PracticeView> trainees = progress::byTrainee(group);
  std::size_t successes = 0;
  std::vector<double> shares;
  for (const progress::PracticeView& own : trainees) {
    successes += own.successes();
    shares.push_back(static_cast<double>(own.successes()) / static_cast<double>(own.trials.size()));
  }
  const progress::GroupMean success = progress::groupMean(shares);
  shortItem(html, "Practice:",
            counted(trainees.size(), "trainee") + ", " +
                counted(group.trials.size(), "scored trial") + '.');
  shortItem(html, "Success:",
            std::to_string(successes) + " of " + counted(group.trials.size(), "trial") + "; " +
                figureOf("success", success.mean) + " of a trainee's" +
                intervalWords("success", success.interval) + '.');
  writeAttention(html, progress::whoNeedsAttention(group, rates), trainees.size());
  shortItem(html, "Common errors:", commonWords(errors));
  shortItem(html, "Reliability:", reliabilityWords(group, metricsOf(group.engine).reliability));
}

std::string stateOf(const progress::Competence& c) {
  if (c.reached) return "acceptable rate accepted at trial " + std::to_string(*c.reached);
  return (c.lost ? "unacceptable rate found at trial " + std::to_string(*c.lost)
                 : std::string("undecided")) +
         "; at least " + std::to_string(c.still_clean) + " more without failure";
}

void writeCompetences(Html& html, const progress::Series& group,
                      const statistics::CusumRates& rates) {
  const std::vector<progress::PracticeView> trainees = progress::byTrainee(group);
  const int fewest = statistics::cusumLimits(rates).shortest_clean_run;
  html.element("h3", "Competence");
  if (group.engine == Engine::palpation &&
      std::none_of(trainees.begin(), trainees.end(),
                   [](const auto& own) { return own.trials.size() >= progress::kFewestCases; })) {
    html.element("p", "Nobody passes or fails by fewer than eight cases.");
    return;
  }
  html.element("p", "Rates set by the educator: " + trimmed(100 * rates.acceptable, 1) +
                        " % acceptable, " + trimmed(100 * rates.unacceptable, 1) +
                        " % unacceptable; none is established for this procedure. Fewer than " +
                        std::to_string(fewest) + " trials cannot certify anybody.");
  DataTable table{"", {"Trainee", "Trials", "Failures", "Standing (CUSUM)"}, {}, 3};
  for (const progress::PracticeView& own : trainees) {
    const std::vector<bool> failures = progress::failuresIn(own);
    const bool locked =
        own.engine == Engine::palpation && own.trials.size() < progress::kFewestCases;
    table.rows.push_back(
        {own.trainee(), std::to_string(own.trials.size()),
         std::to_string(std::count(failures.begin(), failures.end(), true)),
         locked ? "fewer than eight cases" : stateOf(progress::competenceOf(failures, rates))});
  }
  writeOpenTable(html, table);
}

void writeGroup(Html& html, const progress::Series& group, const statistics::CusumRates& rates) {
  const std::vector<progress::CommonError> errors = progress::commonErrors(group);
  const ShownMetrics shown = metricsOf(group.engine);
  writeCohortSummary(html, group, errors, rates);
  html.element("h3", "Common errors");
  writeCommonErrors(html, errors);
  html.element("h3", "Trainee by trainee");
  for (const std::string& metric : shown.distributions) writeTraineeFigures(html, group, metric);
  html.element("h3", "Learning");
  const std::vector<progress::GroupCurve> curves = progress::groupCurves(group, shown.curves);
  for (std::size_t i = 0; i < curves.size(); ++i) writeGroupCurve(html, curves[i], shown.curves[i]);
  writeCompetences(html, group, rates);
}

}  // namespace

void writeCohortReport(CohortReport report, const std::filesystem::path& file) {
  std::set<std::string> trainees;
  for (const progress::PracticeTrial& trial : report.trials) trainees.insert(trial.trainee);
  const PracticePage page{
      "Cohort",
      report.group,
      report.group.empty() ? "All trainees" : "Group: " + report.group,
      {{"Trainees", std::to_string(trainees.size())},
       {"Trials", std::to_string(report.trials.size())},
       {"As of", report.made_utc.substr(0, 10)}},
      "Intervals of the group are over trainees, since a trainee's trials are not independent. "
      "Reliability: Shrout and Fleiss, Psychol. Bull. 86, 1979.",
      report.software};
  writeWhole(file, practiceHtml(page, std::move(report.trials),
                                [&](Html& html, const progress::Series& group) {
                                  writeGroup(html, group, report.rates);
                                }));
}

}  // namespace palpa::report
