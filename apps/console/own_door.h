#pragma once

#include <chrono>
#include <map>
#include <mutex>
#include <string>

#include "apps/console/tries.h"
#include "apps/runtime/clock.h"

namespace palpa::console {

/// Lets trainees see their own results on a device of their own: the educator shows somebody a PIN,
/// who types it there. A PIN is a million to one, opens once, within ten minutes; five wrong ones
/// from one address, and it waits a minute. What it opens ends after twelve hours, or with the
/// console. Any thread.
class OwnDoor {
 public:
  static constexpr std::chrono::minutes kPinLasts{10};
  static constexpr std::chrono::hours kKeyLasts{12};

  /// Six digits. One that was shown before for the same person opens no more.
  std::string pinFor(const std::string& trainee);
  /// The key to somebody's results; empty: the PIN is wrong, used or too old, or too many wrong
  /// ones came from there.
  std::string enter(const std::string& remote, const std::string& pin);
  /// Whose key a request's cookies hold; empty: nobody's.
  std::string traineeOf(const std::string& cookies) const;

 private:
  using Clock = runtime::ServingClock;
  struct Given {
    std::string trainee;
    Clock::time_point until;
  };
  static void dropOld(std::map<std::string, Given>* given);

  mutable std::mutex mutex_;
  std::map<std::string, Given> pins_, keys_;
  Tries wrong_{5, std::chrono::seconds(60)};
};

/// The value of a cookie among all that a request sends; empty: there is none.
std::string cookieNamed(const std::string& name, const std::string& cookies);

}  // namespace palpa::console
