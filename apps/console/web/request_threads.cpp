#include "apps/console/web/request_threads.h"

#include <exception>
#include <utility>

#include "apps/os/real_time.h"

namespace palpa::console {

RequestThreads::RequestThreads(Answer answer, Answer stop)
    : answer_(std::move(answer)), stop_(std::move(stop)) {
  try {
    start();
  } catch (...) {
    end();
    throw;
  }
}

void RequestThreads::start() {
  threads_.reserve(kThreads + 1);
  threads_.push_back(os::startThread([this] { work(stops_, stop_); }));
  for (int i = 0; i < kThreads; ++i)
    threads_.push_back(os::startThread([this] {
      os::giveWay();
      work(requests_, answer_);
    }));
}

void RequestThreads::end() {
  {
    const std::lock_guard lock(mutex_);
    ending_ = true;
  }
  requests_.came.notify_all();
  stops_.came.notify_all();
  for (std::thread& thread : threads_) thread.join();
  threads_.clear();
}

bool RequestThreads::join(Line& line, std::unique_ptr<Caller>& caller) {
  {
    const std::lock_guard lock(mutex_);
    const auto known = line.of.find(caller->remote);
    if (ending_ || line.all >= kMost || (known != line.of.end() && known->second >= kMostOfOne))
      return false;
    ++line.of[caller->remote];
    ++line.all;
    line.waiting.push_back(std::move(caller));
  }
  line.came.notify_one();
  return true;
}

bool RequestThreads::crowded() {
  const std::lock_guard lock(mutex_);
  return requests_.all > kThreads / 2;
}

bool RequestThreads::take(std::unique_ptr<Caller>& caller) { return join(requests_, caller); }

bool RequestThreads::takeStop(std::unique_ptr<Caller>& caller) { return join(stops_, caller); }

void RequestThreads::work(Line& line, const Answer& answer) {
  std::unique_lock lock(mutex_);
  for (;;) {
    line.came.wait(lock, [&] { return ending_ || !line.waiting.empty(); });
    if (ending_) return;
    std::unique_ptr<Caller> caller = std::move(line.waiting.front());
    line.waiting.pop_front();
    const std::string remote = caller->remote;
    lock.unlock();
    try {
      answer(std::move(caller));
    } catch (
        const std::exception&) {  // no memory left: this connection ends, the next may be served
    }
    lock.lock();
    --line.all;
    if (--line.of[remote] == 0) line.of.erase(remote);
  }
}

}  // namespace palpa::console
