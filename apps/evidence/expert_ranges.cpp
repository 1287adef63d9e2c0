#include "apps/evidence/expert_ranges.h"

#include <algorithm>

#include <nlohmann/json.hpp>

#include "anatomy/base/error.h"
#include "anatomy/base/file_schema.h"
#include "anatomy/base/json_file.h"
#include "anatomy/base/json_text.h"
#include "anatomy/base/nearest_word.h"
#include "anatomy/base/whole_file.h"
#include "apps/assess/metrics/metric_table.h"
#include "apps/evidence/evidence_records.h"
#include "apps/evidence/recorded_trials.h"
#include "apps/record/session_file.h"
#include "apps/station/assets.h"

namespace palpa::evidence {
namespace {

constexpr const char* kFormat = "palpa expert ranges";

progress::PracticeTrial practiceOf(const EvidenceRecords& records, const record::StoredTrial& trial,
                                   training::Engine engine) {
  progress::PracticeTrial one;
  one.trainee = records.session.trainee;
  one.engine = engine;
  one.role = training::roleNamed(trial.role);
  one.outcome = training::outcomeNamed(trial.outcome);
  one.simulated = records.session.simulated;
  for (const record::Metric& m : trial.metrics) one.figures.set(m.name, m.value);
  return one;
}

}  // namespace

std::map<std::string, progress::Group> expertRangesIn(
    const std::vector<std::filesystem::path>& sessions) {
  std::map<std::string, std::vector<progress::PracticeTrial>> trials;
  for (const std::filesystem::path& file : sessions) {
    const record::SessionReader reader(file);
    const std::string id = parseJson(reader.info().task_json).value("id", "");
    const training::Engine engine = engineOf(reader);
    const EvidenceRecords records = recordsOf(file);
    for (const record::StoredTrial& trial : records.trials)
      trials[id].push_back(practiceOf(records, trial, engine));
  }
  std::map<std::string, progress::Group> ranges;
  for (const auto& [id, of_task] : trials)
    if (const auto group = progress::expertsOf(of_task)) ranges.emplace(id, *group);
  return ranges;
}

void writeExpertRanges(const std::map<std::string, progress::Group>& of_task,
                       const std::string& made_by, const std::filesystem::path& file) {
  nlohmann::json tasks = nlohmann::json::object();
  for (const auto& [id, group] : of_task) tasks[id] = progress::jsonOf(group);
  writeWhole(
      file,
      nlohmann::json{{"format", kFormat}, {"version", 1}, {"made_by", made_by}, {"tasks", tasks}}
              .dump(1) +
          "\n");
}

namespace {

constexpr int kMostTrials = 1'000'000;
constexpr double kMostOfAny = 1e9;  // whatever the unit is

std::vector<std::string> figureNames() {
  std::vector<std::string> names;
  for (const metrics::MetricDefinition& metric : metrics::metricTable())
    names.emplace_back(metric.name);
  return names;
}

progress::Group groupOf(const JsonFile& file, const std::string& at) {
  progress::Group group{
      .name = file.text(at + "name"),
      .what = file.text(at + "what"),
      .simulated = file.flag(at + "simulated"),
      .people = static_cast<std::size_t>(file.integer(at + "people", 1, kMostTrials)),
      .trials = static_cast<std::size_t>(file.integer(at + "trials", 1, kMostTrials)),
      .figures = {}};
  const nlohmann::json figures = file.json().at(nlohmann::json::json_pointer("/" + at + "figures"));
  for (const auto& [metric, unread] : figures.items()) {
    const std::string one = at + "figures/" + metric;
    if (!metrics::metricNamed(metric))
      file.refuse(one, "is no figure of a trial" + didYouMean(metric, figureNames()));
    const std::vector<double> low_to_high = file.numbers(one);
    if (low_to_high.size() != 3 || !std::is_sorted(low_to_high.begin(), low_to_high.end()) ||
        low_to_high.front() < -kMostOfAny || low_to_high.back() > kMostOfAny)
      file.refuse(one, "is not three figures in their order: low, middle, high");
    group.figures.push_back({metric, low_to_high[0], low_to_high[1], low_to_high[2]});
  }
  return group;
}

}  // namespace

std::map<std::string, progress::Group> readExpertRanges(const std::filesystem::path& file) {
  const JsonFile json(file);
  needKind(json, "expert_ranges", 1);
  if (json.text("format") != kFormat) json.refuse("format", std::string("is not ") + kFormat);
  json.text("made_by");
  std::map<std::string, progress::Group> of_task;
  if (!json.has("tasks") || !json.json()["tasks"].is_object()) json.refuse("tasks", "is no object");
  for (const auto& [id, group] : json.json()["tasks"].items()) {
    if (!group.is_object() || !group.contains("figures") || !group["figures"].is_object())
      json.refuse("tasks/" + id, "has no figures");
    of_task.emplace(id, groupOf(json, "tasks/" + id + "/"));
  }
  return of_task;
}

std::optional<progress::Group> shippedExperts(const std::string& task_id) {
  const auto all = readExpertRanges(station::assetFile("tasks/expert_ranges.json"));
  const auto found = all.find(task_id);
  if (found == all.end()) return std::nullopt;
  return found->second;
}

}  // namespace palpa::evidence
