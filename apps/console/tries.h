#pragma once

#include <chrono>
#include <cstddef>
#include <deque>
#include <map>
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

}  // namespace palpa::console
