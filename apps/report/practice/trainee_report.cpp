#include "apps/report/practice/practice_reports.h"

#include <algorithm>
#include <set>

#include "anatomy/base/counted.h"
#include "anatomy/base/whole_file.h"
#include "apps/assess/progress/competence.h"
#include "apps/assess/progress/errors.h"
#include "apps/report/page/page_parts.h"
#include "apps/report/practice/practice_charts.h"
#include "apps/report/practice/practice_page.h"
#include "apps/report/practice/progress_words.h"
#include "apps/training/engine.h"

namespace palpa::report {
namespace {

/// Everything else of this kind of trial.
void writeFigureTable(Html& html, const progress::Series& series) {
  DataTable table{"All figures of all trials", {"Trial", "Session"}, {}};
  const std::vector<std::string>& shown = progress::shownFigures(series.engine);
  for (const std::string& metric : shown)
    table.columns.push_back(
        metrics::metricNamed(metric)->title +
        (scaleOf(metric).second.empty() ? std::string() : ", " + scaleOf(metric).second));
  for (std::size_t i = 0; i < series.trials.size(); ++i) {
    table.rows.push_back({std::to_string(i + 1), series.trials[i].started_utc.substr(0, 10)});
    for (const std::string& metric : shown)
      table.rows.back().push_back(fieldOf(metric, series.trials[i].metric(metric)));
  }
  writeDataTable(html, table);
}

}  // namespace

void writeTraineeReport(const TraineeReport& report, const std::filesystem::path& file) {
  const PracticePage page{"Progress",
                          report.trainee,
                          "Trainee " + report.trainee,
                          {{"Group", report.group},
                           {"Experience", report.experience},
                           {"Trials", std::to_string(report.trials.size())},
                           {"As of", report.made_utc.substr(0, 10)}},
                          "Intervals of a trainee are over his or her trials: they say how sure "
                          "these figures are, not how the next patient goes.",
                          report.software};
  writeWhole(file,
             practiceHtml(page, report.trials, [&](Html& html, const progress::Series& series) {
               writeTraineeSummary(html, series);
               writeLearningSection(html, series);
               writeCompetenceSection(html, series, report.rates);
               writeRetentionSection(html, series, report.rates);
               writeErrorSection(html, series);
               writeFigureTable(html, series);
             }));
}

namespace {

using progress::Change;

constexpr std::size_t kSaidInFull = 3;

void item(Html& html, const char* head, const std::string& sentence) {
  if (sentence.empty()) return;
  const auto li = html.in("li");
  html.element("strong", head);
  html.text(' ' + sentence);
}

std::vector<Change> changesIn(const progress::Series& series) {
  std::vector<Change> changes;
  for (const std::string& metric : progress::shownFigures(series.engine))
    if (const auto change = progress::changeOf(metric, series.values(metric)))
      changes.push_back(*change);
  return changes;
}

std::string titlesOf(const std::vector<Change>& changes) {
  std::string words;
  for (const Change& change : changes)
    words += (words.empty() ? "" : ", ") + titleWithin(change.metric);
  return words.empty() ? words : words + '.';
}

/// The most telling ones with their figures, the others by name.
void writeChangesThat(Html& html, Change::ChangeVerdict verdict, const char* head, const char* more,
                      const std::vector<Change>& changes) {
  std::vector<Change> others;
  std::size_t said = 0;
  for (const Change& change : changes) {
    if (change.verdict != verdict) continue;
    if (said++ < kSaidInFull)
      item(html, head, changeWords(change) + '.');
    else
      others.push_back(change);
  }
  item(html, more, titlesOf(others));
}

void writeChanges(Html& html, const progress::Series& series) {
  const std::vector<Change> changes = changesIn(series);
  if (changes.empty())
    return item(html, "Change:", "too few trials to say what changed; six or more tell.");
  writeChangesThat(html, Change::ChangeVerdict::better, "Better:", "Also better:", changes);
  writeChangesThat(html, Change::ChangeVerdict::worse, "Worse:", "Also worse:", changes);
  std::vector<Change> unclear;
  std::copy_if(changes.begin(), changes.end(), std::back_inserter(unclear),
               [](const Change& c) { return c.verdict == Change::ChangeVerdict::unclear; });
  if (unclear.size() == changes.size())
    return item(html, "No clear change:",
                changeWords(unclear.front()) + (unclear.size() > 1 ? ". Nor in the others." : "."));
  item(html, "No clear change:", titlesOf(unclear));
}

std::string costSentence(const progress::Series& series) {
  const std::vector<progress::Cost> costs = progress::costsLately(series);
  if (costs.empty()) return "";
  double all = 0;
  for (const progress::Cost& cost : costs) all += cost.points;
  std::string words = titleWithin(costs[0].metric) + ", " + fixed(costs[0].points, 0) + " of " +
                      fixed(all, 0) + " points a trial";
  for (std::size_t i = 1; i < std::min<std::size_t>(costs.size(), 3); ++i)
    words += std::string(i == 1 ? "; then " : " and ") + titleWithin(costs[i].metric) + ", " +
             fixed(costs[i].points, 0);
  return words + " (means of the last " +
         counted(std::min<std::size_t>(5, series.trials.size()), "trial") + ").";
}

std::string missSentence(const progress::Series& series) {
  std::string words;
  for (const auto& [organ, name] :
       {std::pair{"pleura", "the pleura"}, std::pair{"artery", "an artery"}}) {
    const auto misses = progress::nearestMisses(series, organ, 1);
    if (misses.empty()) continue;
    words += (words.empty() ? "" : " ") + fixed(misses[0].distance_mm, 1) + " mm from " + name +
             " in trial " + std::to_string(misses[0].trial) + ", at " + fixed(misses[0].at_s, 1) +
             " s.";
  }
  return words;
}

std::string recurringSentence(const std::vector<progress::ErrorCount>& errors) {
  std::string words;
  for (const progress::ErrorCount& e : errors)
    if (e.recurs())
      words += (words.empty() ? "" : "; ") + std::string(e.kind->words) + " (" +
               std::to_string(e.lately.with) + " of the last " + std::to_string(e.lately.of) +
               " trials)";
  return words.empty() ? "no error happened twice in the last five trials." : words + '.';
}

void writePractice(Html& html, const progress::Series& series) {
  for (const std::string& next : progress::practiseNext(series))
    item(html, "Practise next:", next + '.');
}

}  // namespace

std::string extentOf(const progress::Series& series) {
  std::set<std::int64_t> sessions;
  std::string from, to;
  for (const progress::PracticeTrial& trial : series.trials) {
    sessions.insert(trial.arrival);
    const std::string day = trial.started_utc.substr(0, 10);
    if (day.empty()) continue;
    if (from.empty() || day < from) from = day;
    to = std::max(to, day);
  }
  std::string words =
      counted(series.trials.size(), "scored trial") + " in " + counted(sessions.size(), "session");
  if (from.empty()) return words;
  if (from == to) return words + ", on " + from;
  return words + ", " + from + " to " + to + " (" +
         counted(progress::daysBetween(from, to).value_or(0), "day") + ')';
}

void writeTraineeSummary(Html& html, const progress::Series& series) {
  const std::vector<progress::ErrorCount> errors = progress::errorsIn(series);
  const auto list = html.in("ul", {{"class", "short"}});
  item(html, "Practice:", extentOf(series) + '.');
  const std::size_t successes = progress::PracticeView(series).successes();
  const auto failures = std::count_if(series.trials.begin(), series.trials.end(), progress::failed);
  std::string counts = std::to_string(successes) + " of " + std::to_string(series.trials.size());
  if (series.engine == training::Engine::needle)
    counts += "; without touching lung or artery and within three passes " +
              std::to_string(static_cast<std::ptrdiff_t>(series.trials.size()) - failures);
  item(html, "Success:", counts + '.');
  writeChanges(html, series);
  item(html, "Costs most now:", costSentence(series));
  item(html, "Nearest misses:", missSentence(series));
  item(html, "Recurring:", recurringSentence(errors));
  writePractice(html, series);
}

}  // namespace palpa::report
