#include "apps/link/bounded_client.h"

#include <algorithm>
#include <cstring>
#include <optional>

#include <openssl/ssl.h>

#include "apps/os/real_time.h"
#include "apps/os/socket.h"

namespace palpa::link {
namespace {

/// The bytes of a connection, protected or not.
struct Transport {
  int socket = -1;
  SSL* tls = nullptr;
  int patience_ms = 0;

  bool readable() const {
    return (tls && SSL_pending(tls) > 0) || os::ready(socket, os::Wait::to_read, patience_ms);
  }
  ssize_t read(char* to, std::size_t size) const {
    if (!readable()) return -1;
    if (tls) return SSL_read(tls, to, static_cast<int>(size));
    const std::optional<std::size_t> count = os::receiveSome(socket, to, size);
    return count ? static_cast<ssize_t>(*count) : 0;
  }
  bool writable() const { return os::ready(socket, os::Wait::to_write, patience_ms); }
  ssize_t write(const char* from, std::size_t size) const {
    if (!writable()) return -1;
    if (tls) return SSL_write(tls, from, static_cast<int>(size));
    const std::optional<std::size_t> count = os::sendSome(socket, from, size);
    return count ? static_cast<ssize_t>(*count) : -1;
  }
};

class BoundedStream final : public httplib::Stream {
 public:
  BoundedStream(const Transport& transport, const AnswerBounds& bounds, AnswerCount& count)
      : transport_(transport), bounds_(bounds), count_(count) {}

  bool is_readable() const override { return at_ < end_ || transport_.readable(); }
  bool is_writable() const override { return transport_.writable(); }
  ssize_t read(char* to, std::size_t size) override {
    if (at_ >= end_) {
      const ssize_t count = transport_.read(buffer_, sizeof buffer_);
      if (count <= 0) return count;
      at_ = 0;
      end_ = static_cast<std::size_t>(count);
    }
    const std::size_t count = std::min(size, end_ - at_);
    std::memcpy(to, buffer_ + at_, count);
    at_ += count;
    return mayCome(to, count) ? static_cast<ssize_t>(count) : -1;
  }
  ssize_t write(const char* from, std::size_t size) override {
    return transport_.write(from, size);
  }
  void get_remote_ip_and_port(std::string& ip, int& port) const override {
    assign(os::peerOf(transport_.socket), ip, port);
  }
  void get_local_ip_and_port(std::string& ip, int& port) const override {
    assign(os::ownOf(transport_.socket), ip, port);
  }
  socket_t socket() const override { return transport_.socket; }

 private:
  static void assign(const std::optional<os::Address>& address, std::string& ip, int& port) {
    if (!address) return;
    ip = address->ip;
    port = address->port;
  }
  bool mayCome(const char* bytes, std::size_t size) {
    count_.bytes += size;
    count_.line_ended = count_.line_ended || std::memchr(bytes, '\n', size) != nullptr;
    const std::size_t most = count_.in_body      ? bounds_.body
                             : count_.line_ended ? bounds_.head
                                                 : bounds_.first_line;
    count_.too_long = count_.bytes > most;
    return !count_.too_long;
  }

  const Transport transport_;
  const AnswerBounds& bounds_;
  AnswerCount& count_;
  char buffer_[4096];
  std::size_t at_ = 0, end_ = 0;
};

/// `Library`: the client with or without protection.
template <class Library>
class BoundedClient final : public Library {
 public:
  BoundedClient(const std::string& host, int port, const AnswerBounds& bounds, AnswerCount& count)
      : Library(host, port), bounds_(bounds), count_(count) {}

 private:
  using Socket = typename Library::Socket;
  bool process_socket(const Socket& socket,
                      std::function<bool(httplib::Stream&)> callback) override {
    count_ = {};
    const int patience_ms = static_cast<int>(1000 * this->read_timeout_sec_);
    BoundedStream stream({socket.sock, socket.ssl, patience_ms}, bounds_, count_);
    return callback(stream);
  }
  const AnswerBounds bounds_;
  AnswerCount& count_;
};

}  // namespace

std::unique_ptr<httplib::ClientImpl> boundedClient(const std::string& host, int port, bool tls,
                                                   const AnswerBounds& bounds, AnswerCount& count) {
  if (tls) return std::make_unique<BoundedClient<httplib::SSLClient>>(host, port, bounds, count);
  return std::make_unique<BoundedClient<httplib::ClientImpl>>(host, port, bounds, count);
}

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

ExchangeWatch::ExchangeWatch(WatchedConnection& connection, std::chrono::seconds whole,
                             const std::atomic<bool>* given_up)
    : connection_(connection), until_(runtime::ServingClock::now() + whole), given_up_(given_up) {
  thread_ = os::startThread([this] { watch(); });
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
    cut_ = runtime::ServingClock::now() > until_ || (given_up_ && *given_up_);
    if (cut_) connection_.cut();
  }
}

}  // namespace palpa::link
