#pragma once

#include <string>

#include "apps/record/store/record_store.h"

namespace palpa::record {

/// Which trainee somebody is whom a learning platform knows: by a slow salted digest of the
/// platform and of what it calls that person, so that no name of theirs is kept. Goes with the
/// trainee when that one is deleted.
class LearnerStore {
 public:
  explicit LearnerStore(RecordStore& store) : connection_(store.connection()) {}

  /// The pseudonym; whoever comes for the first time is added as a new trainee, without consent:
  /// the educator notes it once it was given. Several stations give one person one pseudonym.
  std::string traineeFor(const std::string& platform, const std::string& person,
                         const std::string& now_utc);
  /// Empty: was never here, or was deleted.
  std::string knownTrainee(const std::string& platform, const std::string& person);

 private:
  std::string digestOf(const std::string& platform, const std::string& person);
  std::string traineeOf(const std::string& digest);
  std::string freePseudonym();
  SqlConnection& connection_;
};

}  // namespace palpa::record
