#include "apps/console/web/lobby.h"

#include <gtest/gtest.h>
#include <netinet/tcp.h>
#include <sys/socket.h>

#include <atomic>
#include <future>
#include <thread>
#include <utility>

#include "apps/console/web/web_server.h"
#include "apps/runtime/clock.h"
#include "tests/console/visitor.h"
#include "tests/support/scratch_folder.h"

namespace palpa::console {
namespace {

using namespace std::chrono_literals;
constexpr char kHead[] = "GET / HTTP/1.1\r\nHost: x\r\n\r\n";
constexpr char kStop[] = "POST /api/sessions/a1/stop HTTP/1.1\r\nContent-Length: 2\r\n\r\n{}";
constexpr char kStranger[] = "X-Palpa-Page: guessed\r\n";

template <class Seen>
bool comesTo(Seen seen) {
  const auto until = runtime::ServingClock::now() + 60s;
  while (runtime::ServingClock::now() < until) {
    if (seen()) return true;
    runtime::rest(5ms);
  }
  return false;
}

/// A lobby that runs, and who came out of it.
struct Entrance {
  Entrance()
      : lobby({.request = [this](std::unique_ptr<Caller> who) { put(requests, std::move(who)); },
               .may_stop = [](std::string_view head,
                              const std::string&) { return head.find(kStranger) == head.npos; },
               .stop = [this](std::unique_ptr<Caller> who) { put(stops, std::move(who)); },
               .slow = [this](const std::string&) { ++slow; },
               .away = [this] { ++away; }}) {
    os::neverWait(listener);
    thread = std::thread([this] { lobby.run(listener); });
  }
  ~Entrance() {
    lobby.end();
    thread.join();
    os::closeSocket(listener);
  }
  static int listening() {
    const int socket = ::socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0);
    sockaddr_in here{};
    here.sin_family = AF_INET;
    here.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    EXPECT_EQ(::bind(socket, reinterpret_cast<sockaddr*>(&here), sizeof here), 0);
    EXPECT_EQ(::listen(socket, 512), 0);
    return socket;
  }
  void put(std::vector<std::unique_ptr<Caller>>& to, std::unique_ptr<Caller> caller) {
    const std::lock_guard lock(mutex);
    to.push_back(std::move(caller));
  }
  std::size_t count(const std::vector<std::unique_ptr<Caller>>& of) {
    const std::lock_guard lock(mutex);
    return of.size();
  }
  std::unique_ptr<Caller> next(std::vector<std::unique_ptr<Caller>>& from) {
    EXPECT_TRUE(comesTo([&] { return count(from) > 0; }));
    const std::lock_guard lock(mutex);
    if (from.empty()) return nullptr;
    std::unique_ptr<Caller> caller = std::move(from.front());
    from.erase(from.begin());
    return caller;
  }

  const int listener = listening();
  const int port = os::ownOf(listener)->port;
  std::mutex mutex;
  std::vector<std::unique_ptr<Caller>> requests, stops;
  std::atomic<int> slow{0}, away{0};
  Lobby lobby;
  std::thread thread;
};

TEST(Lobby, HandsOnAWholeHeadHoweverItComes) {
  Entrance entrance;
  const Visitor visitor(entrance.port, "127.0.0.5");
  for (const char c : std::string(kHead)) {
    EXPECT_EQ(entrance.count(entrance.requests), 0u) << "before its end";
    visitor.say(std::string(1, c));
  }
  const auto caller = entrance.next(entrance.requests);
  ASSERT_TRUE(caller);
  EXPECT_EQ(caller->said, kHead);
  EXPECT_EQ(caller->remote, "127.0.0.5");
  int on = 0;
  socklen_t size = sizeof on;
  ::getsockopt(caller->socket, IPPROTO_TCP, TCP_NODELAY, &on, &size);
  EXPECT_NE(on, 0) << "a small answer would wait for the other side's word";
}

TEST(Lobby, AnswersComeBackAndTheNextRequestMayBeThereAlready) {
  Entrance entrance;
  const Visitor visitor(entrance.port, "127.0.0.1");
  visitor.say(kHead);
  auto caller = entrance.next(entrance.requests);
  ASSERT_TRUE(caller);
  caller->said = "POST /next";  // came with the first
  entrance.lobby.comeBack(std::move(caller));
  visitor.say(" HTTP/1.1\r\n\r\n");
  caller = entrance.next(entrance.requests);
  ASSERT_TRUE(caller);
  EXPECT_EQ(caller->said, "POST /next HTTP/1.1\r\n\r\n");
}

TEST(Lobby, AStopGoesItsOwnWayWhenAllOfItIsHere) {
  Entrance entrance;
  const Visitor visitor(entrance.port, "127.0.0.1");
  const std::string stop = kStop;
  visitor.say(stop.substr(0, stop.size() - 1));
  runtime::rest(100ms);
  EXPECT_EQ(entrance.count(entrance.stops) + entrance.count(entrance.requests), 0u)
      << "a byte of it is missing";
  visitor.say(stop.substr(stop.size() - 1));
  const auto caller = entrance.next(entrance.stops);
  ASSERT_TRUE(caller);
  EXPECT_EQ(caller->said, stop);
}

/// Nobody reaches the stop's thread with what it would have to wait for.
TEST(Lobby, WhatOnlyLooksLikeAStopIsARequest) {
  for (const char* said :
       {"GET /api/sessions/a1/stop HTTP/1.1\r\n\r\n",
        "POST /api/sessions/a1/stop HTTP/1.1\r\nContent-Length: 9999\r\n\r\n",
        "POST /api/sessions/a1/stop HTTP/1.1\r\nContent-Length: 2\r\nContent-Length: 2\r\n\r\n{}",
        "POST /api/sessions/a1/stopped HTTP/1.1\r\n\r\n", "POST /stop HTTP/1.1\r\n\r\n",
        "POST /api/sessions/a1/command HTTP/1.1\r\nX: /stop HTTP/1.1\r\n\r\n"}) {
    Entrance entrance;
    const Visitor visitor(entrance.port, "127.0.0.1");
    visitor.say(said);
    EXPECT_TRUE(entrance.next(entrance.requests)) << said;
    EXPECT_EQ(entrance.count(entrance.stops), 0u) << said;
  }
}

/// Nobody who may not stop reaches that thread, nor waits for the rest of a body here.
TEST(Lobby, AStrangersStopIsARequest) {
  Entrance entrance;
  const std::string head = std::string("POST /api/sessions/a1/stop HTTP/1.1\r\n") + kStranger +
                           "Content-Length: 2\r\n\r\n";
  for (const std::string& said : {head, head + "{}"}) {
    const Visitor visitor(entrance.port, "127.0.0.1");
    visitor.say(said);
    EXPECT_TRUE(entrance.next(entrance.requests)) << said;
    EXPECT_EQ(entrance.count(entrance.stops), 0u) << said;
  }
}

/// Silent ones of one address take no place from another, nor from who speaks at their own.
TEST(Lobby, WhoIsSilentLongestMakesRoomWithinItsAddress) {
  Entrance entrance;
  const Visitor other(entrance.port, "127.0.0.2");
  ASSERT_TRUE(comesTo([&] { return !os::ready(entrance.listener, os::Wait::to_read, 0); }));
  std::vector<std::unique_ptr<Visitor>> silent;
  for (int i = 0; i < 60; ++i)
    silent.push_back(std::make_unique<Visitor>(entrance.port, "127.0.0.1"));
  ASSERT_TRUE(comesTo([&] { return entrance.away >= 60 - static_cast<int>(Lobby::kMostOfOne); }));
  EXPECT_EQ(silent.front()->lastWords().rfind("HTTP/1.1 503 ", 0), 0u) << "the first goes first";
  const Visitor speaks(entrance.port, "127.0.0.1");
  speaks.say(kHead);
  const auto own = entrance.next(entrance.requests);
  ASSERT_TRUE(own);
  EXPECT_EQ(own->remote, "127.0.0.1");
  other.say(kHead);
  const auto first = entrance.next(entrance.requests);
  ASSERT_TRUE(first) << "who came before them all has gone";
  EXPECT_EQ(first->remote, "127.0.0.2");
  const Visitor stops(entrance.port, "127.0.0.1");
  stops.say(kStop);
  EXPECT_TRUE(entrance.next(entrance.stops));
}

TEST(Lobby, ManyAddressesTogetherHaveABoundToo) {
  Entrance entrance;
  std::vector<std::unique_ptr<Visitor>> silent;
  for (int i = 0; i < 150; ++i)
    silent.push_back(std::make_unique<Visitor>(entrance.port,
                                               ("127.0.1." + std::to_string(1 + i % 10)).c_str()));
  ASSERT_TRUE(comesTo([&] { return entrance.away >= 150 - static_cast<int>(Lobby::kMost); }));
  const Visitor stranger(entrance.port, "127.0.0.9");
  stranger.say(kHead);
  EXPECT_TRUE(entrance.next(entrance.requests));
}

TEST(Lobby, WhoSaysNothingOrNeverEndsIsLetGo) {
  Entrance entrance;
  const Visitor silent(entrance.port, "127.0.0.1"), slow(entrance.port, "127.0.0.2");
  slow.say("GET / HTTP/1.1\r\nX-A: ");
  EXPECT_EQ(silent.lastWords(), "");
  EXPECT_TRUE(comesTo([&] {
    slow.say("a");
    return slow.isEnded();
  }));
  EXPECT_EQ(entrance.slow, 1) << "only a request that was begun is one";
  EXPECT_EQ(entrance.count(entrance.requests), 0u);
}

TEST(Lobby, AHeadWithoutEndIsHandedOnToBeRefused) {
  Entrance entrance;
  const Visitor visitor(entrance.port, "127.0.0.1");
  std::thread talks([&] {
    for (int i = 0; i < 64; ++i) {
      visitor.say(std::string(1024, 'a'));
      runtime::rest(1ms);
    }
  });
  const auto caller = entrance.next(entrance.requests);
  talks.join();
  ASSERT_TRUE(caller);
  EXPECT_LT(caller->said.size(), 64u << 10);
}

/// A console behind its lobby, whose emergency stop takes as long as the test lets it.
struct SlowStop {
  SlowStop() {
    const int port = server.bind_to_any_port("127.0.0.1");
    here = "127.0.0.1:" + std::to_string(port);
    guard.answerTo({here});
    server.Post("/api/sessions/a1/stop", [this](const httplib::Request&, httplib::Response& r) {
      ++obeyed;
      let_go.get_future().wait();
      answer(r, nlohmann::json::object(), 202);
    });
    serving = std::thread([this] { server.serve(); });
  }
  ~SlowStop() {
    server.end();
    serving.join();
  }
  /// The answer's status; 0: none came.
  int stop(const std::string& cookie) {
    httplib::Client client("http://" + here);
    client.set_read_timeout(60s);
    const auto answer = client.Post("/api/sessions/a1/stop",
                                    {{"Cookie", "palpa=" + cookie},
                                     {"X-Palpa-Page", guard.pageKey()},
                                     {"X-Palpa-Write", randomKey()}},
                                    "{}", "application/json");
    return answer ? answer->status : 0;
  }

  const test::ScratchFolder folder{"slow_stop"};
  Guard guard{"the-token"};
  Refusals refusals{folder.path() / "refused.log"};
  WebServer server{guard, refusals};
  std::string here;
  std::atomic<int> obeyed{0};
  std::promise<void> let_go;
  std::thread serving;
};

/// While a stop is being obeyed, a hundred of a stranger at the educator's own address are refused
/// at once: none of them waits before the educator's next.
TEST(StopLane, StrangersTakeNoPlaceInIt) {
  SlowStop console;
  const std::string cookie = console.guard.enter("127.0.0.1", "the-token");
  std::thread educator([&] { EXPECT_EQ(console.stop(cookie), 202); });
  EXPECT_TRUE(comesTo([&] { return console.obeyed == 1; }));
  for (int i = 0, status = 401; i < 100 && status == 401; ++i) {
    status = console.stop(std::string(32, '0'));
    EXPECT_EQ(status, 401) << i;
  }
  console.let_go.set_value();
  educator.join();
  EXPECT_EQ(console.obeyed, 1);
}

}  // namespace
}  // namespace palpa::console
