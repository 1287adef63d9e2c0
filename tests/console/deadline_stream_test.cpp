#include "apps/console/web/http_framing.h"

#include <gtest/gtest.h>
#include <sys/socket.h>
#include <unistd.h>

#include <atomic>
#include <thread>

namespace palpa::console {
namespace {

using namespace std::chrono_literals;
using Clock = DeadlineStream::Clock;

struct Line {
  Line() { EXPECT_EQ(::socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, ends), 0); }
  ~Line() {
    leave();
    ::close(ends[0]);
  }
  void leave() {
    if (ends[1] >= 0) ::close(ends[1]);
    ends[1] = -1;
  }
  void say(const std::string& bytes) {
    EXPECT_EQ(::send(ends[1], bytes.data(), bytes.size(), MSG_NOSIGNAL),
              static_cast<ssize_t>(bytes.size()));
  }
  int ends[2] = {-1, -1};
};

std::string readAll(DeadlineStream& stream, std::size_t piece) {
  std::string all, bytes(piece, '\0');
  for (ssize_t count; (count = stream.read(bytes.data(), piece)) > 0;)
    all.append(bytes.data(), static_cast<std::size_t>(count));
  return all;
}

TEST(DeadlineStream, GivesWhatCameInPiecesOfAnySize) {
  for (const std::size_t piece : {1u, 3u, 4096u, 10'000u}) {
    Line line;
    os::Line plain(line.ends[0]);
    DeadlineStream stream(plain);
    const std::string said(10'000, 'a');
    line.say(said);
    line.leave();
    stream.begin(Clock::now() + 30s, 1 << 20);
    EXPECT_EQ(readAll(stream, piece), said);
    EXPECT_FALSE(stream.cut());
    EXPECT_TRUE(stream.left());
  }
}

TEST(DeadlineStream, EndsAtItsSize) {
  for (const std::size_t most : {0u, 1u, 100u, 4096u, 5000u}) {
    Line line;
    os::Line plain(line.ends[0]);
    DeadlineStream stream(plain);
    line.say(std::string(20'000, 'a'));
    stream.begin(Clock::now() + 30s, most);
    EXPECT_EQ(readAll(stream, 777).size(), most);
    EXPECT_TRUE(stream.cut());
    EXPECT_FALSE(stream.left());
  }
}

TEST(DeadlineStream, EndsAtItsMomentHoweverSlowlyBytesCome) {
  Line line;
  os::Line plain(line.ends[0]);
  DeadlineStream stream(plain);
  std::atomic<bool> ending{false};
  std::thread drip([&] {
    while (!ending.load()) {
      line.say("a");
      runtime::rest(5ms);
    }
  });
  stream.begin(Clock::now() + 200ms, 1 << 20);
  const std::string got = readAll(stream, 1);  // returns, although it never ends
  ending.store(true);
  drip.join();
  EXPECT_TRUE(stream.cut());
  EXPECT_LT(got.size(), 1000u);
}

TEST(DeadlineStream, SilenceAndAMomentThatIsOverAreCut) {
  Line line;
  os::Line plain(line.ends[0]);
  DeadlineStream stream(plain);
  stream.begin(Clock::now() - 1s, 100);
  char byte = 0;
  EXPECT_EQ(stream.read(&byte, 1), -1);
  EXPECT_TRUE(stream.cut());
  EXPECT_FALSE(stream.waits(0ms));
  line.say("a");
  EXPECT_TRUE(stream.waits(0ms));
}

/// What had been read before the request was handed on comes first, and what belongs to the next
/// request is left.
TEST(DeadlineStream, BeginsWithWhatWasReadBefore) {
  Line line;
  os::Line plain(line.ends[0]);
  DeadlineStream stream(plain, "abc");
  line.say("def");
  stream.begin(Clock::now() + 30s, 3);
  char bytes[2];
  EXPECT_TRUE(stream.waits(0ms));
  EXPECT_EQ(stream.read(bytes, 2), 2);
  EXPECT_EQ(stream.rest(), "c");
  EXPECT_EQ(readAll(stream, 2), "cdef");
  EXPECT_EQ(stream.rest(), "");
}

TEST(DeadlineStream, AnAnswerThatIsNotTakenOffEnds) {
  Line line;
  os::Line plain(line.ends[0]);
  DeadlineStream stream(plain);
  stream.answerWithin(0ms, 30s);
  EXPECT_FALSE(stream.is_writable());
  EXPECT_EQ(stream.write("abc", 3), -1);
  stream.answerWithin(std::chrono::milliseconds::max(), 30s);
  EXPECT_EQ(stream.write("abc", 3), 3);
  stream.answerWithin(30s, 10ms);
  const std::string much(1 << 20, 'a');
  std::size_t taken = 0;
  for (ssize_t count; (count = stream.write(much.data(), much.size())) > 0;)
    taken += static_cast<std::size_t>(count);
  EXPECT_GT(taken, 0u);  // what the system holds, and then no more
  EXPECT_EQ(stream.write("abc", 3), -1);
}

TEST(DeadlineStream, WritingToWhoLeftFailsAndKillsNobody) {
  Line line;
  os::Line plain(line.ends[0]);
  DeadlineStream stream(plain);
  EXPECT_TRUE(stream.is_writable());
  EXPECT_EQ(stream.write("abc", 3), 3);
  line.leave();
  EXPECT_FALSE(stream.is_writable());
  for (int i = 0; i < 10; ++i) EXPECT_EQ(stream.write("abc", 3), -1);
}

}  // namespace
}  // namespace palpa::console
