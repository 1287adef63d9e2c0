#include "apps/calibrate/subtask_recordings.h"

#include <algorithm>
#include <nlohmann/json.hpp>
#include <utility>

#include "anatomy/base/error.h"
#include "anatomy/base/file_schema.h"
#include "anatomy/base/json_text.h"
#include "anatomy/base/sha256.h"
#include "apps/record/session_file.h"

namespace palpa::calibrate {
namespace {

using nlohmann::json;

/// What a recording says of its task, station or session.
JsonFile descriptionOf(const std::string& text, const std::string& what, const std::string& file) {
  json parsed = parsedOrDiscarded(text);
  if (!parsed.is_object())
    throw Error("the description of its " + what + " is damaged", file,
                "Restore the file from a backup");
  return {std::move(parsed), file + ", its " + what, "Restore the file from a backup"};
}

std::string idOf(const JsonFile& described) {
  return described.has("id") ? described.text("id") : "?";
}

/// A set-up mistake in what was recorded is no mistake in the call.
station::NamedPlan recordedPlan(const JsonFile& task) {
  return readOwnFile([&] { return station::readPlan(task); });
}

/// By what the parts are told, in order.
json conditionsOf(const JsonFile& task) {
  json conditions = json::array({task.json().value("learned", json())});
  for (const JsonFile& part : task.entries("subtasks"))
    conditions.push_back(part.json().value("on", json::array()));
  return conditions;
}

/// All sequences of a recording, in order of time; `augmented`: trials in which cues might be
/// added.
std::vector<SubtaskSequence> sequencesOf(const record::SessionReader& reader,
                                         const std::string& recording, int* augmented) {
  std::vector<SubtaskSequence> sequences;
  SubtaskSteps steps(reader.info().tick_config);
  runtime::TrialHeader header;
  bool cues = false;
  const auto begin = [&](const record::RecordedTrial& trial) { header = trial.header; };
  const auto tick = [&](const haptics::FlightRecord& record) {
    if (record.commands.trial != static_cast<std::uint32_t>(header.trial) ||
        record.t_ns < header.t_ns)
      return;
    cues = cues || record.commands.augmented;
    steps.add(record);
  };
  const auto finish = [&](const record::RecordedTrial& trial) {
    for (SubtaskSequence& sequence : steps.take()) {
      sequence.trial = recording + "trial " + std::to_string(trial.header.trial);
      sequences.push_back(std::move(sequence));
    }
    *augmented += cues;
    cues = false;
  };
  record::walkTrials(reader, reader.trials(), {begin, tick, finish});
  return sequences;
}

/// "R1, " where there are several.
std::string recordingName(const std::vector<std::filesystem::path>& files, std::size_t i) {
  if (files.size() == 1) return "";
  const std::string folder = std::filesystem::absolute(files[i]).parent_path().filename().string();
  return (files[i].filename() == "session.palpa" && !folder.empty()
              ? folder
              : files[i].filename().string()) +
         ", ";
}

struct RecordedTask {
  JsonFile file;
  json conditions;
  station::NamedPlan plan;
};

RecordedTask recordedTaskOf(const record::SessionReader& reader, const std::string& file) {
  RecordedTask task;
  task.file = descriptionOf(reader.info().task_json, "task", file);
  task.plan = recordedPlan(task.file);
  if (task.plan.empty())
    throw Error(
        "its task \"" + idOf(task.file) + "\" names no parts (\"subtasks\")", file,
        "Record a task whose file names its parts, as the search, the palpations and paracentesis "
        "do");
  task.conditions = conditionsOf(task.file);
  return task;
}

void requireSameParts(const json& conditions, const json& first, const std::string& file,
                      const std::string& other) {
  if (conditions != first)
    throw Error("its task recognises its parts by other conditions than " + other, file,
                "Give recordings of one task, made with the same parts");
}

}  // namespace

std::string SubtaskRecordings::wordsOf(int label) const {
  std::string words;
  for (std::size_t i = 0; i < parts.size(); ++i)
    if (label >> i & 1) words += (words.empty() ? "" : " + ") + parts[i].name;
  return words.empty() ? "no part" : words;
}

SubtaskRecordings readSubtaskRecordings(const std::vector<std::filesystem::path>& given,
                                        const std::filesystem::path& task) {
  SubtaskRecordings all;
  std::vector<std::filesystem::path> files;
  for (const std::filesystem::path& file : given)
    files.push_back(std::filesystem::is_directory(file) ? file / "session.palpa" : file);
  json first;
  for (std::size_t i = 0; i < files.size(); ++i) {
    const std::string file = files[i].string();
    const record::SessionReader reader(files[i]);
    const RecordedTask recorded = recordedTaskOf(reader, file);
    if (i == 0) {
      first = recorded.conditions;
      all.task = idOf(recorded.file);
      all.station = idOf(descriptionOf(reader.info().station_json, "station", file));
      all.parts = recorded.plan.subtasks;
    }
    requireSameParts(recorded.conditions, first, file, files.front().string());
    all.simulated =
        descriptionOf(reader.info().session_json, "session", file).flag("simulated", true) ||
        all.simulated;
    for (SubtaskSequence& sequence : sequencesOf(reader, recordingName(files, i), &all.augmented)) {
      if (sequence.labels.size() < kShortestSequence)
        ++all.left_out;
      else
        all.sequences.push_back(std::move(sequence));
    }
    all.files.push_back({files[i].filename().string(), sha256OfFile(files[i])});
  }
  if (task.empty()) return all;
  const JsonFile named(task);
  refuseUnknownFields(named, "task");
  const station::NamedPlan plan = station::readPlan(named);
  if (plan.empty())
    throw UsageError("names no parts (\"subtasks\")", task.string(),
                     "Give the file of the task that was recorded");
  if (conditionsOf(named) != first)
    throw UsageError("recognises its parts by other conditions than the task that was recorded",
                     task.string(),
                     "Leave --task out, or record the sessions again with this task");
  all.parts = plan.subtasks;
  all.task = idOf(named);
  return all;
}

}  // namespace palpa::calibrate
