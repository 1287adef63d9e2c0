#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "apps/record/sqlite.h"

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
  std::vector<Letter> told(const Route& route);
  /// Puts in `voiding` for a statement; its own text, if it still waits, is thrown away unsent.
  void takeBack(const Route& route, const std::string& id, const Letter& voiding);

 private:
  void writeAhead();
  void insert(const Route& route, const Letter& letter);
  record::Database database_;
};

}  // namespace palpa::link
