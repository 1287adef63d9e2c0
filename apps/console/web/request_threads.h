#pragma once

#include <condition_variable>
#include <functional>
#include <list>
#include <map>
#include <memory>
#include <mutex>
#include <string>
#include <thread>
#include <vector>

#include "apps/console/web/lobby.h"

namespace palpa::console {

/// The threads that answer. kThreads for everything that a page asks, of which one address has at
/// most kMostOfOne, and which give way to the rest of the computer; one more for emergency stops
/// alone, which does not. What finds no free thread waits; at most kMost are being answered or wait
/// for it, kMostOfOne of one address.
class RequestThreads {
 public:
  static constexpr std::size_t kMost = 96, kMostOfOne = 24;
  static constexpr int kThreads = 40;
  using Answer = std::function<void(std::unique_ptr<Caller>)>;
  /// Throws Error where the system gives no further threads.
  RequestThreads(Answer answer, Answer stop);
  ~RequestThreads() { end(); }

  /// False, and the caller is left to whoever asked: there is no place. Any thread.
  bool take(std::unique_ptr<Caller>& caller);
  bool takeStop(std::unique_ptr<Caller>& caller);
  /// Half of the threads are taken: whoever is slow gets less time.
  bool crowded();
  /// After those that are being answered. Who waits is dropped.
  void end();

 private:
  /// Those who wait, those who are being answered, and how many of each address.
  struct Line {
    std::condition_variable came;
    std::list<std::unique_ptr<Caller>> waiting;
    std::map<std::string, std::size_t> of;
    std::size_t all = 0;
  };
  bool join(Line& line, std::unique_ptr<Caller>& caller);
  void start();
  void work(Line& line, const Answer& answer);

  const Answer answer_, stop_;
  std::mutex mutex_;
  Line requests_, stops_;
  bool ending_ = false;
  std::vector<std::thread> threads_;
};

}  // namespace palpa::console
