#include "apps/record/store/record_reading.h"

#include <charconv>
#include <optional>
#include <set>

#include "apps/record/store/migrations.h"

namespace palpa::record {
namespace {

/// Only what is asked for, so that an index serves it.
struct Where {
  std::string sql;
  std::vector<SqlValue> values;
};

Where whereOf(const TrialFilter& filter) {
  Where where;
  const auto also = [&where](const char* column, SqlValue value) {
    where.values.push_back(std::move(value));
    where.sql += (where.sql.empty() ? " WHERE s." : " AND s.") + std::string(column) + "=$" +
                 std::to_string(where.values.size());
  };
  for (const auto& [column, value] :
       {std::pair{"trainee", &filter.trainee}, std::pair{"task", &filter.task},
        std::pair{"study", &filter.study}, std::pair{"uuid", &filter.session}})
    if (!value->empty()) also(column, *value);
  if (filter.simulated >= 0) also("simulated", std::int64_t{filter.simulated});
  return where;
}

std::unique_ptr<SqlCursor> select(SqlConnection& connection, const TrialFilter& filter,
                                  const std::string& columns, const std::string& tables,
                                  const std::string& order) {
  const Where where = whereOf(filter);
  return connection.cursor(
      "SELECT " + columns + " FROM " + tables + where.sql + " ORDER BY s.trainee,s.arrival" + order,
      where.values);
}

std::string text(const SqlCursor& row, std::size_t column) { return std::string(row.text(column)); }

StoredSession sessionIn(const SqlCursor& r) {
  StoredSession s;
  s.uuid = text(r, 0);
  s.trainee = text(r, 1);
  s.arrival = r.integer(2);
  s.started_utc = text(r, 3);
  s.software = text(r, 4);
  s.task = text(r, 5);
  s.station = text(r, 6);
  s.simulated = r.integer(7) != 0;
  s.study = text(r, 8);
  s.slot = r.integer(9);
  s.evidence = text(r, 10);
  s.evidence_sha256 = text(r, 11);
  s.facts_json = text(r, 12);
  return s;
}

[[noreturn]] void failDamaged(const SqlConnection& store, const std::string& reason) {
  throw Error("is damaged (" + reason + ")", store.place(),
              "Restore a backup: palpa records restore");
}

std::uint64_t seedIn(std::string_view digits, const SqlConnection& store) {
  std::uint64_t seed = 0;
  const auto [end, problem] = std::from_chars(digits.begin(), digits.end(), seed);
  if (problem != std::errc() || end != digits.end()) failDamaged(store, "a seed is not a number");
  return seed;
}

/// Sessions in their order, of which one is there at a time.
class SessionsInOrder {
 public:
  SessionsInOrder(SqlConnection& connection, const TrialFilter& filter)
      : connection_(connection),
        rows_(select(connection, filter, columnsOf("sessions"), "sessions s", "")) {}
  std::optional<StoredSession> next() {
    return rows_->next() ? std::optional(sessionIn(*rows_)) : std::nullopt;
  }
  /// Into `session`, which holds the one before.
  void goTo(std::string_view uuid, StoredSession& session) {
    if (session.uuid == uuid) return;
    while (rows_->next()) {
      if (rows_->text(0) != uuid) continue;
      session = sessionIn(*rows_);
      return;
    }
    failDamaged(connection_, "a trial's session is not there");
  }

 private:
  SqlConnection& connection_;
  std::unique_ptr<SqlCursor> rows_;
};

constexpr char kTrialColumns[] =
    "t.session,t.number,t.start_ns,t.end_ns,t.role,t.seed,t.force_feedback,t.outcome,t.reason,"
    "t.success,t.score_json,t.metric_set,t.metric_values";

void readTrial(const SqlCursor& r, const SqlConnection& store, MetricSets& sets, StoredTrial& t) {
  t.number = r.integer(1);
  t.start_ns = r.integer(2);
  t.end_ns = r.integer(3);
  t.role = r.text(4);
  t.seed = seedIn(r.text(5), store);
  t.force_feedback = r.integer(6) != 0;
  t.outcome = r.text(7);
  t.reason = r.text(8);
  t.success = r.integer(9) != 0;
  t.score_json = r.text(10);
  sets.unpack(r.text(11), r.text(12), t.metrics);
}

}  // namespace

void eachSession(SqlConnection& connection, const TrialFilter& filter,
                 const std::function<void(const StoredSession&)>& visit) {
  SessionsInOrder sessions(connection, filter);
  const auto calibrations =
      select(connection, filter, "c.session,c.name,c.made_utc,c.sha256,c.verdict",
             "sessions s JOIN calibrations c ON c.session=s.uuid", ",c.name");
  bool more = calibrations->next();
  while (std::optional<StoredSession> session = sessions.next()) {
    for (; more && calibrations->text(0) == session->uuid; more = calibrations->next())
      session->calibrations.push_back({text(*calibrations, 1), text(*calibrations, 2),
                                       text(*calibrations, 3), text(*calibrations, 4)});
    visit(*session);
  }
}

void eachTrial(SqlConnection& connection, const TrialFilter& filter,
               const std::function<void(const TrialWithSession&)>& visit) {
  MetricSets sets(connection);
  SessionsInOrder sessions(connection, filter);
  const auto trials = select(connection, filter, kTrialColumns,
                             "sessions s JOIN trials t ON t.session=s.uuid", ",t.number");
  TrialWithSession one;
  while (trials->next()) {
    sessions.goTo(trials->text(0), one.session);
    readTrial(*trials, connection, sets, one.trial);
    visit(one);
  }
}

void eachEvent(SqlConnection& connection, const TrialFilter& filter,
               const std::function<void(const TrialEvent&)>& visit) {
  const auto rows =
      select(connection, filter, "s.trainee,e.session,e.number,e.t_ns,e.kind,e.text,e.value",
             "sessions s JOIN events e ON e.session=s.uuid", ",e.number,e.ordinal");
  TrialEvent one;
  while (rows->next()) {
    one.trainee = rows->text(0);
    one.session = rows->text(1);
    one.number = rows->integer(2);
    one.event.t_ns = rows->integer(3);
    one.event.kind = rows->text(4);
    one.event.text = rows->text(5);
    one.event.value = rows->real(6);
    visit(one);
  }
}

std::vector<std::string> metricNames(SqlConnection& connection, const TrialFilter& filter) {
  const Where where = whereOf(filter);
  const SqlRows used = connection.query(
      "SELECT DISTINCT t.metric_set FROM sessions s JOIN trials t ON t.session=s.uuid" + where.sql,
      where.values);
  MetricSets sets(connection);
  std::set<std::string> names;
  for (std::size_t i = 0; i < used.size(); ++i)
    for (const std::string& name : sets.names(used.text(i, 0))) names.insert(name);
  return {names.begin(), names.end()};
}

std::vector<Tally> tallies(SqlConnection& connection, const std::string& trainee) {
  const SqlRows rows = connection.query(
      "SELECT s.trainee,COUNT(DISTINCT s.uuid),COUNT(t.number) FROM sessions s LEFT JOIN trials t "
      "ON t.session=s.uuid WHERE $1='' OR s.trainee=$1 GROUP BY s.trainee ORDER BY s.trainee",
      {trainee});
  std::vector<Tally> all;
  for (std::size_t i = 0; i < rows.size(); ++i)
    all.push_back({rows.text(i, 0), rows.integer(i, 1), rows.integer(i, 2)});
  return all;
}

}  // namespace palpa::record
