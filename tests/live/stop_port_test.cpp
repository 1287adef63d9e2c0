#include "apps/live/stop_port.h"

#include <gtest/gtest.h>

#include <atomic>
#include <filesystem>
#include <memory>
#include <vector>

#include "anatomy/base/error.h"
#include "apps/live/port.h"
#include "peer.h"
#include "tests/support/no_threads.h"
#include "tests/support/short_folder.h"

namespace palpa::live {
namespace {

/// A session's stop, and whoever presses it.
struct Pressed {
  Pressed() : port(path, [this] { ++presses; }) {}
  const test::ShortFolder folder;
  const std::string path = stopSocketOf(folder / "s");
  std::atomic<int> presses{0};
  StopPort port;
};

/// It says that the stop has been pressed.
bool confirms(int socket) {
  char bytes[64];
  return os::ready(socket, os::Wait::to_read, 30'000) &&
         os::receiveSome(socket, bytes, sizeof bytes).value_or(0) > 0;
}

class Hand {
 public:
  explicit Hand(const std::string& path) : socket_(os::connectTo(path)) {}
  ~Hand() {
    if (socket_ >= 0) os::closeSocket(socket_);
  }
  Hand(const Hand&) = delete;
  Hand& operator=(const Hand&) = delete;
  bool press(const std::string& bytes = encoded(FrameKind::stop, "")) const {
    return os::sendSome(socket_, bytes.data(), bytes.size()) == bytes.size();
  }
  bool isConfirmed() const { return confirms(socket_); }

 private:
  const int socket_;
};

TEST(StopPort, PressesAndThenConfirms) {
  Pressed session;
  const Hand hand(session.path);
  for (int i = 1; i <= 3; ++i) {
    ASSERT_TRUE(hand.press());
    ASSERT_TRUE(hand.isConfirmed());
    EXPECT_EQ(session.presses, i);
  }
}

/// Where the session cannot have its threads, nothing of its sockets stays behind.
TEST(StopPort, WithoutAThreadThereIsNoSocketEither) {
  const test::ShortFolder here;
  const std::string path = here / "s";
  const LiveLog log;
  {
    const test::NoThreads none;
    EXPECT_THROW(StopPort(path, [] {}), Error);
    EXPECT_FALSE(std::filesystem::exists(path));
    EXPECT_THROW(Port(path, log, [](const std::string&) {}), Error);
    EXPECT_FALSE(std::filesystem::exists(path));
  }
  EXPECT_NO_THROW(StopPort(path, [] {})) << "the next may have it";
}

TEST(StopPort, NothingElsePressesIt) {
  Pressed session;
  for (const std::string& bytes :
       {encoded(FrameKind::command, "{\"command\":\"stop\"}"), encoded(FrameKind::watch, "1"),
        std::string("S\x01\0\0\0x", 6), std::string("stop\n"), std::string("S")}) {
    const Hand hand(session.path);
    EXPECT_TRUE(hand.press(bytes));
  }
  const Hand hand(session.path);
  ASSERT_TRUE(hand.press());
  ASSERT_TRUE(hand.isConfirmed());
  EXPECT_EQ(session.presses, 1);
}

/// Any number who hold a connection and say nothing.
TEST(StopPort, SilentOnesMakeRoom) {
  Pressed session;
  std::vector<std::unique_ptr<Peer>> silent;
  for (int i = 0; i < 40; ++i) silent.push_back(std::make_unique<Peer>(session.path));
  const Peer last(session.path);  // waits for its turn where the system's queue is full
  Peer hand(session.path);
  ASSERT_TRUE(hand.sendAll(encoded(FrameKind::stop, "")));
  EXPECT_TRUE(eventually([&] { return session.presses == 1; }));
}

TEST(StopPort, EndsAtOnceAndLeavesNothing) {
  const test::ShortFolder folder;
  auto port = std::make_unique<StopPort>(folder / "s", [] {});
  const Hand silent(folder / "s");
  EXPECT_FALSE(std::filesystem::is_empty(folder.path()));
  port.reset();  // returns, whoever is connected
  EXPECT_TRUE(std::filesystem::is_empty(folder.path()));
}

}  // namespace
}  // namespace palpa::live
