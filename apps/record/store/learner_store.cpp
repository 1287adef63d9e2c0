#include "apps/record/store/learner_store.h"

#include "anatomy/base/sha256.h"
#include "anatomy/base/uuid.h"
#include "apps/record/store/migrations.h"

namespace palpa::record {
namespace {

/// What a platform calls people may be short: trying all must take long.
constexpr int kLearnerRounds = 20'000;

}  // namespace

std::string LearnerStore::digestOf(const std::string& platform, const std::string& person) {
  const SqlRows identity = connection_.query("SELECT salt FROM records_identity");
  if (identity.empty())
    throw Error("has no name of its own", connection_.place(),
                "It was changed by hand: restore a backup");
  return slowSha256(sha256(platform) + sha256(person), identity.text(0, 0), kLearnerRounds);
}

std::string LearnerStore::traineeOf(const std::string& digest) {
  const SqlRows rows = connection_.query("SELECT trainee FROM learners WHERE digest=$1", {digest});
  return rows.empty() ? "" : rows.text(0, 0);
}

std::string LearnerStore::knownTrainee(const std::string& platform, const std::string& person) {
  return traineeOf(digestOf(platform, person));
}

std::string LearnerStore::freePseudonym() {
  constexpr std::size_t kDigits = 8;
  for (;;) {
    std::string id = "learner-" + newUuid().substr(0, kDigits);
    if (connection_.query("SELECT 1 FROM trainees WHERE id=$1", {id}).empty()) return id;
  }
}

std::string LearnerStore::traineeFor(const std::string& platform, const std::string& person,
                                     const std::string& now_utc) {
  const std::string digest = digestOf(platform, person);
  if (std::string known = traineeOf(digest); !known.empty()) return known;
  SqlTransaction transaction(connection_);
  std::string id = freePseudonym();
  connection_.query(
      "INSERT INTO trainees(" + columnsOf("trainees") + ") VALUES($1,$2,$3,$4,$5,$6,$7,$8)",
      {id, "learner", "", "right", now_utc, "", "", ""});
  const SqlRows mine =
      connection_.query("INSERT INTO learners(" + columnsOf("learners") +
                            ") VALUES($1,$2) ON CONFLICT(digest) DO NOTHING RETURNING trainee",
                        {digest, id});
  if (mine.empty()) return traineeOf(digest);  // another station was quicker: rolled back
  transaction.commit();
  return id;
}

}  // namespace palpa::record
