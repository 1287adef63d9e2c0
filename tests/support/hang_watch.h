#pragma once

#include <chrono>
#include <condition_variable>
#include <cstdio>
#include <cstdlib>
#include <mutex>
#include <string>
#include <thread>

namespace palpa::test {

/// Ends the process, and says in what it hung, when a step takes longer than it may: what hangs
/// cannot be given up otherwise.
class HangWatch {
 public:
  explicit HangWatch(std::chrono::seconds longest)
      : longest_(longest), thread_([this] { watch(); }) {}
  ~HangWatch() {
    {
      const std::lock_guard lock(mutex_);
      is_over_ = true;
    }
    changed_.notify_all();
    thread_.join();
  }
  HangWatch(const HangWatch&) = delete;
  HangWatch& operator=(const HangWatch&) = delete;

  /// The step before has ended, this one begins.
  void begin(std::string step) {
    {
      const std::lock_guard lock(mutex_);
      step_ = std::move(step);
      ++number_;
    }
    changed_.notify_all();
  }

 private:
  void watch() {
    std::unique_lock lock(mutex_);
    while (!is_over_) {
      const int watched = number_;
      if (changed_.wait_for(lock, longest_, [&] { return is_over_ || number_ != watched; }))
        continue;
      std::fprintf(stderr, "hangs: %s\n", step_.c_str());
      std::_Exit(1);
    }
  }

  const std::chrono::seconds longest_;
  std::mutex mutex_;
  std::condition_variable changed_;
  bool is_over_ = false;
  std::string step_ = "before the first step";
  int number_ = 0;
  std::thread thread_;
};

}  // namespace palpa::test
