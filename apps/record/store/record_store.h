#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "apps/record/store/deletions.h"
#include "apps/record/store/metric_sets.h"
#include "apps/record/store/sql_connection.h"

/// What the store keeps, as plain values. Times are UTC, ISO 8601 to the second; dates
/// "2027-03-01".
namespace palpa::record {

/// Somebody who trains, known by a pseudonym; the list that tells names stays with the educator, on
/// paper.
struct Trainee {
  std::string id;                    ///< 1 to 32 letters, digits, - or _
  std::string group;                 ///< "novice", "experienced", ...: the educator's words
  std::string experience;            ///< "3rd year", "50 lines", ...
  std::string handedness = "right";  ///< "right", "left"
  std::string added_utc;
  std::string consent_utc;   ///< to keeping training records; empty: not given
  std::string research_utc;  ///< to use in studies; empty: not given
  std::string retain_until;  ///< a date; empty: no limit was set
};

struct StoredCalibration {
  std::string name;  ///< "registration", "tool", ...
  std::string made_utc, sha256, verdict;
};

/// A session of a trainee: where its evidence is, and what it was made with.
struct StoredSession {
  std::string uuid;
  std::string trainee;
  /// 1, 2, ... of this trainee: the order in which sessions came, whatever clocks said; 0: not yet
  /// stored
  std::int64_t arrival = 0;
  std::string started_utc;
  std::string software, task, station;
  bool simulated = false;
  std::string study;      ///< empty: none
  std::int64_t slot = 0;  ///< of the trainee's way through the study
  std::string evidence;   ///< path of session.palpa where it was made
  std::string evidence_sha256;
  std::string facts_json;  ///< what the session said of itself: operator, side, augmentation, ...
  std::vector<StoredCalibration> calibrations;
};

struct StoredEvent {
  std::int64_t t_ns = 0;  ///< session time
  std::string kind, text;
  double value = 0;
};

struct StoredTrial {
  std::int64_t number = 0;                ///< 1, 2, ... in its session
  std::int64_t start_ns = 0, end_ns = 0;  ///< session time
  std::string role;                       ///< "scored", "familiarisation", ...
  std::uint64_t seed = 0;
  bool force_feedback = true;
  std::string outcome, reason;
  bool success = false;
  std::string score_json;       ///< as the evidence has it
  std::vector<Metric> metrics;  ///< in the order of their names where the store gives them
  std::vector<StoredEvent> events;
  double metric(const std::string& name) const;  ///< not a number where it has none of that name
};

/// A trial of somebody whose records were deleted on request, from before that: it is refused, and
/// its evidence is to be removed.
class PersonDeleted : public Error {
 public:
  using Error::Error;
};

/// Which trials; an empty text or -1 means any.
struct TrialFilter {
  std::string trainee = {}, task = {}, study = {}, session = {};
  int simulated = -1;  ///< 0, 1
};

struct TrialWithSession {
  StoredSession session;  ///< without its calibrations
  StoredTrial trial;      ///< without its events
};

/// How much a trainee has done.
struct Tally {
  std::string trainee;
  std::int64_t sessions = 0, trials = 0;
};

/// Trainees, sessions, trials, metrics, events of a centre: one SQLite file, or a PostgreSQL server
/// for many stations. Every call is one transaction; what cannot be reached throws StoreUnreachable
/// and leaves nothing half done. One thread.
class RecordStore {
 public:
  /// Opens, makes or migrates; deletes again whoever came back with a backup, and says so on
  /// standard error. Throws Error for a store that is newer, damaged, refused; UsageError for an
  /// address that is none.
  explicit RecordStore(const std::string& url);
  explicit RecordStore(std::unique_ptr<SqlConnection> connection);

  std::string place() const { return connection_->place(); }

  /// Throws UsageError for an id that is taken or malformed. One that was deleted may be given
  /// anew.
  void addTrainee(const Trainee& trainee);
  void changeTrainee(const Trainee& trainee);  ///< throws UsageError for one who is not there
  std::optional<Trainee> trainee(const std::string& id);
  std::vector<Trainee> trainees();  ///< by id

  /// Adds a trial, and its session with the first of them. A trial that is there already is left as
  /// it is: false. So a trial may be delivered as often as it takes. Throws PersonDeleted;
  /// UsageError for a trainee who is not there or a session that belongs to another.
  bool addTrial(const StoredSession& session, const StoredTrial& trial);
  /// Several of one session, all or none: how many were not there already.
  int addTrials(const StoredSession& session, const std::vector<StoredTrial>& trials);

  std::vector<StoredSession> sessions(const std::string& trainee = "");  ///< by trainee and arrival
  std::optional<StoredSession> session(const std::string& uuid);
  /// One trial after the other, by trainee, arrival and number, all of one moment: a cohort of any
  /// size in the memory of one trial. Who visits must not use the store.
  void eachTrial(const TrialFilter& filter,
                 const std::function<void(const TrialWithSession&)>& visit);
  /// The same as a list, for few.
  std::vector<TrialWithSession> trials(const TrialFilter& filter = {});
  std::vector<Tally> tallies(
      const std::string& trainee = "");  ///< by trainee; all but who has none
  std::vector<StoredEvent> events(const std::string& session, std::int64_t number);

  /// Removes all rows of a person and remembers, without the name, that he was deleted; answers
  /// where the evidence of his sessions lies. Throws UsageError for one who is not there.
  std::vector<StoredSession> deletePerson(const std::string& id, const std::string& now_utc);
  std::vector<StoredSession>
  evidenceToDelete();  ///< uuid and evidence only: of deleted persons, not yet removed
  void evidenceDeleted(const std::string& session);
  /// After deleting: leaves no byte of it in the file, and keeps the lists that backups obey. In
  /// words what could not be done; empty: all.
  std::vector<std::string> settleDeletions();
  bool wasDeleted(const std::string& digest);  ///< SHA-256 of a pseudonym
  std::vector<Trainee> overdue(
      const std::string& date);  ///< whose retention ended before this date

  SqlConnection& connection() { return *connection_; }  ///< for what else belongs into the store

 private:
  void requireSession(
      const StoredSession& session);  ///< of this trainee, made where it is not there
  void insertSession(const StoredSession& session);
  std::vector<StoredSession> sessionsOf(const std::string& trainee);
  bool insertTrial(const std::string& session, const StoredTrial& trial, std::string& kept_set);
  void requireNotDeleted(const StoredSession& session);
  std::unique_ptr<SqlConnection> connection_;
  Deletions deletions_;
};

/// Why a pseudonym cannot be one; empty: it can.
std::string whyNoPseudonym(const std::string& id);

/// Whether a text names this pseudonym, as a word: no letter or digit beside it; `strictly`:
/// nothing that a longer pseudonym could go on with.
bool mentions(std::string_view text, const std::string& id, bool strictly = false);

}  // namespace palpa::record
