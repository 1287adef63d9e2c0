#include "apps/study/run/study_run.h"

#include <map>
#include <nlohmann/json.hpp>

#include "anatomy/base/file_schema.h"
#include "anatomy/base/json_file.h"
#include "anatomy/base/json_text.h"
#include "anatomy/base/whole_file.h"
#include "apps/training/trial_words.h"

namespace palpa::study {
namespace {

using study_analysis::StudyRow;

/// What a session says of the study it belongs to.
nlohmann::json studyFacts(const record::StoredSession& session) {
  try {
    const nlohmann::json facts = parseJson(session.facts_json);
    if (facts.is_object() && facts.contains("study") && facts.at("study").is_object())
      return facts.at("study");
  } catch (const nlohmann::json::exception&) {  // said below
  }
  throw Error("the session's description is damaged or does not name the study",
              "session " + session.uuid, "Bring it into the records again: palpa records add");
}

std::string wordIn(const nlohmann::json& study, const char* field,
                   const record::StoredSession& session) {
  const auto found = study.find(field);
  if (found == study.end()) return "";
  if (!found->is_string())
    throw Error(std::string("the study's ") + field + " is not text", "session " + session.uuid,
                "Bring it into the records again: palpa records add");
  return found->get<std::string>();
}

StudyRow rowOf(const record::TrialWithSession& t, int session_number) {
  const nlohmann::json study = studyFacts(t.session);
  StudyRow row{t.session.trainee,
               wordIn(study, "group", t.session),
               wordIn(study, "condition", t.session),
               wordIn(study, "block", t.session),
               session_number,
               static_cast<int>(t.trial.number),
               0,
               t.session.simulated,
               t.session.software,
               {}};
  for (const record::Metric& m : t.trial.metrics)
    if (m.value == m.value) row.metrics[m.name] = m.value;  // not a number: does not apply
  return row;
}

std::string optionalText(const JsonFile& file, const char* field, const std::string& otherwise) {
  return file.has(field) ? file.text(field) : otherwise;
}

/// Names in their order; their meaning into `words`.
std::vector<std::string> namesOf(const JsonFile& protocol, const char* list,
                                 std::map<std::string, std::string>& words) {
  std::vector<std::string> names;
  for (const JsonFile& entry : protocol.entries(list)) {
    names.push_back(entry.text("name"));
    words[names.back()] = std::string(list) == "conditions" ? optionalText(entry, "means", "") : "";
  }
  return names;
}

}  // namespace

std::vector<StudyRow> studyRows(record::RecordStore& store, const std::string& study) {
  record::TrialFilter filter;
  filter.study = study;
  std::vector<StudyRow> rows;
  std::map<std::string, std::pair<std::string, int>>
      latest;  // of a trainee: session and its number
  for (const record::TrialWithSession& t : store.trials(filter)) {
    auto& [session, number] = latest[t.session.trainee];
    if (session != t.session.uuid) {
      session = t.session.uuid;
      ++number;
    }
    if (!training::countsAsScored(training::roleNamed(t.trial.role)) ||
        training::isVoid(t.trial.outcome) || t.trial.metrics.empty())
      continue;
    rows.push_back(rowOf(t, number));
  }
  if (rows.empty())
    throw UsageError("holds no scored trial of the study \"" + study + "\"", store.place(),
                     "Check the study's id, or bring its sessions in: palpa records add");
  study_analysis::orderAndNumber(rows, store.place());
  return rows;
}

std::vector<StudyRow> studyRowsOfFile(const std::string& csv) {
  const std::optional<std::string> text = readWhole(csv);
  if (!text) throw UsageError("cannot be read", csv, "Check name and permissions");
  return study_analysis::rowsOfCsv(*text, csv);
}

ProtocolFacts protocolFacts(const std::string& file) {
  const JsonFile protocol{std::filesystem::path(file)};
  refuseUnknownFields(protocol, "protocol");
  ProtocolFacts facts;
  facts.id = protocol.text("id");
  study_analysis::StudyDesign& design = facts.design;
  design.title = optionalText(protocol, "title", facts.id);
  design.kind = study_analysis::studyKindNamed(optionalText(protocol, "analysis", ""),
                                               file + ", field analysis");
  design.groups = namesOf(protocol, "groups", design.words);
  design.conditions = namesOf(protocol, "conditions", design.words);
  return facts;
}

}  // namespace palpa::study
