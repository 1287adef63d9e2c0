#include "apps/os/socket.h"

#include <gtest/gtest.h>
#include <netinet/in.h>
#include <netinet/tcp.h>
#include <sys/socket.h>

#include <utility>
#include <vector>

#include "anatomy/base/error.h"
#include "apps/os/tcp_socket.h"

namespace palpa::os {
namespace {

/// Two ends of one connection; the second may leave.
struct Pair {
  Pair() { EXPECT_EQ(::socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, ends), 0); }
  ~Pair() {
    leave();
    closeSocket(ends[0]);
  }
  void leave() {
    if (ends[1] >= 0) closeSocket(std::exchange(ends[1], -1));
  }
  int ends[2] = {-1, -1};
};

TEST(Socket, NothingThereIsNotTheSameAsNobodyThere) {
  Pair pair;
  char bytes[8];
  EXPECT_FALSE(ready(pair.ends[0], Wait::to_read, 0));
  EXPECT_EQ(receiveSome(pair.ends[0], bytes, sizeof bytes), 0u) << "it would have to wait";
  EXPECT_EQ(sendSome(pair.ends[1], "abc", 3), 3u);
  EXPECT_TRUE(ready(pair.ends[0], Wait::to_read, 0));
  EXPECT_EQ(receiveSome(pair.ends[0], bytes, sizeof bytes), 3u);
  pair.leave();
  EXPECT_TRUE(ready(pair.ends[0], Wait::to_read, 0));
  EXPECT_FALSE(receiveSome(pair.ends[0], bytes, sizeof bytes));
  EXPECT_FALSE(sendSome(pair.ends[0], "abc", 3)) << "and no signal ends the program";
}

TEST(Socket, WhoTakesNothingKeepsNobodyWaiting) {
  const Pair pair;
  const std::vector<char> much(1 << 20);
  std::size_t sent = 0;
  for (std::size_t some; (some = sendSome(pair.ends[0], much.data(), much.size()).value()) > 0;)
    sent += some;
  EXPECT_GT(sent, 0u);
  EXPECT_FALSE(ready(pair.ends[0], Wait::to_write, 0));
  EXPECT_FALSE(readerTakes(pair.ends[0], 0));
}

TEST(Socket, AReaderThatLeftTakesNothing) {
  Pair pair;
  EXPECT_TRUE(readerTakes(pair.ends[0], 0));
  pair.leave();
  EXPECT_FALSE(readerTakes(pair.ends[0], 0));
}

TEST(Socket, OneSideMayEndWritingAndStillRead) {
  const Pair pair;
  char bytes[8];
  endWriting(pair.ends[0]);
  EXPECT_FALSE(receiveSome(pair.ends[1], bytes, sizeof bytes));
  EXPECT_EQ(sendSome(pair.ends[1], "x", 1), 1u);
  EXPECT_EQ(receiveSome(pair.ends[0], bytes, sizeof bytes), 1u);
  endBoth(pair.ends[0]);
  EXPECT_FALSE(sendSome(pair.ends[1], "x", 1));
}

TEST(Socket, WaitsForAnyOfMany) {
  const Pair quiet, loud;
  EXPECT_EQ(sendSome(loud.ends[1], "x", 1), 1u);
  const WatchedSocket all[] = {{quiet.ends[0]}, {loud.ends[0]}};
  waitForAny(all, 60'000);  // at once: one is ready
  EXPECT_TRUE(ready(loud.ends[0], Wait::to_read, 0));
  EXPECT_FALSE(ready(quiet.ends[0], Wait::to_read, 0));
}

TEST(Socket, AddressesOfBothEnds) {
  TcpListener listener("127.0.0.1", 0);
  TcpSocket caller = TcpSocket::connecting("127.0.0.1", listener.port());
  ASSERT_EQ(caller.connected(30'000), TcpSocket::Progress::done);
  const auto peer = peerOf(caller.descriptor()), own = ownOf(caller.descriptor());
  ASSERT_TRUE(peer && own);
  EXPECT_EQ(peer->ip, "127.0.0.1");
  EXPECT_EQ(peer->port, listener.port());
  EXPECT_EQ(own->ip, "127.0.0.1");
  EXPECT_NE(own->port, peer->port);
  const Pair local;
  EXPECT_EQ(peerOf(local.ends[0])->ip, "");
  EXPECT_FALSE(peerOf(-1));
}

TEST(Socket, AnAcceptedConnectionSendsAtOnceAndMayBeShared) {
  TcpListener listener("127.0.0.1", 0);
  TcpSocket caller = TcpSocket::connecting("127.0.0.1", listener.port());
  ASSERT_EQ(caller.connected(30'000), TcpSocket::Progress::done);
  TcpSocket here;
  for (int tries = 0; tries < 3000 && !here.open(); ++tries) {
    ready(caller.descriptor(), Wait::to_read, 10);
    here = listener.accept();
  }
  ASSERT_TRUE(here.open());
  int on = 0;
  socklen_t size = sizeof on;
  ::getsockopt(here.descriptor(), IPPROTO_TCP, TCP_NODELAY, &on, &size);
  EXPECT_NE(on, 0);
  const int shared = sharedSocket(here.descriptor());
  ASSERT_GE(shared, 0);
  EXPECT_EQ(peerOf(shared)->port, peerOf(here.descriptor())->port) << "it is the same connection";
  closeSocket(shared);
  EXPECT_EQ(sendSome(here.descriptor(), "x", 1), 1u) << "and goes on without the second descriptor";
}

TEST(Socket, AWakeUpIsReadyUntilItIsTaken) {
  WakeUp wake;
  EXPECT_FALSE(ready(wake.descriptor(), Wait::to_read, 0));
  for (int i = 0; i < 3; ++i) wake.wake();
  EXPECT_TRUE(ready(wake.descriptor(), Wait::to_read, 0));
  wake.taken();
  EXPECT_FALSE(ready(wake.descriptor(), Wait::to_read, 0));
  wake.taken();  // never waits
}

TEST(Socket, OnlyFiguresAreLoopback) {
  for (const char* own : {"127.0.0.1", "127.1.2.3"}) EXPECT_TRUE(isLoopbackAddress(own)) << own;
  for (const char* other : {"127.evil.org", "10.0.0.1", "0.0.0.0", "localhost", "::1", ""})
    EXPECT_FALSE(isLoopbackAddress(other)) << other;
}

TEST(TcpListener, WhyAPortCannotBeHadIsSaidInOurWords) {
  const TcpListener taken("127.0.0.1", 0);
  try {
    const TcpListener second("127.0.0.1", taken.port(), "the data", "Choose another port");
    ADD_FAILURE() << "two at one port";
  } catch (const Error& e) {
    EXPECT_EQ(e.what(), "the data at 127.0.0.1:" + std::to_string(taken.port()) +
                            ": cannot be served (another program uses this port). Choose another "
                            "port");
  }
}

}  // namespace
}  // namespace palpa::os
