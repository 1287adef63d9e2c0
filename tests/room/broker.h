#pragma once

#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>
#include <string>

#include "anatomy/base/utc.h"
#include "apps/os/tcp_socket.h"
#include "apps/room/pairing.h"
#include "apps/runtime/clock.h"

namespace palpa::room {

inline std::chrono::sys_seconds today() { return utcSecondsOf(runtime::utcNow()); }

/// Comes true within twenty seconds.
template <class Condition>
bool soon(const Condition& condition) {
  return runtime::comesTrue(std::chrono::seconds(20), condition);
}

inline int freePort() { return os::TcpListener("127.0.0.1", 0).port(); }

/// The broker that Debian has, with a room's own settings.
class Broker {
 public:
  explicit Broker(const Room& room) : settings_(room.brokerSettings()), port_(room.port()) {
    start();
  }
  ~Broker() { kill(SIGTERM); }
  Broker(const Broker&) = delete;
  Broker& operator=(const Broker&) = delete;

  static bool isInstalled() { return access("/usr/sbin/mosquitto", X_OK) == 0; }
  void start() {
    process_ = fork();
    if (process_ == 0) become();
    EXPECT_TRUE(soon([this] { return answers(); }));
  }
  void kill(int signal) {
    if (process_ <= 0) return;
    ::kill(process_, signal);
    waitpid(process_, nullptr, 0);
    process_ = -1;
  }
  void readAgain() const { ::kill(process_, SIGHUP); }

 private:
  [[noreturn]] void become() const {
    const int log = open((settings_ + ".log").c_str(), O_WRONLY | O_CREAT | O_APPEND, 0600);
    dup2(log, 1);
    dup2(log, 2);
    execl("/usr/sbin/mosquitto", "mosquitto", "-c", settings_.c_str(), nullptr);
    _exit(127);
  }
  /// It listens, and heeds signals.
  bool answers() const {
    const auto line = os::TcpSocket::connecting("127.0.0.1", static_cast<std::uint16_t>(port_));
    return line.connected(100) == os::TcpSocket::Progress::done;
  }

  const std::string settings_;
  const int port_;
  pid_t process_ = -1;
};

}  // namespace palpa::room
