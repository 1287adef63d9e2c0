#include "ar/headset/xr_thread.h"

#include <algorithm>
#include <condition_variable>
#include <mutex>
#include <utility>

namespace palpa::ar {

struct XrThread::Shared {
  std::mutex mutex;
  std::condition_variable changed;
  std::function<void()> step;
  bool busy = false, over = false;
  Duration waited{0};  ///< in vain, for this step

  void run() {
    std::unique_lock lock(mutex);
    for (;;) {
      changed.wait(lock, [this] { return busy || over; });
      if (over) return;
      std::function<void()> now = std::exchange(step, nullptr);
      lock.unlock();
      now();
      now = nullptr;  // what it holds goes before anybody hears that it has ended
      lock.lock();
      busy = false;
      changed.notify_all();
    }
  }
};

XrThread::XrThread()
    : shared_(std::make_shared<Shared>()), thread_([shared = shared_] { shared->run(); }) {}

XrThread::~XrThread() {
  bool hangs = false;
  {
    const std::lock_guard lock(shared_->mutex);
    shared_->over = true;
    hangs = shared_->busy;
    shared_->changed.notify_all();
  }
  if (hangs)
    thread_.detach();
  else
    thread_.join();
}

void XrThread::start(std::function<void()> step) {
  const std::lock_guard lock(shared_->mutex);
  shared_->step = std::move(step);
  shared_->waited = Duration::zero();
  shared_->busy = true;
  shared_->changed.notify_all();
}

bool XrThread::wait(Duration longest) {
  std::unique_lock lock(shared_->mutex);
  const auto ended = [this] { return !shared_->busy; };
  if (longest <= Duration::zero()) return ended();
  if (shared_->changed.wait_for(lock, longest, ended)) return true;
  shared_->waited += longest;
  return false;
}

XrThread::Duration XrThread::waitedInVain() {
  const std::lock_guard lock(shared_->mutex);
  return shared_->busy ? shared_->waited : Duration::zero();
}

}  // namespace palpa::ar
