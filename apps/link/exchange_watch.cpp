#include "apps/link/exchange_watch.h"

#include "apps/os/socket.h"

namespace palpa::link {
namespace {

constexpr std::chrono::milliseconds kWatchEvery{10};

}  // namespace

WatchedConnection::~WatchedConnection() { drop(); }

void WatchedConnection::use(int socket) {
  const std::lock_guard lock(mutex_);
  drop();
  shared_ = os::sharedSocket(socket);
}

void WatchedConnection::cut() {
  const std::lock_guard lock(mutex_);
  if (shared_ >= 0) os::endBoth(shared_);
}

void WatchedConnection::drop() {
  if (shared_ >= 0) os::closeSocket(shared_);
  shared_ = -1;
}

ExchangeWatch::ExchangeWatch(WatchedConnection& connection, std::chrono::seconds whole)
    : connection_(connection), until_(runtime::ServingClock::now() + whole) {
  thread_ = std::thread([this] { watch(); });
}

bool ExchangeWatch::end() {
  {
    const std::lock_guard lock(mutex_);
    over_ = true;
  }
  changed_.notify_all();
  if (thread_.joinable()) thread_.join();
  return cut_;
}

/// Once cut, what the client opens anew is cut as well.
void ExchangeWatch::watch() {
  std::unique_lock lock(mutex_);
  while (!changed_.wait_for(lock, kWatchEvery, [this] { return over_; })) {
    cut_ = runtime::ServingClock::now() > until_;
    if (cut_) connection_.cut();
  }
}

}  // namespace palpa::link
