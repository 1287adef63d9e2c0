#pragma once

#include <condition_variable>
#include <functional>
#include <future>
#include <mutex>
#include <thread>
#include <utility>

#include "apps/os/real_time.h"

namespace palpa::runtime {

/// One piece of work after the other, beside whoever asks for it, in one thread for all of them:
/// libraries keep for every thread that ever called them what they need in it (OpenCV 0.8 kB), so a
/// new thread for every picture would fill the memory in a long session. The thread begins with the
/// first piece; the end waits for the last one.
template <class Result>
class OwnThread {
 public:
  OwnThread() = default;
  ~OwnThread() {
    if (!thread_.joinable()) return;
    {
      const std::lock_guard lock(mutex_);
      ending_ = true;
    }
    changed_.notify_one();
    thread_.join();
  }
  OwnThread(const OwnThread&) = delete;
  OwnThread& operator=(const OwnThread&) = delete;

  /// Only when the piece before has ended. What `work` throws comes out of the future.
  std::future<Result> start(std::function<Result()> work) {
    std::packaged_task<Result()> next(std::move(work));
    std::future<Result> result = next.get_future();
    {
      const std::lock_guard lock(mutex_);
      next_ = std::move(next);
    }
    if (thread_.joinable())
      changed_.notify_one();
    else
      thread_ = os::startThread([this] { run(); });
    return result;
  }

 private:
  void run() {
    for (;;) {
      std::packaged_task<Result()> piece;
      {
        std::unique_lock lock(mutex_);
        changed_.wait(lock, [this] { return next_.valid() || ending_; });
        if (!next_.valid()) return;
        piece = std::exchange(next_, {});
      }
      piece();
    }
  }

  std::mutex mutex_;
  std::condition_variable changed_;
  std::packaged_task<Result()> next_;  ///< not begun yet
  bool ending_ = false;
  std::thread thread_;
};

}  // namespace palpa::runtime
