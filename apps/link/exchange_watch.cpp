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
  before_ = 0;
}

void WatchedConnection::beginExchange() {
  const std::lock_guard lock(mutex_);
  before_ = shared_ < 0 ? 0 : os::bytesReceived(shared_);
}

std::uint64_t WatchedConnection::received() {
  const std::lock_guard lock(mutex_);
  return shared_ < 0 ? 0 : os::bytesReceived(shared_) - before_;
}

void WatchedConnection::cut() {
  const std::lock_guard lock(mutex_);
  if (shared_ >= 0) os::endBoth(shared_);
}

void WatchedConnection::drop() {
  if (shared_ >= 0) os::closeSocket(shared_);
  shared_ = -1;
}

ExchangeWatch::ExchangeWatch(WatchedConnection& connection, std::chrono::seconds whole,
                             std::uint64_t most)
    : connection_(connection), until_(runtime::ServingClock::now() + whole), most_(most) {
  connection_.beginExchange();
  thread_ = std::thread([this] { watch(); });
}

ExchangeWatch::Cut ExchangeWatch::end() {
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
    if (cut_ == Cut::no && connection_.received() > most_) cut_ = Cut::too_much;
    if (cut_ == Cut::no && runtime::ServingClock::now() > until_) cut_ = Cut::too_slow;
    if (cut_ != Cut::no) connection_.cut();
  }
}

}  // namespace palpa::link
