// Too much, too slow, too many.
#include <atomic>
#include <thread>

#include "apps/runtime/clock.h"
#include "attacked.h"
#include "tests/support/counts.h"

namespace palpa::console_attack {
namespace {

using namespace std::chrono_literals;
constexpr std::size_t kGiB = 1u << 30;
constexpr double kMoreMiB = 100;  // than before: 100 threads' own memory, never what was sent

class Sizes : public Attacked {
 protected:
  /// Sends `head`, then `piece` again and again, `total` bytes; says how many were taken.
  std::size_t flood(const std::string& head, const std::string& piece, std::size_t total,
                    Answer* answer) {
    Wire wire(console().port());
    std::size_t taken = wire.send(head);
    for (std::size_t sent = 0; sent < total; sent += piece.size()) {
      const std::size_t count = wire.send(piece);
      taken += count;
      if (count < piece.size()) break;
    }
    *answer = answerIn(wire.read(30s, 64 << 10));
    return taken;
  }
};

TEST_F(Sizes, AGigabyteIsNotTaken) {
  session();
  const std::size_t total = test::counted<std::size_t>(64u << 20, kGiB);
  const double before = residentMiB(console().pid());
  const std::string piece(1 << 16, 'a'), lines = [] {
    std::string all;
    for (int i = 0; i < 4096; ++i) all += "X-A: aaaaaaaaa\r\n";
    return all;
  }();
  Headers announced = console().writeHeaders(""), chunked = announced;
  for (auto& [name, value] : announced)
    if (name == "Content-Length") value = std::to_string(kGiB);
  for (auto& [name, value] : chunked)
    if (name == "Content-Length") name = "Transfer-Encoding", value = "chunked";
  struct Try {
    const char* what;
    std::string head, piece;
    int status;  // 0: the connection ends without an answer that arrives
  };
  const Try tries[] = {
      {"body announced", requestOf("POST", "/api/trainees", announced), piece, 413},
      {"body in chunks", requestOf("POST", "/api/trainees", chunked), "10000\r\n" + piece + "\r\n",
       411},
      {"one header", "GET / HTTP/1.1\r\nHost: " + console().host() + "\r\nX-A: ", piece, 400},
      {"many headers", "GET / HTTP/1.1\r\nHost: " + console().host() + "\r\n", lines, 400},
      {"one path", "GET /", piece, 400},
      {"one method", "", piece, 400},
      {"line ends", "", std::string(1 << 16, '\n'), 400}};
  for (const Try& one : tries) {
    Answer answer;
    const std::size_t taken = flood(one.head, one.piece, total, &answer);
    EXPECT_LT(taken, std::size_t{32} << 20)
        << one.what << ": beyond what the kernel's buffers hold somebody took it";
    EXPECT_TRUE(answer.status == one.status || answer.status == 414 || answer.status == 400 ||
                answer.status == 0)
        << one.what << ' ' << answer.status;
    RecordProperty(std::string(one.what) + ", bytes taken", std::to_string(taken));
  }
  EXPECT_TRUE(isNoted("413 is longer than 64 KiB"));
  EXPECT_TRUE(isNoted("408 a request was too slow or too long"));
  EXPECT_LT(residentMiB(console().pid()) - before, kMoreMiB);
  EXPECT_EQ(console().get("/api/me").status, 200);
  EXPECT_TRUE(goesOn());
}

/// What is small on the line and large in memory: packed bodies, and answers in many parts.
TEST_F(Sizes, NothingGrowsWhenItIsUnpackedOrRepeated) {
  const double before = residentMiB(console().pid());
  Headers packed = console().writeHeaders(std::string(60'000, 'x'));
  for (const char* coding : {"gzip", "br", "deflate", "gzip, gzip"}) {
    Headers headers = console().writeHeaders(std::string(60'000, 'x'));
    headers.emplace_back("Content-Encoding", coding);
    EXPECT_EQ(
        console().raw(requestOf("POST", "/api/trainees", headers, std::string(60'000, 'x'))).status,
        415)
        << coding;
  }
  std::string parts = "bytes=0-";
  for (int i = 0; i < 2000; ++i) parts += ",0-";
  Headers headers = console().readHeaders();
  headers.emplace_back("Range", parts);
  const Answer answer = console().raw(requestOf("GET", "/", headers));
  EXPECT_TRUE(answer.status == 416 || answer.status == 400) << answer.status;
  EXPECT_LT(answer.body.size(), 1000u);
  EXPECT_LT(residentMiB(console().pid()) - before, kMoreMiB);
}

TEST_F(Sizes, DeepAndDamagedJsonIsRefused) {
  for (const std::string& body :
       {std::string(60'000, '['), std::string("{\"id\":") + std::string(60'000, '['),
        std::string("\xff\xfe"), std::string("{\"id\":\"\xc3\"}"), std::string(),
        std::string("null"), std::string("{}{}"), std::string("{\"id\":1e999}"),
        std::string("\0", 1)})
    for (const std::string path : {"/api/trainees", "/api/sessions", "/api/enter",
                                   "/api/calibration", "/api/studies/x/run"}) {
      const Answer answer =
          console().raw(requestOf("POST", path, console().writeHeaders(body), body));
      EXPECT_TRUE((answer.status >= 400 && answer.status < 500))
          << path << ' ' << answer.status << ' ' << body.substr(0, 20);
      if (answer.status == 429) runtime::rest(1s);
    }
  EXPECT_TRUE(goesOn());
}

/// Headers and bodies that never end, byte by byte: each connection is over after ten seconds, and
/// there is room for others meanwhile.
TEST_F(Sizes, SlowOnesAreCutAndOthersAnswered) {
  session();
  std::vector<Wire> slow;
  const int each = test::counted(8, 20);
  const std::string start = requestOf("POST", "/api/trainees", [&] {
    Headers headers = console().writeHeaders("");
    for (auto& [name, value] : headers)
      if (name == "Content-Length") value = "60000";
    return headers;
  }());
  for (int i = 0; i < each; ++i) {
    slow.emplace_back(console().port());  // not a byte
    slow.emplace_back(console().port());  // headers
    slow.back().send("GET / HTTP/1.1\r\nHost: " + console().host() + "\r\nX-Slow: ");
    slow.emplace_back(console().port());  // a body
    slow.back().send(start);
  }
  const double before = residentMiB(console().pid());
  std::atomic<int> answered{0};
  EXPECT_TRUE(inTime([&] {
    int open = 0;
    for (std::size_t i = 0; i < slow.size(); ++i) {
      if (i % 3 != 0) slow[i].send("a", 1ms);
      slow[i].readSome(1ms);
      open += !slow[i].closed();
    }
    answered += console().raw(requestOf("GET", "/api/me", console().readHeaders())).status == 200;
    runtime::rest(200ms);
    return open == 0;
  })) << "some are held for ever";
  EXPECT_GT(answered, 5);
  EXPECT_TRUE(isNoted("408 a request was too slow or too long"));
  EXPECT_LT(residentMiB(console().pid()) - before, kMoreMiB);
  EXPECT_TRUE(goesOn());
}

/// 500 that say nothing: those beyond the console's places are told so at once; the others are let
/// go, the sooner the more there are, and it answers.
TEST_F(Sizes, ACrowdIsToldToWaitAndPasses) {
  session();
  std::vector<Wire> crowd;
  for (int i = 0; i < 500; ++i) crowd.emplace_back(console().port());
  int told = 0;
  for (Wire& one : crowd)
    if (const std::string bytes = one.readSome(20ms); !bytes.empty())
      told += answerIn(bytes).status == 503;
  EXPECT_GT(told, 0);
  const int meanwhile = console().raw(requestOf("GET", "/api/me", console().readHeaders())).status;
  EXPECT_TRUE(meanwhile == 503 || meanwhile == 200) << meanwhile;
  RecordProperty("told to wait", told);
  RecordProperty("answer meanwhile", meanwhile);
  EXPECT_EQ(console().get("/api/me").status, 200) << "never again";
  EXPECT_TRUE(isNoted("503 too many connections"));
  EXPECT_TRUE(goesOn());
}

/// More pages than there are places for streams, of one address and of all: the rest is told so,
/// and a place that is left is free again.
TEST_F(Sizes, StreamsAreCounted) {
  constexpr int kOfOne = 12, kOfAll = 24;  // places
  const std::string path = "/api/sessions/" + session() + "/live";
  std::vector<Wire> streams;
  const auto heldOf = [&](int count, const std::string& from) {
    const std::size_t begin = streams.size();
    for (int i = 0; i < count; ++i) {
      streams.emplace_back(console().port(), from);
      streams.back().send(requestOf("GET", path, console().readHeaders()));
    }
    int held = 0;
    for (std::size_t i = begin; i < streams.size(); ++i)
      held += answerIn(streams[i].readSome(30s)).status == 200;
    return held;
  };
  // Places that an earlier test or the try before has left are free soon, not at once.
  const bool all_free = inTime([&] {
    streams.clear();
    runtime::rest(1500ms);  // it notices at the latest after a second
    const int first = heldOf(20, "127.0.0.2"), second = heldOf(20, "127.0.0.3"),
              third = heldOf(4, "127.0.0.4");
    EXPECT_LE(first, kOfOne);
    EXPECT_LE(second, kOfOne);
    EXPECT_LE(first + second + third, kOfAll);
    return first == kOfOne && second == kOfOne && third == 0;
  });
  EXPECT_TRUE(all_free) << "a place that was left is taken for ever";
  EXPECT_EQ(console().get("/api/me").status, 200) << "all else is answered";
  streams.clear();
  EXPECT_TRUE(goesOn());
}

}  // namespace
}  // namespace palpa::console_attack
