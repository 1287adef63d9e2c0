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
  std::string forget;   ///< deliver: a session that is not to be sent any more
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

void exportRecords(const RecordsOptions& o);
void sendRecords(const RecordsOptions& o);  ///< xAPI

/// "1 trial", "2 trials".
record::Trainee traineeIn(record::RecordStore& store,
                          const std::string& id);  ///< throws UsageError

}  // namespace palpa::cli
