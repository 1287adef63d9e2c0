#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "apps/link/lrs_client.h"
#include "apps/record/sqlite.h"
#include "apps/record/store/record_store.h"

namespace palpa::link {

/// Where statements go, and from which records they come.
struct Route {
  std::string endpoint, records;
};

struct Letter {
  std::string id;     ///< of the statement
  std::string voids;  ///< id of the statement that it takes back; empty: it tells of a trial
  std::string session;
  std::int64_t trial = 0;
  std::string person;  ///< SHA-256 of the pseudonym
  std::string body;    ///< the statement; emptied once delivered
};

/// This station's statements to learning record stores: what waits, and what was told, so that it
/// can be taken back. One SQLite file that outlives a killed process; every call is one
/// transaction. What was delivered keeps ids and digests only.
class Outbox {
 public:
  /// Made where there is none, readable by its owner only. Throws Error.
  explicit Outbox(const std::filesystem::path& file);
  /// $XDG_STATE_HOME/palpa/xapi.sqlite, else ~/.local/state/palpa/xapi.sqlite.
  static std::filesystem::path usualFile();

  /// False: it was put in before, whatever became of it.
  bool put(const Route& route, const Letter& letter);
  std::vector<Letter> waiting(
      const std::string& endpoint);  ///< in the order in which they were put in
  void delivered(const std::string& endpoint, const std::string& id);

  std::vector<std::string> endpoints(
      const std::string& records);  ///< that anything of these records went to
  /// Of trials, not taken back yet: told, or about to be.
  std::vector<Letter> sent(const Route& route);
  /// Puts in `voiding` for a statement; its own text, if it still waits, is thrown away unsent.
  void takeBack(const Route& route, const std::string& id, const Letter& voiding);
  void leaveNoTrace();  ///< of thrown away texts in the file and its log, unless others read it now

 private:
  void writeAhead();
  void insert(const Route& route, const Letter& letter);
  record::Database database_;
};

/// What is to be told of one person or of all.
struct StatementFilter {
  std::vector<record::Trainee> who;
  bool simulated = false;  ///< sessions that were simulated as well
  std::string home_page;   ///< of the accounts
};

struct Queued {
  int added = 0, known = 0;                         ///< statements put in now; put in before
  int simulated = 0, void_trials = 0, no_uuid = 0;  ///< trials left out
};

/// Puts a statement of every trial into the outbox; whoever has not agreed to training records is
/// not to be in `who`.
Queued queueTrials(record::RecordStore& store, const Route& route, const StatementFilter& filter,
                   Outbox& outbox);

/// Takes back what was told of people who were deleted from these records since, and of trials that
/// are void now. Returns how many.
int takeBackDeleted(record::RecordStore& store, const Route& route, Outbox& outbox);

/// How often to try a store that does not answer rightly, and how long to wait in between; doubled
/// each time.
struct Pace {
  int tries = 4;
  std::int64_t pause_ns = 500'000'000;
};

struct Sent {
  int delivered = 0, present = 0;    ///< stored now; were there already
  std::vector<std::string> refused;  ///< in words; these go on waiting
  std::string trouble;               ///< why it was stopped early; empty: all were tried
  std::size_t left = 0;              ///< statements that wait
};

/// Sends what waits for this endpoint, in order: each by PUT under its own id, so that a lost
/// answer or a killed process cannot store it twice. Done is what the store confirms by 204, or has
/// already as it was told (409, then read and compared). Errors of the network or the store are
/// tried again and then waited out. Throws Error where user or password is refused or the address
/// is no learning record store.
Sent sendWaiting(Outbox& outbox, const Endpoint& endpoint, LrsClient& client,
                 const Pace& pace = {});

}  // namespace palpa::link
