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
    const std::lock_guard lock(mutex_);
    step_ = std::move(step);
    until_ = std::chrono::steady_clock::now() + longest_;
  }

 private:
  void watch() {
    std::unique_lock lock(mutex_);
    while (!is_over_) {
      const auto until = until_;
      changed_.wait_until(lock, until, [this] { return is_over_; });
      if (is_over_ || std::chrono::steady_clock::now() < until_) continue;
      std::fprintf(stderr, "hangs: %s\n", step_.c_str());
      std::_Exit(1);
    }
  }

  const std::chrono::seconds longest_;
  std::mutex mutex_;
  std::condition_variable changed_;
  bool is_over_ = false;
  std::string step_ = "before the first step";
  std::chrono::steady_clock::time_point until_ = std::chrono::steady_clock::now() + longest_;
  std::thread thread_;
};

}  // namespace palpa::test
