#include "apps/console/session_results.h"

#include "anatomy/base/json_text.h"
#include "apps/record/session_file.h"
#include "apps/training/trial_words.h"

namespace palpa::console {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

/// The figure of a score that says whether the trial reached what its task is about.
struct Goal {
  const char *figure, *reached, *missed;
};
/// The first that a score has: a search of several lumps has a number of those found, too.
constexpr Goal kGoals[] = {{"SUCCESS", "succeeded", "not successful"},
                           {"AT_STANDARD", "at the standard", "below the standard"},
                           {"RIGHT", "right", "wrong"},
                           {"FOUND", "found", "not found"}};

json goalOf(const json& scores) {
  if (!scores.is_object()) return nullptr;
  for (const Goal& goal : kGoals) {
    const auto figure = scores.find(goal.figure);
    if (figure == scores.end() || !figure->is_number()) continue;
    const bool reached = figure->get<double>() > 0;
    return {{"reached", reached},
            {"word", reached ? goal.reached : goal.missed},
            {"called", goal.reached}};
  }
  return nullptr;
}

/// The sentence that ended the trial, where one did.
std::string summaryOf(const std::vector<runtime::Event>& events,
                      const record::RecordedTrial& trial) {
  for (auto event = events.rbegin(); event != events.rend(); ++event)
    if (event->trial == trial.header.trial && event->kind == trial.end.outcome) return event->text;
  return "";
}

json trialOf(const record::RecordedTrial& trial, const std::vector<runtime::Event>& events) {
  json one{{"number", trial.header.trial},
           {"role", trial.header.role},
           {"outcome", trial.ended ? trial.end.outcome : "interrupted"},
           {"reason", trial.end.reason},
           {"counts", training::countsAsScored(training::roleNamed(trial.header.role))},
           {"length_s", trial.length_s()}};
  const json scores = parsedOrDiscarded(trial.end.scores_json);
  if (scores.is_object() && scores.contains("TOTAL")) one["total"] = scores["TOTAL"];
  if (json goal = goalOf(scores); !goal.is_null()) one["goal"] = std::move(goal);
  if (std::string summary = summaryOf(events, trial); !summary.empty())
    one["summary"] = std::move(summary);
  return one;
}

bool isCounted(const json& trial) {
  const std::string outcome = trial.at("outcome");
  return !training::isVoid(outcome) && outcome != "interrupted" && trial.at("counts") == true;
}

}  // namespace

json trialsIn(const fs::path& evidence, bool blind) {
  json all = json::array();
  std::error_code none;
  if (!fs::exists(evidence, none)) return all;
  const record::SessionReader reader(evidence);
  const std::vector<runtime::Event> events = reader.events();
  for (const record::RecordedTrial& trial : reader.trials()) {
    all.push_back(trialOf(trial, events));
    if (!blind) continue;
    for (const char* figure : {"total", "goal", "summary", "role", "length_s"})
      all.back().erase(figure);
    if (training::isVoid(trial.end.outcome) || !trial.ended) continue;
    all.back()["outcome"] = "recorded";
    all.back().erase("reason");
  }
  return all;
}

json outcomeOf(const json& trials) {
  int counting = 0, succeeded = 0, done = 0, scored = 0;
  double total = 0;
  std::string word = "succeeded";
  for (const json& trial : trials) {
    if (!isCounted(trial)) continue;
    ++counting;
    if (const auto goal = trial.find("goal"); goal != trial.end()) {
      succeeded += goal->at("reached") == true;
      word = goal->at("called");
    } else {
      succeeded += trial.at("outcome") == "success";
      done += trial.at("outcome") == "done";
    }
    if (!trial.contains("total") || !trial["total"].is_number()) continue;
    ++scored;
    total += trial["total"].get<double>();
  }
  json told{
      {"counting", counting}, {"succeeded", succeeded}, {"done", done}, {"word", std::move(word)}};
  if (scored > 0) told["total"] = total / scored;
  return told;
}

}  // namespace palpa::console
