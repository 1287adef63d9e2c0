#include "apps/record/store/migrations.h"

#include <iterator>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "apps/record/store/metric_sets.h"

namespace palpa::record {
namespace {

// Of kSteps: what human raters said of trials.
const char* const kRatings = R"sql(
CREATE TABLE ratings(
  session     TEXT NOT NULL,
  number      BIGINT NOT NULL,
  rater       TEXT NOT NULL,         -- a pseudonym
  form        TEXT NOT NULL,
  form_sha256 TEXT NOT NULL,         -- of the edition that was used
  item        TEXT NOT NULL,
  value       BIGINT NOT NULL,       -- checklist: 1 done, 0 not done, -1 did not arise; global rating: 1 to 5
  entered_utc TEXT NOT NULL,
  PRIMARY KEY(session, number, rater, form, item),
  FOREIGN KEY(session, number) REFERENCES trials(session, number) ON DELETE CASCADE
);
)sql";

// Of kSteps: deletions that a restored backup obeys.
const char* const kDeletions = R"sql(
CREATE TABLE records_identity(         -- a backup carries it, so that a list of deletions finds its records
  one     BIGINT PRIMARY KEY,          -- 1: there is one row
  records TEXT NOT NULL,               -- a random name
  salt    TEXT NOT NULL                -- of the digests
);

CREATE TABLE deleted_people(           -- instead of `deletions`, whose rows are moved here
  digest      TEXT NOT NULL,           -- slow and salted, of the pseudonym
  deleted_utc TEXT NOT NULL,
  PRIMARY KEY(digest, deleted_utc)     -- the pseudonym may be given anew, and deleted again
);

CREATE TABLE deleted_sessions(
  session     TEXT PRIMARY KEY,
  deleted_utc TEXT NOT NULL,
  removed     BIGINT NOT NULL          -- 1: its evidence is gone as well
);
)sql";

// Of kSteps: a trial's metrics stand beside it, in place of a row for each in `metrics`.
const char* const kMetricSets = R"sql(
CREATE TABLE metric_sets(
  digest TEXT PRIMARY KEY,             -- SHA-256 of the names
  names  TEXT NOT NULL                 -- "col_lung,success,time_s": in this order
);

ALTER TABLE trials ADD COLUMN metric_set    TEXT NOT NULL DEFAULT '';   -- '' where it has none
ALTER TABLE trials ADD COLUMN metric_values TEXT NOT NULL DEFAULT '';   -- "0,1,,20.5": of these names
)sql";

// Of kSteps: who of a learning platform is which trainee.
const char* const kLearners = R"sql(
CREATE TABLE learners(
  digest  TEXT PRIMARY KEY,            -- slow and salted, of the platform and its user
  trainee TEXT NOT NULL REFERENCES trainees(id) ON DELETE CASCADE
);
)sql";

/// SQL; what the rows that are there need beside it; SQL after that.
struct Step {
  const char* sql;
  void (*rows)(SqlConnection&) = nullptr;
  const char* after = nullptr;
};

// Step i brings version i to i + 1. A step that was published is never changed; a change of the
// tables is a further step.
const Step kSteps[] = {{R"sql(
CREATE TABLE palpa_schema(version BIGINT NOT NULL);
INSERT INTO palpa_schema(version) VALUES(0);

CREATE TABLE trainees(
  id           TEXT PRIMARY KEY,      -- a pseudonym
  group_name   TEXT NOT NULL,
  experience   TEXT NOT NULL,
  handedness   TEXT NOT NULL,
  added_utc    TEXT NOT NULL,
  consent_utc  TEXT NOT NULL,         -- '' where not given
  research_utc TEXT NOT NULL,
  retain_until TEXT NOT NULL
);

CREATE TABLE deletions(               -- who was deleted must not come back with a late delivery
  digest       TEXT PRIMARY KEY,      -- SHA-256 of the pseudonym
  deleted_utc  TEXT NOT NULL
);

CREATE TABLE deleted_evidence(        -- of deleted persons, still to be removed where it was made
  session      TEXT PRIMARY KEY,
  evidence     TEXT NOT NULL
);

CREATE TABLE sessions(
  uuid            TEXT PRIMARY KEY,
  trainee         TEXT NOT NULL REFERENCES trainees(id),
  arrival         BIGINT NOT NULL,
  started_utc     TEXT NOT NULL,
  software        TEXT NOT NULL,
  task            TEXT NOT NULL,
  station         TEXT NOT NULL,
  simulated       BIGINT NOT NULL,
  study           TEXT NOT NULL,
  slot            BIGINT NOT NULL,
  evidence        TEXT NOT NULL,
  evidence_sha256 TEXT NOT NULL,
  facts_json      TEXT NOT NULL,
  UNIQUE(trainee, arrival)
);

CREATE TABLE calibrations(
  session  TEXT NOT NULL REFERENCES sessions(uuid) ON DELETE CASCADE,
  name     TEXT NOT NULL,
  made_utc TEXT NOT NULL,
  sha256   TEXT NOT NULL,
  verdict  TEXT NOT NULL,
  PRIMARY KEY(session, name)
);

CREATE TABLE trials(
  session        TEXT NOT NULL REFERENCES sessions(uuid) ON DELETE CASCADE,
  number         BIGINT NOT NULL,
  start_ns       BIGINT NOT NULL,
  end_ns         BIGINT NOT NULL,
  role           TEXT NOT NULL,
  seed           TEXT NOT NULL,       -- 64 bits without sign
  force_feedback BIGINT NOT NULL,
  outcome        TEXT NOT NULL,
  reason         TEXT NOT NULL,
  success        BIGINT NOT NULL,
  score_json     TEXT NOT NULL,
  PRIMARY KEY(session, number)
);

CREATE TABLE metrics(
  session TEXT NOT NULL,
  number  BIGINT NOT NULL,
  name    TEXT NOT NULL,
  value   DOUBLE PRECISION,           -- null: does not apply
  PRIMARY KEY(session, number, name),
  FOREIGN KEY(session, number) REFERENCES trials(session, number) ON DELETE CASCADE
);

CREATE TABLE events(
  session TEXT NOT NULL,
  number  BIGINT NOT NULL,
  ordinal BIGINT NOT NULL,
  t_ns    BIGINT NOT NULL,
  kind    TEXT NOT NULL,
  text    TEXT NOT NULL,
  value   DOUBLE PRECISION,
  PRIMARY KEY(session, number, ordinal),
  FOREIGN KEY(session, number) REFERENCES trials(session, number) ON DELETE CASCADE
);
)sql"},
                       {R"sql(
CREATE TABLE studies(
  study           TEXT PRIMARY KEY,     -- the protocol's id
  protocol_sha256 TEXT NOT NULL,        -- of its file when the study began
  seed            TEXT NOT NULL,        -- 64 bits without sign: the order of the conditions follows from it
  began_utc       TEXT NOT NULL
);

CREATE TABLE study_groups(
  study      TEXT NOT NULL REFERENCES studies(study),
  group_name TEXT NOT NULL,
  given      BIGINT NOT NULL,           -- places given so far; of a deleted person, too: none is given twice
  PRIMARY KEY(study, group_name)
);

CREATE TABLE enrolments(
  study        TEXT NOT NULL REFERENCES studies(study),
  trainee      TEXT NOT NULL REFERENCES trainees(id) ON DELETE CASCADE,
  group_name   TEXT NOT NULL,
  place        BIGINT NOT NULL,         -- 1, 2, ... in this group, by enrolment
  condition    TEXT NOT NULL,
  simulated    BIGINT NOT NULL,
  enrolled_utc TEXT NOT NULL,
  PRIMARY KEY(study, trainee),
  UNIQUE(study, group_name, place)
);

CREATE TABLE answers(
  study         TEXT NOT NULL,
  trainee       TEXT NOT NULL,
  session       BIGINT NOT NULL,        -- of the protocol
  item          TEXT NOT NULL,
  questionnaire TEXT NOT NULL,
  answer        TEXT NOT NULL,
  answered_utc  TEXT NOT NULL,
  PRIMARY KEY(study, trainee, session, item),
  FOREIGN KEY(study, trainee) REFERENCES enrolments(study, trainee) ON DELETE CASCADE
);
)sql"},
                       {kRatings},
                       {kDeletions},
                       {kMetricSets, packMetricRows, "DROP TABLE metrics"},
                       {kLearners}};

/// Of the newest version.
const std::vector<std::pair<std::string, std::string>> kTables{
    {"trainees",
     "id,group_name,experience,handedness,added_utc,consent_utc,research_utc,retain_until"},
    {"deletions", "digest,deleted_utc"},
    {"deleted_evidence", "session,evidence"},
    {"records_identity", "one,records,salt"},
    {"deleted_people", "digest,deleted_utc"},
    {"deleted_sessions", "session,deleted_utc,removed"},
    {"sessions",
     "uuid,trainee,arrival,started_utc,software,task,station,simulated,study,slot,evidence,"
     "evidence_sha256,facts_json"},
    {"calibrations", "session,name,made_utc,sha256,verdict"},
    {"metric_sets", "digest,names"},
    {"trials",
     "session,number,start_ns,end_ns,role,seed,force_feedback,outcome,reason,success,score_json,"
     "metric_set,metric_values"},
    {"events", "session,number,ordinal,t_ns,kind,text,value"},
    {"studies", "study,protocol_sha256,seed,began_utc"},
    {"study_groups", "study,group_name,given"},
    {"enrolments", "study,trainee,group_name,place,condition,simulated,enrolled_utc"},
    {"answers", "study,trainee,session,item,questionnaire,answer,answered_utc"},
    {"ratings", "session,number,rater,form,form_sha256,item,value,entered_utc"},
    {"learners", "digest,trainee"}};

constexpr int kNewest = static_cast<int>(std::size(kSteps));

}  // namespace

int newestSchema() { return kNewest; }

const std::vector<std::string>& tableNames() {
  static const std::vector<std::string> names = [] {
    std::vector<std::string> all;
    for (const auto& [table, columns] : kTables) all.emplace_back(table);
    return all;
  }();
  return names;
}

const std::string& columnsOf(const std::string& name) {
  static const std::map<std::string, std::string> all(kTables.begin(), kTables.end());
  const auto found = all.find(name);
  if (found == all.end()) throw Error("is not a table of the records", name, "Report this");
  return found->second;
}

int schemaOf(SqlConnection& connection) {
  if (!connection.hasTable("palpa_schema")) return 0;
  const SqlRows rows = connection.query("SELECT version FROM palpa_schema");
  if (rows.size() != 1)
    throw Error("does not state its version exactly once", connection.place(),
                "It is damaged or was changed by hand: restore a backup");
  const std::int64_t version = rows.integer(0, 0);
  if (version > kNewest)
    throw Error("was written by a newer version of Palpa (tables " + std::to_string(version) +
                    ", known up to " + std::to_string(kNewest) + ")",
                connection.place(), "Update Palpa on this station; nothing was changed");
  return static_cast<int>(version);
}

namespace {

/// Of tables that are gone. What cannot be given back now is with the next deletion.
void giveBackSpace(SqlConnection& connection) {
  try {
    connection.leaveNoTrace();
  } catch (const Error&) {
    return;
  }
}

}  // namespace

int migrate(SqlConnection& connection, int version) {
  if (const int found = schemaOf(connection); found >= version) return found;
  SqlTransaction transaction(connection);
  connection.lockSchema();
  const int found = schemaOf(connection);  // again: another station may have been quicker
  for (int step = found; step < version; ++step) {
    connection.script(kSteps[step].sql);
    if (kSteps[step].rows) kSteps[step].rows(connection);
    if (kSteps[step].after) connection.script(kSteps[step].after);
    connection.query("UPDATE palpa_schema SET version=$1", {std::int64_t{step + 1}});
  }
  transaction.commit();
  if (found > 0) giveBackSpace(connection);
  return found;
}

namespace {

constexpr std::size_t kCopiedTogether = 500;  // rows: no more are held

/// Its name, which every store that was ever opened has, is given up for that of the other.
void requireEmpty(SqlConnection& store) {
  store.query("DELETE FROM records_identity");
  for (const std::string& table : tableNames())
    if (!store.query("SELECT 1 FROM " + table + " LIMIT 1").empty())
      throw UsageError("holds records already (" + table + ")", store.place(),
                       "Choose a new file or an empty database; nothing was changed");
}

}  // namespace

std::size_t copyStore(SqlConnection& from, SqlConnection& to) {
  migrate(from);
  migrate(to);
  SqlTransaction reading(from, Access::read), writing(to);
  to.lockSchema();
  requireEmpty(to);
  std::size_t copied = 0;
  for (const std::string& table : tableNames()) {
    std::vector<std::vector<SqlValue>> together;
    const auto rows = from.cursor("SELECT " + columnsOf(table) + " FROM " + table);
    for (bool more = rows->next(); more;) {
      together.push_back(rows->row());
      more = rows->next();
      if (more && together.size() < kCopiedTogether) continue;
      insertRows(to, table, columnsOf(table), together);
      copied += together.size();
      together.clear();
    }
  }
  writing.commit();
  return copied;
}

}  // namespace palpa::record
