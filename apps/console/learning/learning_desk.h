#pragma once

#include <atomic>
#include <map>
#include <memory>
#include <mutex>
#include <string>
#include <thread>

#include "apps/console/routes.h"
#include "apps/learning/launches.h"
#include "apps/learning/lti_launch.h"
#include "apps/learning/signed_token.h"

namespace palpa::console {

/// What a console does for learning management systems: a launch becomes a session that is
/// prepared, as the pages would begin one, and what comes of it goes back. Launches are kept; what
/// could not be sent is sent later, also after a restart. Any thread; one of its own sends.
class LearningDesk {
 public:
  explicit LearningDesk(Console& console);
  ~LearningDesk();
  LearningDesk(const LearningDesk&) = delete;
  LearningDesk& operator=(const LearningDesk&) = delete;

  /// As they are now: an educator may add a platform while the console runs.
  learning::Settings settings() const { return learning::readSettings(folder_); }
  nlohmann::json publicKeys();
  learning::Logins& logins() { return logins_; }

  /// Id of the launch. Throws UsageError for one that must not be, in plain words. `language`: of
  /// the session's window, a code.
  std::string launchCmi5(const learning::Fields& fields, const std::string& task,
                         const std::string& language);
  std::string launchLti(const std::string& token, const learning::Logins::Pending& login,
                        const std::string& language);
  std::optional<learning::Launch> find(const std::string& id) const { return launches_.find(id); }

 private:
  struct Wait {
    runtime::ServingClock::time_point until;
    std::chrono::seconds next{1};
  };
  void begin(learning::Launch launch, const std::string& person, const learning::Settings& settings,
             const std::string& language, bool audio);
  void look();
  void conclude(learning::Launch& launch);
  void send(learning::Launch& launch);
  const learning::SigningKey& key();

  Console& console_;
  const learning::Folder folder_;
  learning::Launches launches_;
  learning::Logins logins_;
  learning::PlatformKeys keys_;
  std::mutex key_mutex_, begin_mutex_;
  std::unique_ptr<learning::SigningKey> key_;
  std::map<std::string, Wait> waits_;  ///< by launch; of the sending thread
  std::atomic<bool> ending_{false};
  std::thread thread_;  ///< last: it uses the rest
};

}  // namespace palpa::console
