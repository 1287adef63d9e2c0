#pragma once

#include <filesystem>
#include <mutex>
#include <nlohmann/json.hpp>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "apps/learning/cmi5_statements.h"
#include "apps/learning/lti_scores.h"
#include "apps/learning/settings.h"

/// What is kept of launches until a platform has what came of them.
namespace palpa::learning {

struct Launch {
  std::string id;  ///< a UUID that cannot be guessed: who has it sees how the launch stands
  PlatformKind kind = PlatformKind::cmi5;
  std::string platform, task, title;
  std::string session, trainee;  ///< of this console
  std::string return_url;        ///< empty: there is no way back
  int trials = 1;                ///< that were asked for
  std::int64_t began_ms = 0;     ///< since 1970, UTC
  Cmi5Facts cmi5 = {};
  std::string endpoint, token;           ///< cmi5; the token is a secret, kept until all is sent
  std::string line_item, person;         ///< LTI; empty line item: the platform keeps no score
  bool over = false;                     ///< what came of the session is known
  std::string result;                    ///< in words, for who trained
  ToldBefore told = {};                  ///< cmi5: what this launch has told
  std::vector<nlohmann::json> due = {};  ///< not yet sent, in their order
  std::string trouble;  ///< why the platform refused what was sent; then no more is
  bool isDone() const { return over && due.empty(); }
};

/// One private file each. Any thread.
class Launches {
 public:
  explicit Launches(std::filesystem::path folder) : folder_(std::move(folder)) {}

  /// Throws Error where it cannot be kept. Of one that is done the secrets are left out.
  void keep(const Launch& launch);
  std::optional<Launch> find(const std::string& id) const;
  std::vector<Launch> notDone();
  /// Whether a cmi5 launch of that registration and session is here already.
  bool has(const Cmi5Facts& facts) const;
  /// What earlier launches have told of the same registration and activity.
  ToldBefore toldOf(const Cmi5Facts& facts) const;
  /// How many were removed.
  int forget(const std::string& trainee);

 private:
  std::vector<std::filesystem::path> files() const;
  std::vector<Launch> all() const;
  const std::filesystem::path folder_;
  mutable std::mutex mutex_;
  std::set<std::filesystem::path> done_;  ///< names of files that need no second look
};

/// The session of a launch is over: what is to be told. `time_utc` to the millisecond.
void conclude(Launch& launch, const LaunchResult& result, const ToldBefore& before,
              const std::string& time_utc);

/// Sends what is due of a launch, in its order, and keeps after each what is left: statements have
/// ids that stay, a score is the same however often it comes, so what is sent twice counts once.
/// Ends at the first that does not arrive, or where the times say that it is given up. Throws Error
/// where it cannot be kept.
Delivered deliver(Launch& launch, Launches& launches, const Settings& settings,
                  const SigningKey& key, std::chrono::sys_seconds now,
                  const link::WebTimes& times = kPlatformTimes);

}  // namespace palpa::learning
