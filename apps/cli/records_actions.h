#pragma once

#include <string>
#include <vector>

#include "apps/record/store/record_store.h"

/// What `palpa records` does, one function an action. All throw Error and UsageError.
namespace palpa::cli {

struct RecordsOptions {
  std::string url;
  record::Trainee trainee;
  std::string group, experience, handedness, retain_until;  ///< of a change: empty leaves it
  bool consent = false, research = false, yes = false;
  std::vector<std::string> sessions;
  std::string out, from, to;
  std::string date;     ///< of overdue; empty: today
  bool remove = false;  ///< overdue: delete them
  std::string forget;   ///< deliver, delete: a session of which nothing is to be done any more
  bool left = false;    ///< delete: what is left of people deleted before
  std::string home;     ///< delete: of the console; empty: the usual one
  bool all = false;
  bool paths = false;  ///< export: with places of this computer
  std::string format = "both";
  std::string user, home_page;
  bool simulated = false, insecure = false;
};

void backUpRecords(const RecordsOptions& o);
void restoreRecords(const RecordsOptions& o);
void migrateRecords(const RecordsOptions& o);

void showTrainee(const RecordsOptions& o);
void listOverdue(const RecordsOptions& o);
void deletePerson(const RecordsOptions& o);

/// Deletes people: rows, evidence and what a session left beside it, pages of practice, what the
/// console keeps, what waits to be sent. What cannot be deleted is named, the rest goes on, and at
/// the end Error is thrown. UsageError, with nothing deleted, while a session of one of them runs.
void deletePeople(record::RecordStore& store, const RecordsOptions& o,
                  const std::vector<std::string>& ids);
/// The same of what earlier deletions left, where it is on this computer.
void deleteLeft(record::RecordStore& store, const RecordsOptions& o);
/// A session whose evidence is gone for good is not named any more.
void forgetLeft(record::RecordStore& store, const std::string& session);

void exportRecords(const RecordsOptions& o);
void sendRecords(const RecordsOptions& o);  ///< xAPI

/// "1 trial", "2 trials".
record::Trainee traineeIn(record::RecordStore& store,
                          const std::string& id);  ///< throws UsageError

}  // namespace palpa::cli
