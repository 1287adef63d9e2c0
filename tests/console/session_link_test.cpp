#include "apps/console/session_link.h"

#include <gtest/gtest.h>
#include <sys/socket.h>
#include <unistd.h>

#include <memory>

#include "apps/live/port.h"
#include "apps/os/local_socket.h"
#include "tests/support/damage.h"
#include "tests/support/short_folder.h"

namespace palpa::console {
namespace {

using namespace std::chrono_literals;
constexpr std::chrono::milliseconds kLong = 30s;

/// A session's end of the line.
struct Session {
  explicit Session(const std::string& path, const std::string& hello = "{\"kind\":\"hello\"}")
      : path_(path) {
    log.add(hello);
    open();
  }
  void open() {
    port = std::make_unique<live::Port>(path_, log, [this](const std::string& command) {
      const std::lock_guard lock(mutex);
      heard += command;
    });
  }
  void tell(int from, int to) {
    for (int i = from; i < to; ++i) log.add(std::to_string(i));
  }
  std::string whatWasHeard() {
    const std::lock_guard lock(mutex);
    return heard;
  }
  live::LiveLog log;
  std::mutex mutex;
  std::string heard;
  std::unique_ptr<live::Port> port;

 private:
  const std::string path_;
};

/// Entries from `from` on, as a page reads them: asking again for what comes next, until there are
/// `count`.
std::vector<std::string> read(SessionLink& link, std::size_t from, std::size_t count) {
  std::vector<std::string> all;
  const auto until = runtime::ServingClock::now() + kLong;
  while (all.size() < count && runtime::ServingClock::now() < until) {
    const SessionLink::News news = link.wait(from + all.size(), 500ms);
    if (news.from != from + all.size()) return all;
    all.insert(all.end(), news.entries.begin(), news.entries.end());
    if (news.over && news.entries.empty()) break;
  }
  return all;
}

template <class Seen>
bool soon(Seen seen) {
  const auto until = runtime::ServingClock::now() + kLong;
  while (runtime::ServingClock::now() < until) {
    if (seen()) return true;
    runtime::rest(5ms);
  }
  return false;
}

TEST(SessionLink, TellsTheWholeLogInOrderToWhoeverAsksFromAnywhere) {
  const test::ShortFolder here;
  Session session(here / "s");
  session.tell(0, 3000);
  SessionLink link(here / "s");
  EXPECT_EQ(read(link, 0, 3001), session.log.since(0, 10'000));
  EXPECT_EQ(read(link, 2990, 11), session.log.since(2990, 100));
  EXPECT_LE(link.wait(0, 0ms).entries.size(), SessionLink::kMostAtOnce);
  EXPECT_TRUE(link.wait(3001, 0ms).entries.empty());
}

/// The line breaks and comes back: what is known is passed over, nothing is told twice, nothing is
/// lost.
TEST(SessionLink, AfterABrokenLineEachEntryIsThereOnce) {
  const test::ShortFolder here;
  Session session(here / "s");
  SessionLink link(here / "s");
  for (int round = 0; round < 5; ++round) {
    session.tell(100 * round, 100 * round + 60);
    const auto told = static_cast<std::size_t>(round % 2 == 0 ? 100 * round + 61 : 0);
    ASSERT_EQ(read(link, 0, told).size(), told);
    session.port.reset();
    session.tell(100 * round + 60, 100 * (round + 1));
    session.open();
  }
  EXPECT_EQ(read(link, 0, 501), session.log.since(0, 10'000));
}

/// A study's blocks are sessions one after the other at one socket.
TEST(SessionLink, AnotherSessionAtTheSameSocketGoesOnAfterTheFirst) {
  const test::ShortFolder here;
  SessionLink link(here / "s");
  {
    Session first(here / "s", "{\"kind\":\"hello\",\"uuid\":\"1\"}");
    first.tell(0, 10);
    ASSERT_EQ(read(link, 0, 11).size(), 11u);
  }
  Session second(here / "s", "{\"kind\":\"hello\",\"uuid\":\"2\"}");
  second.tell(0, 5);
  const auto all = read(link, 0, 17);
  ASSERT_EQ(all.size(), 17u);
  EXPECT_EQ(all[11], "{\"kind\":\"hello\",\"uuid\":\"2\"}");
}

/// A page that knows more than there is knows another log: it is told this one from its beginning,
/// but not before all of it is here.
TEST(SessionLink, ANumberBeyondTheLogIsAnotherLogs) {
  const test::ShortFolder here;
  {
    SessionLink nobody(here / "s");
    EXPECT_TRUE(nobody.wait(500, 50ms).entries.empty());
    EXPECT_EQ(nobody.wait(500, 0ms).from, 500u) << "nothing is known yet";
  }
  Session session(here / "s");
  session.tell(0, 20);
  SessionLink link(here / "s");
  const SessionLink::News news = link.wait(500'000, kLong);
  EXPECT_EQ(news.from, 0u);
  EXPECT_EQ(news.entries, session.log.since(0, 100));
  EXPECT_EQ(link.wait(21, 0ms).from, 21u) << "just at its end: nothing new";
}

/// A session of many hours: whoever asks for what is not kept any more is told so, who it is, and
/// all that is kept, in numbers that go on.
TEST(SessionLink, TheNewestEntriesAreKept) {
  const test::ShortFolder here;
  Session session(here / "s");
  constexpr int kTold = static_cast<int>(SessionLink::kMostKept) + 500;
  session.tell(0, kTold);
  SessionLink link(here / "s");
  const auto isAllHere = [&] { return link.wait(kTold, 100ms).entries.size() == 1; };
  ASSERT_TRUE(soon(isAllHere));
  session.port.reset();
  session.open();  // all of it is told again
  ASSERT_TRUE(link.wait(kTold + 1, 300ms).entries.empty()) << "nothing twice";
  const SessionLink::News news = link.wait(0, 0ms);
  EXPECT_GT(news.from, 0u);
  ASSERT_GT(news.entries.size(), 2u);
  EXPECT_EQ(news.entries[0], "{\"kind\":\"hello\"}");
  EXPECT_EQ(news.entries[1], R"({"kind":"earlier","count":)" + std::to_string(news.from + 2) + "}");
  const std::size_t kept = kTold + 1 - (news.from + 2);
  EXPECT_LE(kept, SessionLink::kMostKept);
  EXPECT_GE(kept, SessionLink::kMostKept / 2);
  EXPECT_EQ(read(link, news.from + 2, kept), session.log.since(news.from + 2, kept));
  EXPECT_EQ(link.wait(kTold - 3, 0ms).entries, session.log.since(kTold - 3, 10));
  session.tell(kTold, kTold + 1);
  EXPECT_EQ(link.wait(kTold + 1, kLong).entries.size(), 1u) << "and it goes on";
}

TEST(SessionLink, TheEndIsToldOnce) {
  const test::ShortFolder here;
  auto session = std::make_unique<Session>(here / "s");
  SessionLink link(here / "s");
  ASSERT_EQ(read(link, 0, 1).size(), 1u);
  EXPECT_TRUE(link.send("{}"));
  session.reset();
  for (int i = 0; i < 3; ++i) link.close("{\"kind\":\"end\"}");
  EXPECT_EQ(read(link, 0, 5),
            (std::vector<std::string>{"{\"kind\":\"hello\"}", "{\"kind\":\"end\"}"}));
  EXPECT_TRUE(link.wait(2, 0ms).over);
  EXPECT_FALSE(link.send("{}"));
  EXPECT_EQ(link.picture(0, 0ms).jpeg, nullptr);
}

TEST(SessionLink, RequestsArriveInOrderAndNobodyIsPromisedWhatNobodyHears) {
  const test::ShortFolder here;
  SessionLink link(here / "s");
  EXPECT_FALSE(link.send("lost"));
  Session session(here / "s");
  ASSERT_TRUE(soon([&] { return link.send("a"); }));
  for (const char* more : {"b", "c", "d"}) EXPECT_TRUE(link.send(more));
  EXPECT_TRUE(soon([&] { return session.whatWasHeard() == "abcd"; }));
}

TEST(SessionLink, PicturesAreDrawnWhileSomebodyLooks) {
  const test::ShortFolder here;
  Session session(here / "s");
  SessionLink link(here / "s");
  ASSERT_EQ(read(link, 0, 1).size(), 1u);
  EXPECT_FALSE(session.port->wantsPicture());
  EXPECT_EQ(link.picture(0, 0ms).jpeg, nullptr);
  ASSERT_TRUE(soon([&] { return session.port->wantsPicture(); }));
  session.port->offer({16, 16, 3, std::vector<std::uint8_t>(768, 100)});
  const SessionLink::Picture picture = link.picture(0, kLong);
  ASSERT_NE(picture.jpeg, nullptr);
  EXPECT_EQ(picture.jpeg->substr(0, 2), "\xff\xd8");
  EXPECT_EQ(link.picture(picture.number, 0ms).jpeg, nullptr);
}

/// Whatever sits at the socket and talks nonsense: no entry comes of it, and the link lives on for
/// the session that comes then.
TEST(SessionLink, NonsenseAtTheOtherEndHurtsNothing) {
  const test::ShortFolder here;
  SessionLink link(here / "s");
  {
    const int listener = os::listenAt(here / "s");
    test::DamageDice dice(9);
    for (int i = 0; i < 8; ++i) {
      int caller = -1;
      ASSERT_TRUE(soon([&] { return (caller = ::accept(listener, nullptr, nullptr)) >= 0; }));
      std::string bytes = i % 4 == 0   ? "HTTP/1.1 200 OK\r\n\r\n"
                          : i % 4 == 1 ? std::string("L\xff\xff\xff\xff", 5)
                          : i % 4 == 2 ? std::string("L\x10\0\0\0half", 9)
                                       : std::string("K\x03\0\0\0-9x", 8);
      for (std::size_t more = dice.below(50); i % 4 == 0 && more > 0; --more)
        bytes += static_cast<char>(dice.below(256));
      ::send(caller, bytes.data(), bytes.size(), MSG_NOSIGNAL);
      ::close(caller);
    }
    ::close(listener);
  }
  EXPECT_FALSE(link.hasReported());
  Session session(here / "s");
  session.tell(0, 10);
  EXPECT_EQ(read(link, 0, 11), session.log.since(0, 100));
}

/// XDG_RUNTIME_DIR may be too long for a socket: nobody is there then, and the console lives.
TEST(SessionLink, APathThatNoSocketCanHave) {
  SessionLink link("/" + std::string(300, 'x'));
  EXPECT_FALSE(link.send("{}"));
  runtime::rest(200ms);  // its thread has tried
  EXPECT_TRUE(link.wait(0, 0ms).entries.empty());
}

TEST(SessionLink, ManyReadWhileTheSessionTalksAndTheLineBreaks) {
  const test::ShortFolder here;
  Session session(here / "s");
  SessionLink link(here / "s");
  std::vector<std::vector<std::string>> got(5);
  std::vector<std::thread> readers;
  for (auto& one : got) readers.emplace_back([&] { one = read(link, 0, 2001); });
  std::thread steering([&] {
    for (int i = 0; i < 100; ++i) {
      link.send("x");
      link.picture(0, 1ms);
    }
  });
  for (int i = 0; i < 20; ++i) {
    session.tell(100 * i, 100 * (i + 1));
    if (i % 5 == 4) {
      session.port.reset();
      session.open();
    }
  }
  for (std::thread& reader : readers) reader.join();
  steering.join();
  for (const auto& one : got) EXPECT_EQ(one, session.log.since(0, 10'000));
}

}  // namespace
}  // namespace palpa::console
