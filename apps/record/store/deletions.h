#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "apps/record/store/sql_connection.h"

namespace palpa::record {

struct DeletedPerson {
  std::string digest;  ///< Deletions::digestOf: no pseudonym can be read out of it
  std::string deleted_utc;
};

struct DeletedSession {
  std::string uuid, deleted_utc;
  bool removed = false;  ///< its evidence is gone, too
};

/// Who was deleted from some records, without names: kept in the records and, apart from them, in
/// files, since a backup that is restored knows nothing of what was deleted after it was made.
struct DeletionList {
  std::string records;  ///< the records' own random name, which every backup carries
  std::string salt;     ///< of the digests
  std::vector<DeletedPerson> people;
  std::vector<DeletedSession> sessions;
};

/// Nothing where there is no file, or none that is a list.
std::optional<DeletionList> readDeletions(const std::filesystem::path& file);
void writeDeletions(const DeletionList& list,
                    const std::filesystem::path& file);  ///< beside, then renamed; throws Error

/// What came back with a backup and was deleted again.
struct DeletedAgain {
  int people = 0, sessions = 0;
};

/// The deletions of one store: its tables, and the lists apart from it.
class Deletions {
 public:
  /// `url`: of the store; empty: there are no lists beside its tables.
  Deletions(SqlConnection& connection, std::string url)
      : connection_(connection), url_(std::move(url)) {}

  /// Deletes again what the lists name and the tables do not: sessions by their UUID, and of a
  /// person whatever is not younger than the deletion. Nothing in a store whose tables know of all.
  DeletedAgain obey();
  /// Within the transaction that deletes a person's rows.
  void note(const std::string& pseudonym, const std::string& now_utc,
            const std::vector<std::string>& sessions);
  void noteRemoved(const std::string& session);
  /// Brings the lists up to date; in words what could not be written, since a restored backup would
  /// then bring people back.
  std::vector<std::string> keepLists();

  bool isDeleted(const std::string& session);
  /// When the owner of this digest (SHA-256 of a pseudonym) was deleted last; empty: never.
  std::string lastDeletion(const std::string& sha256);

  /// Where the lists of these records are: beside a file, FILE.deletions.json; and in this user's
  /// state folder, palpa/deletions/NAME.json, where there is a home.
  std::vector<std::filesystem::path> listFiles();

 private:
  std::string digestOf(const std::string& sha256);
  DeletionList inTables();
  DeletionList identity();
  DeletionList adopted();
  void moveOldRows();
  DeletionList missing(const DeletionList& known);
  DeletedAgain deleteAgain(const DeletionList& missing);
  bool deleteSessions(const std::string& trainee, const std::string& until, DeletedAgain* again);
  void insert(const DeletionList& list);

  SqlConnection& connection_;
  const std::string url_;
};

/// Rows of a session, and of its trials, metrics, events, calibrations; where its evidence lies is
/// kept unless `evidence_removed`, and it is not there again. False: it is not there. Within a
/// transaction.
bool deleteSessionRows(SqlConnection& connection, const std::string& session,
                       bool evidence_removed);

}  // namespace palpa::record
