#pragma once

#include <chrono>
#include <cstddef>
#include <deque>
#include <map>
#include <mutex>
#include <string>

#include "apps/runtime/clock.h"

namespace palpa::console {

/// How often somebody did something lately, each by the address it came from: for limits. One
/// thread at a time.
class Tries {
 public:
  using Clock = runtime::ServingClock;
  Tries(std::size_t most, std::chrono::seconds within) : most_(most), within_(within) {}

  bool tooMany(const std::string& remote) {
    if (times_.size() > kMostRemotes) times_.erase(times_.begin());
    std::deque<Clock::time_point>& times = times_[remote];
    while (!times.empty() && Clock::now() - times.front() > within_) times.pop_front();
    return times.size() >= most_;
  }
  void note(const std::string& remote) { times_[remote].push_back(Clock::now()); }

 private:
  static constexpr std::size_t kMostRemotes = 1'000;
  const std::size_t most_;
  const std::chrono::seconds within_;
  std::map<std::string, std::deque<Clock::time_point>> times_;
};

/// Lets trainees see their own results on a device of their own: the educator shows somebody a PIN,
/// who types it there. A PIN is a million to one, works once, within ten minutes; after five wrong
/// ones an address waits a minute, after fifty from anywhere within ten minutes no PIN that was
/// shown opens any more. What it opens ends after twelve hours, with the console, or when its owner
/// leaves. Any thread.
class OwnDoor {
 public:
  static constexpr std::chrono::minutes kPinLasts{10};
  static constexpr std::chrono::hours kKeyLasts{12};

  OwnDoor() = default;
  OwnDoor(std::chrono::milliseconds pin_lasts, std::chrono::milliseconds key_lasts)
      : pin_lasts_(pin_lasts), key_lasts_(key_lasts) {}

  /// Six digits. One that was shown before for the same person opens no more.
  std::string pinFor(const std::string& trainee);
  /// The key to somebody's results; empty: the PIN is wrong, used or too old, or too many wrong
  /// ones came from there.
  std::string enter(const std::string& remote, const std::string& pin);
  /// Whose key a request's cookies hold; empty: nobody's.
  std::string traineeOf(const std::string& cookies) const;
  void leave(const std::string& cookies);

 private:
  using Clock = runtime::ServingClock;
  struct Given {
    std::string trainee;
    Clock::time_point until;
  };
  static void dropOld(std::map<std::string, Given>* given);

  const std::chrono::milliseconds pin_lasts_ = kPinLasts, key_lasts_ = kKeyLasts;
  mutable std::mutex mutex_;
  std::map<std::string, Given> pins_, keys_;
  Tries wrong_{5, std::chrono::seconds(60)}, wrong_anywhere_{50, std::chrono::seconds(600)};
};

/// The value of a cookie among all that a request sends; empty: there is none.
std::string cookieNamed(const std::string& name, const std::string& cookies);

}  // namespace palpa::console
