#include "apps/link/data_tables.h"

#include <cmath>
#include <functional>
#include <set>

#include "anatomy/base/json_text.h"
#include "apps/assess/metrics/metric_table.h"

namespace palpa::link {
namespace {

using nlohmann::json;

/// A column and how its cells come about: the dictionary cannot name what is not written.
template <class Row>
struct Filled {
  TableColumn column;
  std::function<json(const Row&)> cell;
};

template <class Row>
using Columns = std::vector<Filled<Row>>;

template <class Row>
ExportTable filled(const char* name, const char* meaning, const Columns<Row>& columns,
                   const std::vector<Row>& rows) {
  ExportTable table{name, meaning, {}, {}};
  for (const Filled<Row>& c : columns) table.columns.push_back(c.column);
  for (const Row& row : rows) {
    table.rows.emplace_back();
    for (const Filled<Row>& c : columns) table.rows.back().push_back(c.cell(row));
  }
  return table;
}

json orNothing(double value) { return std::isfinite(value) ? json(value) : json(); }
json orNothing(const std::string& text) { return text.empty() ? json() : json(text); }
double inSeconds(std::int64_t ns) { return static_cast<double>(ns) / 1e9; }

/// Texts that hold JSON, as objects; null where they hold none.
json parsed(const std::string& text) {
  json value = parsedOrDiscarded(text);
  return value.is_discarded() ? json() : value;
}

/// What the session said of itself, e.g. at "/study/group".
json fact(const record::StoredSession& session, const char* pointer) {
  const json facts = parsed(session.facts_json);
  const json::json_pointer at(pointer);
  return facts.is_object() && facts.contains(at) && facts.at(at).is_primitive() ? facts.at(at)
                                                                                : json();
}

ExportTable traineesTable(const Dataset& data) {
  using T = record::Trainee;
  const Columns<T> columns{
      {{"trainee", "text", "pseudonym", "", ""}, [](const T& t) { return t.id; }},
      {{"group", "text", "as the educator named it", "", "none was given"},
       [](const T& t) { return orNothing(t.group); }},
      {{"experience", "text", "in the educator's words", "", "none was given"},
       [](const T& t) { return orNothing(t.experience); }},
      {{"handedness", "text", "right or left", "", ""}, [](const T& t) { return t.handedness; }},
      {{"added_utc", "UTC", "when the trainee was added", "", ""},
       [](const T& t) { return t.added_utc; }},
      {{"consent_utc", "UTC", "when consent to keeping training records was noted", "",
        "not given"},
       [](const T& t) { return orNothing(t.consent_utc); }},
      {{"research_utc", "UTC", "when consent to use in studies was noted", "", "not given"},
       [](const T& t) { return orNothing(t.research_utc); }},
      {{"retain_until", "date", "after this day the records are to be deleted", "",
        "no limit was set"},
       [](const T& t) { return orNothing(t.retain_until); }}};
  return filled("trainees", "One row a person, known by a pseudonym", columns, data.trainees);
}

ExportTable sessionsTable(const Dataset& data, bool with_paths) {
  using S = record::StoredSession;
  const auto of = [](const char* name, const char* unit, const char* meaning, const char* pointer) {
    return Filled<S>{{name, unit, meaning, "", "not of a study, or not said"},
                     [pointer](const S& s) { return fact(s, pointer); }};
  };
  Columns<S> columns{
      {{"session", "UUID", "names the session and its evidence", "", ""},
       [](const S& s) { return s.uuid; }},
      {{"trainee", "text", "pseudonym", "", ""}, [](const S& s) { return s.trainee; }},
      {{"arrival", "1", "1, 2, ...: order of this trainee's sessions, whatever clocks said", "",
        ""},
       [](const S& s) { return s.arrival; }},
      {{"started_utc", "UTC", "by the station's clock", "", ""},
       [](const S& s) { return s.started_utc; }},
      {{"task", "text", "what was trained", "", ""}, [](const S& s) { return s.task; }},
      {{"simulated", "0 or 1", "1: the operator or the station was simulated", "", ""},
       [](const S& s) { return s.simulated ? 1 : 0; }},
      {{"operator", "text",
        "person, recorded, or a simulated expert, novice, learner or one of a file (custom)", "",
        "not said"},
       [](const S& s) { return fact(s, "/operator"); }},
      {{"station", "text", "its id", "", ""}, [](const S& s) { return s.station; }},
      {{"software", "text", "program and version", "", ""}, [](const S& s) { return s.software; }},
      {{"study", "text", "its id", "", "not of a study"},
       [](const S& s) { return orNothing(s.study); }},
      {{"slot", "1", "place in the study's order", "", "not of a study"},
       [](const S& s) { return s.study.empty() ? json() : json(s.slot); }},
      of("study_group", "text", "group of the study", "/study/group"),
      of("study_condition", "text", "condition of the study", "/study/condition"),
      of("study_block", "text", "block of the study", "/study/block"),
      {{"evidence_sha256", "SHA-256", "of the evidence when it was brought in", "", ""},
       [](const S& s) { return s.evidence_sha256; }},
      {{"facts", "JSON", "all that the session said of itself", "", "not said"},
       [](const S& s) { return parsed(s.facts_json); }}};
  if (with_paths)
    columns.push_back({{"evidence", "path", "where the evidence was made", "", ""},
                       [](const S& s) { return s.evidence; }});
  return filled("sessions", "One row a session", columns, data.sessions);
}

ExportTable calibrationsTable(const Dataset& data) {
  using C = std::pair<std::string, record::StoredCalibration>;
  std::vector<C> rows;
  for (const record::StoredSession& s : data.sessions)
    for (const record::StoredCalibration& c : s.calibrations) rows.emplace_back(s.uuid, c);
  const Columns<C> columns{
      {{"session", "UUID", "of the session", "", ""}, [](const C& c) { return c.first; }},
      {{"name", "text", "what was calibrated", "", ""}, [](const C& c) { return c.second.name; }},
      {{"made", "date", "when", "", "not said"},
       [](const C& c) { return orNothing(c.second.made_utc); }},
      {{"sha256", "SHA-256", "of the calibration file", "", "not said"},
       [](const C& c) { return orNothing(c.second.sha256); }},
      {{"verdict", "text", "pass, or what was wrong", "", "not said"},
       [](const C& c) { return orNothing(c.second.verdict); }}};
  return filled("calibrations", "One row a calibration that a session used", columns, rows);
}

using Trial = record::TrialWithSession;

Filled<Trial> figure(const metrics::MetricDefinition& d) {
  const char* better = d.better == metrics::Better::lower    ? "lower"
                       : d.better == metrics::Better::higher ? "higher"
                                                             : "";
  const std::string missing =
      std::string(d.tasks == std::string("all")
                      ? ""
                      : std::string("the task is none of: ") + d.tasks + "; ") +
      (*d.valid ? std::string(d.valid) + "; " : "") + "the trial was not judged";
  return {{d.name, d.unit, std::string(d.title) + ": " + d.definition, better, missing},
          [name = d.name](const Trial& t) { return orNothing(t.trial.metric(name)); }};
}

/// The records may hold figures of another version.
void addFigures(Columns<Trial>& columns, const Dataset& data) {
  for (const metrics::MetricDefinition& d : metrics::metricTable())
    if (d.name != std::string("success")) columns.push_back(figure(d));
  std::set<std::string> foreign;
  for (const Trial& t : data.trials)
    for (const record::Metric& m : t.trial.metrics)
      if (!metrics::metricNamed(m.name)) foreign.insert(m.name);
  for (const std::string& name : foreign)
    columns.push_back({{name, "not known", "a figure of another version of Palpa", "", "not known"},
                       [name](const Trial& t) { return orNothing(t.trial.metric(name)); }});
}

ExportTable trialsTable(const Dataset& data) {
  Columns<Trial> columns{
      {{"session", "UUID", "of the session", "", ""},
       [](const Trial& t) { return t.session.uuid; }},
      {{"trial", "1", "1, 2, ... in its session", "", ""},
       [](const Trial& t) { return t.trial.number; }},
      {{"trainee", "text", "pseudonym", "", ""}, [](const Trial& t) { return t.session.trainee; }},
      {{"arrival", "1", "of the session among this trainee's", "", ""},
       [](const Trial& t) { return t.session.arrival; }},
      {{"task", "text", "what was trained", "", ""}, [](const Trial& t) { return t.session.task; }},
      {{"simulated", "0 or 1", "1: the operator or the station was simulated", "", ""},
       [](const Trial& t) { return t.session.simulated ? 1 : 0; }},
      {{"role", "text", "scored, familiarisation, not scored, ...", "", ""},
       [](const Trial& t) { return t.trial.role; }},
      {{"start_s", "s", "since the session's start", "", ""},
       [](const Trial& t) { return inSeconds(t.trial.start_ns); }},
      {{"end_s", "s", "since the session's start", "", ""},
       [](const Trial& t) { return inSeconds(t.trial.end_ns); }},
      {{"seed", "text", "64 bits as digits; what was random in the trial follows from it", "", ""},
       [](const Trial& t) { return std::to_string(t.trial.seed); }},
      {{"force_feedback", "0 or 1", "1: forces were rendered", "", ""},
       [](const Trial& t) { return t.trial.force_feedback ? 1 : 0; }},
      {{"outcome", "text", "how it ended; void: does not count", "", ""},
       [](const Trial& t) { return t.trial.outcome; }},
      {{"reason", "text", "why it ended so", "", "none was given"},
       [](const Trial& t) { return orNothing(t.trial.reason); }},
      {{"success", "0 or 1", "1: the task's goal was reached", "higher", ""},
       [](const Trial& t) { return t.trial.success ? 1 : 0; }}};
  addFigures(columns, data);
  columns.push_back({{"score", "JSON", "the score as the session wrote it", "", "not scored"},
                     [](const Trial& t) { return parsed(t.trial.score_json); }});
  return filled("trials", "One row a trial, with every figure", columns, data.trials);
}

ExportTable eventsTable(const Dataset& data) {
  struct Happened {
    const Trial* trial;
    const record::StoredEvent* event;
  };
  std::vector<Happened> rows;
  for (const Trial& t : data.trials)
    for (const record::StoredEvent& e : t.trial.events) rows.push_back({&t, &e});
  const Columns<Happened> columns{
      {{"session", "UUID", "of the session", "", ""},
       [](const Happened& h) { return h.trial->session.uuid; }},
      {{"trial", "1", "its number in the session", "", ""},
       [](const Happened& h) { return h.trial->trial.number; }},
      {{"t_s", "s", "since the session's start", "", ""},
       [](const Happened& h) { return inSeconds(h.event->t_ns); }},
      {{"kind", "text", "what kind of event", "", ""},
       [](const Happened& h) { return h.event->kind; }},
      {{"text", "text", "what happened, in words", "", "no words"},
       [](const Happened& h) { return orNothing(h.event->text); }},
      {{"value", "1", "a number that belongs to it", "", "there is none"},
       [](const Happened& h) { return orNothing(h.event->value); }}};
  return filled("events", "One row an event of a trial", columns, rows);
}

}  // namespace

Dataset datasetOf(record::RecordStore& store, const std::vector<record::Trainee>& who) {
  Dataset data{who, {}, {}, furtherTables(store, who)};
  for (const record::Trainee& t : who) {
    for (const record::StoredSession& s : store.sessions(t.id))
      if (auto whole = store.session(s.uuid)) data.sessions.push_back(std::move(*whole));
    for (record::TrialWithSession& trial : store.trials({.trainee = t.id})) {
      trial.trial.events = store.events(trial.session.uuid, trial.trial.number);
      data.trials.push_back(std::move(trial));
    }
  }
  return data;
}

std::vector<ExportTable> tablesOf(const Dataset& data, bool with_paths) {
  std::vector<ExportTable> tables{traineesTable(data), sessionsTable(data, with_paths),
                                  calibrationsTable(data), trialsTable(data), eventsTable(data)};
  for (const FurtherTable& further : data.further) tables.push_back(asTable(further));
  return tables;
}

}  // namespace palpa::link
