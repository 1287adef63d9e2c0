#pragma once

#include <chrono>
#include <map>
#include <mutex>
#include <string>

#include "apps/learning/settings.h"
#include "apps/learning/web_text.h"

/// The beginning of a launch by LTI 1.3: a login that the platform initiates (1EdTech Security
/// Framework 1.0, section 5.1.1).
namespace palpa::learning {

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
