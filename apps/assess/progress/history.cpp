#include "apps/assess/progress/history.h"

#include <algorithm>
#include <limits>
#include <map>
#include <tuple>

#include "anatomy/base/error.h"

namespace palpa::progress {

using training::Engine;

namespace {

constexpr double kMostPasses =
    3;  // a limit of three passes gave 3.9 % failures and 0.9 % arterial punctures (PMID 16937280)

bool earlier(const PracticeTrial& a, const PracticeTrial& b) {
  return std::tie(a.trainee, a.arrival, a.number) < std::tie(b.trainee, b.arrival, b.number);
}

/// In the order of their names.
constexpr std::array<std::string_view, kFigures> kKept{"back_wall_punctures",
                                                       "chosen",
                                                       "closest_artery_at_s",
                                                       "closest_artery_mm",
                                                       "closest_pleura_at_s",
                                                       "closest_pleura_mm",
                                                       "col_artery",
                                                       "col_lung",
                                                       "col_rib",
                                                       "col_vein",
                                                       "count_error_per_min",
                                                       "coverage_deep_pct",
                                                       "coverage_light_pct",
                                                       "coverage_medium_pct",
                                                       "econ_mean_mm",
                                                       "econ_var_mm2",
                                                       "error_cephalad",
                                                       "error_landmarks",
                                                       "error_left_vein",
                                                       "error_periosteum",
                                                       "error_shallow",
                                                       "error_site",
                                                       "false_alarms",
                                                       "first_pass_success",
                                                       "grips",
                                                       "needle_passes",
                                                       "over_force_s",
                                                       "path_length_mm",
                                                       "peak_force_N",
                                                       "phase_1_mm",
                                                       "phase_2",
                                                       "pulse_found",
                                                       "rhythm_told",
                                                       "rotational_actions",
                                                       "sensitivity_pct",
                                                       "specificity_pct",
                                                       "speed_at_vein_mm_s",
                                                       "success",
                                                       "time_s",
                                                       "too_hard_pct",
                                                       "too_light_pct",
                                                       "total",
                                                       "touches",
                                                       "translational_actions"};
static_assert(std::is_sorted(kKept.begin(), kKept.end()));

}  // namespace

std::size_t keptNumber(std::string_view metric) {
  const auto found = std::lower_bound(kKept.begin(), kKept.end(), metric);
  return found != kKept.end() && *found == metric ? static_cast<std::size_t>(found - kKept.begin())
                                                  : kNoFigure;
}

std::size_t figureNumber(std::string_view metric) {
  const std::size_t number = keptNumber(metric);
  if (number == kNoFigure && metrics::metricNamed(metric))
    throw Error("is not kept for pages of practice", std::string(metric), "Report this");
  return number;
}

Figures::Figures() { values_.fill(std::numeric_limits<double>::quiet_NaN()); }

Figures::Figures(std::initializer_list<metrics::MetricValue> values) : Figures() {
  for (const metrics::MetricValue& m : values) set(m.name, m.value);
}

bool PracticeTrial::succeeded() const {
  static const std::size_t kSuccess = figureNumber("success");
  return figures[kSuccess] == 1;
}

std::vector<double> finite(std::vector<double> values) {
  std::erase_if(values, [](double value) { return !std::isfinite(value); });
  return values;
}

bool counts(const PracticeTrial& trial) {
  return training::countsAsScored(trial.role, trial.outcome) && !trial.figures.empty();
}

std::vector<PracticeTrial> practiceOf(Engine engine, const std::vector<JudgedTrial>& session) {
  std::vector<PracticeTrial> practice;
  for (const JudgedTrial& trial : session) {
    PracticeTrial one;
    one.engine = engine;
    one.role = trial.role;
    one.outcome = trial.outcome;
    for (const metrics::MetricValue& figure : trial.figures)
      one.figures.set(figure.name, figure.value);
    if (counts(one)) practice.push_back(std::move(one));
  }
  return practice;
}

bool failed(const PracticeTrial& trial) {
  static const std::size_t kLung = figureNumber("col_lung"), kArtery = figureNumber("col_artery"),
                           kPasses = figureNumber("needle_passes");
  if (!trial.succeeded()) return true;
  return trial.engine == Engine::needle &&
         (trial.figures[kLung] > 0 || trial.figures[kArtery] > 0 ||
          trial.figures[kPasses] > kMostPasses);
}

PracticeView::PracticeView(const Series& series) : engine(series.engine), trials(series.trials) {}

std::vector<double> PracticeView::values(std::string_view metric) const {
  const std::size_t number = figureNumber(metric);
  std::vector<double> all;
  all.reserve(trials.size());
  for (const PracticeTrial& trial : trials) all.push_back(trial.figures[number]);
  return all;
}

std::size_t PracticeView::successes() const {
  return static_cast<std::size_t>(std::count_if(
      trials.begin(), trials.end(), [](const PracticeTrial& t) { return t.succeeded(); }));
}

std::vector<bool> failuresIn(const PracticeView& practice) {
  std::vector<bool> failures;
  for (const PracticeTrial& trial : practice.trials) failures.push_back(failed(trial));
  return failures;
}

std::vector<double> Series::values(std::string_view metric) const {
  return PracticeView(*this).values(metric);
}

std::string Series::name() const {
  return training::taskWords(task) + (force_feedback ? "" : ", force feedback off") +
         (condition.empty() ? "" : ", " + condition) + (simulated ? ", simulated" : "");
}

std::vector<Series> seriesOf(std::vector<PracticeTrial> trials) {
  std::map<std::tuple<bool, std::string, bool, std::string>, Series> all;
  for (PracticeTrial& trial : trials) {
    if (!counts(trial)) continue;
    Series& series = all[{trial.simulated, trial.task, !trial.force_feedback, trial.condition}];
    if (series.trials.empty())
      series = {trial.task,      trial.engine,         trial.condition,
                trial.simulated, trial.force_feedback, {}};
    series.trials.push_back(std::move(trial));
  }
  std::vector<Series> sorted;
  for (auto& [key, series] : all) {
    if (!std::is_sorted(series.trials.begin(), series.trials.end(), earlier))
      std::stable_sort(series.trials.begin(), series.trials.end(), earlier);
    sorted.push_back(std::move(series));
  }
  std::stable_sort(sorted.begin(), sorted.end(), [](const Series& a, const Series& b) {
    return a.trials.size() > b.trials.size();
  });
  return sorted;
}

std::vector<PracticeView> byTrainee(const Series& series) {
  std::vector<PracticeView> all;
  const std::span<const PracticeTrial> trials(series.trials);
  for (std::size_t from = 0, to = 0; from < trials.size(); from = to) {
    while (to < trials.size() && trials[to].trainee == trials[from].trainee) ++to;
    all.emplace_back(series.engine, trials.subspan(from, to - from));
  }
  return all;
}

std::string leftOut(const std::vector<PracticeTrial>& trials) {
  std::map<std::string, int> kinds;
  for (const PracticeTrial& trial : trials)
    if (!counts(trial))
      ++kinds[trial.outcome == training::Outcome::voided ? "void"
              : training::countsAsScored(trial.role)     ? "without figures"
                                                         : training::nameOf(trial.role)];
  std::string words;
  for (const auto& [kind, count] : kinds)
    words += (words.empty() ? "" : ", ") + std::to_string(count) + ' ' + kind;
  return words;
}

std::optional<Engine> engineOfFigures(const std::vector<std::string>& metrics) {
  const auto has = [&](const char* name) {
    return std::find(metrics.begin(), metrics.end(), name) != metrics.end();
  };
  for (const auto& [name, engine] :
       {std::pair{"tissue_time_s", Engine::needle}, std::pair{"presses", Engine::palpation},
        std::pair{"chosen", Engine::search}, std::pair{"grips", Engine::squeeze},
        std::pair{"touches", Engine::friction}, std::pair{"pulse_found", Engine::pulse}})
    if (has(name)) return engine;
  return std::nullopt;
}

const std::vector<std::string>& shownFigures(std::optional<Engine> engine) {
  static const std::map<Engine, std::vector<std::string>> kShown{
      {Engine::needle,
       {"total", "time_s", "success", "closest_pleura_mm", "closest_artery_mm", "needle_passes",
        "first_pass_success", "translational_actions", "rotational_actions", "speed_at_vein_mm_s"}},
      {Engine::palpation,
       {"sensitivity_pct", "specificity_pct", "false_alarms", "coverage_medium_pct",
        "coverage_deep_pct", "time_s", "too_light_pct", "too_hard_pct"}},
      {Engine::search, {"success", "time_s", "path_length_mm", "peak_force_N"}},
      {Engine::squeeze, {"success", "time_s", "grips", "peak_force_N"}},
      {Engine::friction, {"success", "time_s", "touches", "peak_force_N"}},
      {Engine::pulse,
       {"success", "pulse_found", "count_error_per_min", "rhythm_told", "time_s", "peak_force_N"}}};
  static const std::vector<std::string> kAnyTask{"success", "time_s"};
  return engine ? kShown.at(*engine) : kAnyTask;
}

}  // namespace palpa::progress
