#pragma once

#include <chrono>
#include <functional>
#include <memory>
#include <thread>

namespace palpa::ar {

/// A thread for all calls of a runtime, any of which may never come back. It takes one step at a
/// time. What a step uses belongs to it until wait() or busy() says that it has ended.
class XrThread {
 public:
  using Duration = std::chrono::milliseconds;

  XrThread();
  ~XrThread();  ///< a thread that is still in its step is left behind
  XrThread(const XrThread&) = delete;
  XrThread& operator=(const XrThread&) = delete;
  /// Only when it is not busy. The step throws nothing.
  void start(std::function<void()> step);
  bool wait(Duration longest);  ///< whether the step has ended
  bool busy() { return !wait(Duration::zero()); }
  Duration waitedInVain();  ///< for this step, in all; zero: it has ended

 private:
  struct Shared;
  std::shared_ptr<Shared> shared_;
  std::thread thread_;
};

}  // namespace palpa::ar
