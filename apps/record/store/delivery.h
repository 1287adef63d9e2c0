#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "apps/record/store/record_store.h"

namespace palpa::os {
class FileLock;
}

namespace palpa::record {

/// A session whose trials may not all have reached the store yet.
struct PendingSession {
  std::string uuid;
  std::filesystem::path evidence;  ///< its session.palpa, absolute
  std::string url;                 ///< of the store it belongs to
};

/// Lives as long as a session adds to what was noted: others leave it alone meanwhile, or they
/// would think it complete. It ends with the process, however that ends.
class PendingHold {
 public:
  explicit PendingHold(const std::filesystem::path& note);
  ~PendingHold();
  PendingHold(const PendingHold&) = delete;
  PendingHold& operator=(const PendingHold&) = delete;

 private:
  std::unique_ptr<os::FileLock> lock_;  ///< null: there is no note, or another holds it
};

/// This station's list of sessions still to be delivered: a small file each, in a folder that
/// outlives the process. The evidence itself holds the trials; the list only says where to look. A
/// session is noted before its first trial and forgotten when the store has them all, so whatever
/// happens in between is made up for later.
class PendingList {
 public:
  /// Makes the folder when the first session is noted.
  explicit PendingList(std::filesystem::path folder);
  /// $XDG_STATE_HOME/palpa/pending, else ~/.local/state/palpa/pending.
  static std::filesystem::path usualFolder();

  void note(const PendingSession& session);      ///< written beside, then renamed; throws Error
  std::vector<PendingSession> sessions() const;  ///< by uuid; what is no note is passed over
  void forget(const std::string& uuid);
  std::unique_ptr<PendingHold> hold(const std::string& uuid) const;
  bool isHeld(const std::string& uuid) const;

 private:
  std::filesystem::path noteOf(const std::string& uuid) const;
  std::filesystem::path folder_;
};

/// How often to try a store that cannot be reached, and how long to wait in between.
struct Patience {
  int tries = 3;
  std::int64_t pause_ns = 500'000'000;
};

struct Delivered {
  int added = 0;    ///< trials that were not there
  int present = 0;  ///< trials that were there already
};

/// Brings all trials of a session into the store at `url`: one transaction each, in order,
/// connecting anew where the connection was lost. What is there already stays, so that it may be
/// called again after any failure, a killed process among them. Throws what RecordStore throws;
/// StoreUnreachable when patience is at its end.
Delivered deliver(const std::string& url, const StoredSession& session,
                  const std::vector<StoredTrial>& trials, const Patience& patience = {});

}  // namespace palpa::record
