#include "apps/link/data_tables.h"

#include <cmath>
#include <functional>
#include <unordered_set>
#include <utility>

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
using Visitor = std::function<void(const Row&)>;

/// `each` visits all rows.
template <class Row>
ExportTable filled(const char* name, const char* meaning, const Columns<Row>& columns,
                   std::function<void(const Visitor<Row>&)> each) {
  ExportTable table{name, meaning, {}, {}};
  for (const Filled<Row>& c : columns) table.columns.push_back(c.column);
  table.rows = [columns, each = std::move(each)](const RowVisitor& visit) {
    TableRow row;
    each([&](const Row& of) {
      row.clear();
      for (const Filled<Row>& c : columns) row.push_back(c.cell(of));
      visit(row);
    });
  };
  return table;
}

/// One person's records are found by an index; those of many are gone through once.
record::TrialFilter filterFor(const ExportSource& source) {
  return {.trainee = source.who.size() == 1 ? source.who[0].id : ""};
}

class Chosen {
 public:
  explicit Chosen(const ExportSource& source) {
    for (const record::Trainee& t : source.who) ids_.insert(t.id);
  }
  bool has(const std::string& trainee) const { return ids_.contains(trainee); }

 private:
  std::unordered_set<std::string> ids_;
};

void eachChosenSession(const ExportSource& source, const Visitor<record::StoredSession>& visit) {
  record::eachSession(source.records, filterFor(source),
                      [&, chosen = Chosen(source)](const record::StoredSession& s) {
                        if (chosen.has(s.trainee)) visit(s);
                      });
}

json orNothing(double value) { return std::isfinite(value) ? json(value) : json(); }
json orNothing(const std::string& text) { return text.empty() ? json() : json(text); }
double inSeconds(std::int64_t ns) { return static_cast<double>(ns) / 1e9; }

/// Texts that hold JSON, as objects; null where they hold none.
json parsed(const std::string& text) {
  json value = parsedOrDiscarded(text);
  return value.is_discarded() ? json() : value;
}

struct SessionRow {
  const record::StoredSession& session;
  json facts;  ///< what the session said of itself
};

/// E.g. at "/study/group".
json fact(const SessionRow& row, const char* pointer) {
  const json::json_pointer at(pointer);
  return row.facts.is_object() && row.facts.contains(at) && row.facts.at(at).is_primitive()
             ? row.facts.at(at)
             : json();
}

ExportTable traineesTable(const ExportSource& source) {
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
  return filled<T>("trainees", "One row a person, known by a pseudonym", columns,
                   [&source](const Visitor<T>& visit) {
                     for (const T& t : source.who) visit(t);
                   });
}

ExportTable sessionsTable(const ExportSource& source) {
  using S = SessionRow;
  const auto of = [](const char* name, const char* unit, const char* meaning, const char* pointer) {
    return Filled<S>{{name, unit, meaning, "", "not of a study, or not said"},
                     [pointer](const S& s) { return fact(s, pointer); }};
  };
  Columns<S> columns{
      {{"session", "UUID", "names the session and its evidence", "", ""},
       [](const S& s) { return s.session.uuid; }},
      {{"trainee", "text", "pseudonym", "", ""}, [](const S& s) { return s.session.trainee; }},
      {{"arrival", "1", "1, 2, ...: order of this trainee's sessions, whatever clocks said", "",
        ""},
       [](const S& s) { return s.session.arrival; }},
      {{"started_utc", "UTC", "by the station's clock", "", ""},
       [](const S& s) { return s.session.started_utc; }},
      {{"task", "text", "what was trained", "", ""}, [](const S& s) { return s.session.task; }},
      {{"simulated", "0 or 1", "1: the operator or the station was simulated", "", ""},
       [](const S& s) { return s.session.simulated ? 1 : 0; }},
      {{"operator", "text",
        "person, recorded, or a simulated expert, novice, learner or one of a file (custom)", "",
        "not said"},
       [](const S& s) { return fact(s, "/operator"); }},
      {{"station", "text", "its id", "", ""}, [](const S& s) { return s.session.station; }},
      {{"software", "text", "program and version", "", ""},
       [](const S& s) { return s.session.software; }},
      {{"study", "text", "its id", "", "not of a study"},
       [](const S& s) { return orNothing(s.session.study); }},
      {{"slot", "1", "place in the study's order", "", "not of a study"},
       [](const S& s) { return s.session.study.empty() ? json() : json(s.session.slot); }},
      of("study_group", "text", "group of the study", "/study/group"),
      of("study_condition", "text", "condition of the study", "/study/condition"),
      of("study_block", "text", "block of the study", "/study/block"),
      {{"evidence_sha256", "SHA-256", "of the evidence when it was brought in", "", ""},
       [](const S& s) { return s.session.evidence_sha256; }},
      {{"facts", "JSON", "all that the session said of itself", "", "not said"},
       [](const S& s) { return s.facts; }}};
  if (source.with_paths)
    columns.push_back({{"evidence", "path", "where the evidence was made", "", ""},
                       [](const S& s) { return s.session.evidence; }});
  return filled<S>("sessions", "One row a session", columns, [&source](const Visitor<S>& visit) {
    eachChosenSession(source, [&](const record::StoredSession& s) {
      visit({s, parsed(s.facts_json)});
    });
  });
}

ExportTable calibrationsTable(const ExportSource& source) {
  using C = std::pair<std::string, record::StoredCalibration>;
  const Columns<C> columns{
      {{"session", "UUID", "of the session", "", ""}, [](const C& c) { return c.first; }},
      {{"name", "text", "what was calibrated", "", ""}, [](const C& c) { return c.second.name; }},
      {{"made", "date", "when", "", "not said"},
       [](const C& c) { return orNothing(c.second.made_utc); }},
      {{"sha256", "SHA-256", "of the calibration file", "", "not said"},
       [](const C& c) { return orNothing(c.second.sha256); }},
      {{"verdict", "text", "pass, or what was wrong", "", "not said"},
       [](const C& c) { return orNothing(c.second.verdict); }}};
  return filled<C>("calibrations", "One row a calibration that a session used", columns,
                   [&source](const Visitor<C>& visit) {
                     eachChosenSession(source, [&](const record::StoredSession& s) {
                       for (const record::StoredCalibration& c : s.calibrations) visit({s.uuid, c});
                     });
                   });
}

struct TrialRow {
  const record::StoredSession& session;
  const record::StoredTrial& trial;
  const std::vector<double>& figures;  ///< in the order of their columns
};
using Trial = TrialRow;

TableColumn columnOf(const metrics::MetricDefinition& d) {
  const char* better = d.better == metrics::Better::lower    ? "lower"
                       : d.better == metrics::Better::higher ? "higher"
                                                             : "";
  const std::string missing =
      std::string(d.tasks == std::string("all")
                      ? ""
                      : std::string("the task is none of: ") + d.tasks + "; ") +
      (*d.valid ? std::string(d.valid) + "; " : "") + "the trial was not judged";
  return {d.name, d.unit, std::string(d.title) + ": " + d.definition, better, missing};
}

/// Those that this program knows, and those of another version that the records hold.
std::vector<TableColumn> figureColumns(const ExportSource& source) {
  std::vector<TableColumn> columns;
  for (const metrics::MetricDefinition& d : metrics::metricTable())
    if (d.name != std::string("success")) columns.push_back(columnOf(d));
  for (const std::string& name : record::metricNames(source.records, filterFor(source)))
    if (!metrics::metricNamed(name))
      columns.push_back(
          {name, "not known", "a figure of another version of Palpa", "", "not known"});
  return columns;
}

std::vector<std::string> namesOf(const std::vector<TableColumn>& columns) {
  std::vector<std::string> names;
  for (const TableColumn& column : columns) names.push_back(column.name);
  return names;
}

void eachChosenTrial(const ExportSource& source, const std::vector<std::string>& figures,
                     const Visitor<Trial>& visit) {
  record::MetricColumns columns(figures);
  const Chosen chosen(source);
  record::eachTrial(source.records, filterFor(source), [&](const record::TrialWithSession& t) {
    if (chosen.has(t.session.trainee)) visit({t.session, t.trial, columns.of(t.trial.metrics)});
  });
}

ExportTable trialsTable(const ExportSource& source) {
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
  const std::vector<TableColumn> figures = figureColumns(source);
  for (std::size_t i = 0; i < figures.size(); ++i)
    columns.push_back({figures[i], [i](const Trial& t) { return orNothing(t.figures[i]); }});
  columns.push_back({{"score", "JSON", "the score as the session wrote it", "", "not scored"},
                     [](const Trial& t) { return parsed(t.trial.score_json); }});
  return filled<Trial>("trials", "One row a trial, with every figure", columns,
                       [&source, names = namesOf(figures)](const Visitor<Trial>& visit) {
                         eachChosenTrial(source, names, visit);
                       });
}

ExportTable eventsTable(const ExportSource& source) {
  using E = record::TrialEvent;
  const Columns<E> columns{
      {{"session", "UUID", "of the session", "", ""}, [](const E& e) { return e.session; }},
      {{"trial", "1", "its number in the session", "", ""}, [](const E& e) { return e.number; }},
      {{"t_s", "s", "since the session's start", "", ""},
       [](const E& e) { return inSeconds(e.event.t_ns); }},
      {{"kind", "text", "what kind of event", "", ""}, [](const E& e) { return e.event.kind; }},
      {{"text", "text", "what happened, in words", "", "no words"},
       [](const E& e) { return orNothing(e.event.text); }},
      {{"value", "1", "a number that belongs to it", "", "there is none"},
       [](const E& e) { return orNothing(e.event.value); }}};
  return filled<E>("events", "One row an event of a trial", columns,
                   [&source](const Visitor<E>& visit) {
                     const Chosen chosen(source);
                     record::eachEvent(source.records, filterFor(source), [&](const E& e) {
                       if (chosen.has(e.trainee)) visit(e);
                     });
                   });
}

}  // namespace

Extent extentOf(const ExportSource& source) {
  Extent extent;
  eachChosenSession(source, [&](const record::StoredSession& s) {
    ++extent.sessions;
    extent.simulated += s.simulated ? 1 : 0;
  });
  const Chosen chosen(source);
  for (const record::Tally& tally : record::tallies(source.records, filterFor(source).trainee))
    if (chosen.has(tally.trainee)) extent.trials += static_cast<std::size_t>(tally.trials);
  return extent;
}

std::vector<ExportTable> tablesOf(const ExportSource& source) {
  std::vector<ExportTable> tables{traineesTable(source), sessionsTable(source),
                                  calibrationsTable(source), trialsTable(source),
                                  eventsTable(source)};
  for (ExportTable& further : furtherTables(source)) tables.push_back(std::move(further));
  return tables;
}

}  // namespace palpa::link
