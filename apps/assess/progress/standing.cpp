#include "apps/assess/progress/standing.h"

#include <algorithm>
#include <cmath>
#include <set>

#include <nlohmann/json.hpp>

#include "apps/assess/progress/cohort.h"
#include "apps/assess/statistics/sample.h"

namespace palpa::progress {
namespace {

Reach reachOf(const std::string& metric, const std::vector<double>& values, double below) {
  using statistics::interpolatedQuantile;
  return {metric, interpolatedQuantile(values, below), interpolatedQuantile(values, 0.5),
          interpolatedQuantile(values, 1 - below)};
}

}  // namespace

const Reach* Group::reach(std::string_view metric) const {
  const auto found = std::find_if(figures.begin(), figures.end(),
                                  [&](const Reach& one) { return one.metric == metric; });
  return found == figures.end() ? nullptr : &*found;
}

std::optional<Group> expertsOf(const std::vector<PracticeTrial>& trials) {
  std::vector<PracticeTrial> counted;
  std::copy_if(trials.begin(), trials.end(), std::back_inserter(counted), counts);
  if (counted.empty()) return std::nullopt;
  Group group{.name = "experts",
              .what = "8 of 10 of their trials",
              .simulated = std::any_of(counted.begin(), counted.end(),
                                       [](const PracticeTrial& t) { return t.simulated; }),
              .people = 0,
              .trials = counted.size(),
              .figures = {}};
  std::set<std::string> people;
  for (const PracticeTrial& trial : counted) people.insert(trial.trainee);
  group.people = people.size();
  for (const std::string& metric : shownFigures(counted.front().engine)) {
    const std::vector<double> values =
        finite(PracticeView(counted.front().engine, counted).values(metric));
    if (!values.empty()) group.figures.push_back(reachOf(metric, values, 0.1));
  }
  return group;
}

std::optional<Group> othersIn(const Series& series, const std::string& left_out) {
  Group group{.name = "others who train here",
              .what = "the middle half of them, by the means of their last five trials",
              .simulated = series.simulated,
              .people = 0,
              .trials = 0,
              .figures = {}};
  for (const PracticeView& one : byTrainee(series)) {
    if (one.trainee() == left_out) continue;
    ++group.people;
    group.trials += one.trials.size();
  }
  if (group.people < kFewestOthers) return std::nullopt;
  for (const std::string& metric : shownFigures(series.engine)) {
    std::vector<double> means;
    for (const TraineeFigure& figure : traineeFigures(series, metric))
      if (figure.trainee != left_out) means.push_back(figure.mean);
    means = finite(std::move(means));
    if (means.size() >= kFewestOthers) group.figures.push_back(reachOf(metric, means, 0.25));
  }
  return group;
}

nlohmann::json jsonOf(const Group& group) {
  nlohmann::json figures = nlohmann::json::object();
  for (const Reach& one : group.figures) figures[one.metric] = {one.low, one.middle, one.high};
  return {{"name", group.name},     {"what", group.what},     {"simulated", group.simulated},
          {"people", group.people}, {"trials", group.trials}, {"figures", figures}};
}

Group groupIn(const nlohmann::json& json) {
  Group group{.name = json.at("name"),
              .what = json.at("what"),
              .simulated = json.at("simulated"),
              .people = json.at("people"),
              .trials = json.at("trials"),
              .figures = {}};
  for (const auto& [metric, reach] : json.at("figures").items())
    group.figures.push_back({metric, reach.at(0), reach.at(1), reach.at(2)});
  return group;
}

}  // namespace palpa::progress
