#pragma once

#include <chrono>
#include <map>
#include <mutex>
#include <nlohmann/json.hpp>
#include <string>

#include "apps/learning/settings.h"
#include "apps/learning/web_text.h"

/// What a platform has signed for a launch (LTI Core 1.3, section 5; Security Framework 1.0,
/// section 5.1.3).
namespace palpa::learning {

struct LtiLaunch {
  std::string person;      ///< what the platform calls who launches
  std::string task;        ///< id: custom parameter "task", else the link's last part
  std::string return_url;  ///< empty: none, or of another origin than the platform's
  std::string line_item;   ///< where the score goes (AGS 2.0); empty: it keeps none
};

/// Throws UsageError for a token that is not of this platform for this console, in one of its
/// deployments, for this very login and now (a minute of leeway), or launches no task.
LtiLaunch readLtiLaunch(const nlohmann::json& claims, const Platform& platform,
                        const std::string& nonce, std::chrono::sys_seconds now,
                        const Settings& settings);

/// The keys that platforms publish. Asked for when a token names one that is not known, of one
/// platform at most once a minute. Any thread.
class PlatformKeys {
 public:
  using Time = std::chrono::sys_seconds;
  /// The set that holds the token's key, or the last that was had; throws UsageError where the
  /// platform cannot be reached.
  std::string keysFor(const Platform& platform, const std::string& token, Time now);

 private:
  struct Known {
    std::string keys;
    Time asked;
  };
  std::mutex mutex_;
  std::map<std::string, Known> known_;  ///< by the platform's name
};

/// The beginning: a login that the platform initiates (Security Framework 1.0, section 5.1.1).
struct LoginRequest {
  const Platform* platform = nullptr;
  std::string hint, message_hint;  ///< the platform's own, sent back as they are
};

/// Throws UsageError for what is missing, for a platform that is not configured, and for a target
/// that is not this console's.
LoginRequest readLogin(const Fields& fields, const Settings& settings);

/// Logins that have begun. Any thread.
class Logins {
 public:
  using Time = std::chrono::sys_seconds;
  static constexpr std::chrono::minutes kLasts{10};
  static constexpr std::size_t kMost = 200;  ///< at once; then the oldest is forgotten

  struct Begun {
    std::string address;  ///< of the platform, where the browser goes next
    std::string browser;  ///< a secret for a cookie: only the same browser may go on
  };
  Begun begin(const LoginRequest& request, const Settings& settings, Time now);

  struct Pending {
    std::string platform, nonce;
  };
  /// Each for one use. Throws UsageError for one that is not pending (any more), or began in
  /// another browser.
  Pending take(const std::string& state, const std::string& browser, Time now);

 private:
  struct Kept {
    Pending pending;
    std::string browser;
    Time until;
  };
  std::mutex mutex_;
  std::map<std::string, Kept> pending_;  ///< by state
};

/// Where platforms send what they have signed, and where they fetch this console's keys.
std::string launchAddress(const Settings& settings);
std::string keysAddress(const Settings& settings);
std::string loginAddress(const Settings& settings);

}  // namespace palpa::learning
