// What answers is no learning record store, or not the one that it says it is.
#include <arpa/inet.h>
#include <gtest/gtest.h>
#include <sys/socket.h>
#include <unistd.h>

#include <atomic>
#include <string>
#include <thread>

#include "apps/link/lrs_client.h"
#include "apps/link/outbox.h"
#include "apps/runtime/clock.h"
#include "tests/support/scratch_folder.h"

namespace palpa::link {
namespace {

struct Endless {
  std::string bytes;
  std::chrono::milliseconds pause{0};
};

/// Answers every connection with the same bytes, then with others again and again, until nobody is
/// there.
class Babbler {
 public:
  explicit Babbler(std::string bytes, Endless endless = {})
      : bytes_(std::move(bytes)), endless_(std::move(endless)) {
    sockaddr_in address{};
    address.sin_family = AF_INET;
    address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    socklen_t size = sizeof address;
    if (::bind(socket_, reinterpret_cast<sockaddr*>(&address), size) != 0 ||
        ::getsockname(socket_, reinterpret_cast<sockaddr*>(&address), &size) != 0 ||
        ::listen(socket_, 8) != 0)
      throw std::runtime_error("no port");
    port_ = ntohs(address.sin_port);
    thread_ = std::thread([this] { run(); });
  }
  ~Babbler() {
    ::shutdown(socket_, SHUT_RDWR);
    thread_.join();
    ::close(socket_);
  }
  Babbler(const Babbler&) = delete;
  Babbler& operator=(const Babbler&) = delete;
  std::size_t sent() const { return sent_; }
  std::string url(const std::string& scheme) const {
    return scheme + "://127.0.0.1:" + std::to_string(port_);
  }

 private:
  void run() {
    for (int client; (client = ::accept(socket_, nullptr, nullptr)) >= 0; ::close(client)) {
      char request[4096];
      (void)!::read(client, request, sizeof request);
      say(client, bytes_);
      while (!endless_.bytes.empty() && say(client, endless_.bytes)) runtime::rest(endless_.pause);
    }
  }
  bool say(int client, const std::string& bytes) {
    const ssize_t count = ::send(client, bytes.data(), bytes.size(), MSG_NOSIGNAL);
    if (count > 0) sent_ += static_cast<std::size_t>(count);
    return count > 0;
  }
  const std::string bytes_;
  const Endless endless_;
  std::atomic<std::size_t> sent_{0};
  const int socket_ = ::socket(AF_INET, SOCK_STREAM, 0);
  int port_ = 0;
  std::thread thread_;
};

LrsAnswer answerTo(const std::string& url) {
  LrsClient client(endpointOf(url, false), {}, {1, 1});
  return client.put("0a1b2c3d-4e5f-4a6b-8c7d-000000000001", "{}");
}

TEST(NoHttp, GarbageIsNoAnswer) {
  for (const std::string& bytes :
       {std::string("\x00\xff\x13garbage\r\n\r\n", 14), std::string("HTTP/1.1 204"),
        std::string("HTTP/1.1 204 No Content\r\nX-Experience-API-Version: 1.0.3\r\n"),
        std::string()}) {
    const Babbler babbler(bytes);
    const LrsAnswer answer = answerTo(babbler.url("http"));
    EXPECT_EQ(answer.status, 0) << bytes;
    EXPECT_FALSE(answer.trouble.empty());
  }
  const Babbler endless("HTTP/1.1 200 OK\r\n" + std::string(3 << 20, 'x'));
  EXPECT_EQ(answerTo(endless.url("http")).status, 0);
}

TEST(NoHttp, APlainAnswerWhereAProtectedOneWasAskedFor) {
  const Babbler babbler("HTTP/1.1 204 No Content\r\nX-Experience-API-Version: 1.0.3\r\n\r\n");
  const LrsAnswer protected_answer = answerTo(babbler.url("https"));
  EXPECT_EQ(protected_answer.status, 0);
  EXPECT_EQ(protected_answer.trouble, "no protected connection could be agreed on");
  EXPECT_EQ(answerTo(babbler.url("http")).status, 204);
}

using namespace std::chrono_literals;
constexpr char kOk[] = "HTTP/1.1 200 OK\r\nX-Experience-API-Version: 1.0.3\r\n";
constexpr char kTooLong[] = "the answer is too long (at most 1 MB)",
               kTooSlow[] = "the answer did not end within the time allowed";
constexpr std::size_t kNotMuch = 64u << 20;  // with what the system's buffers hold; endless is more

/// Without end, at every place where an answer may be so: it is given up, and little of it taken.
TEST(NoHttp, AnAnswerWithoutEndIsGivenUp) {
  const std::string piece(1 << 16, 'x'), lines = [] {
    std::string all;
    for (int i = 0; i < 4096; ++i) all += "X-A: aaaaaaaaa\r\n";
    return all;
  }();
  const std::pair<std::string, std::string> tries[] = {
      {std::string(kOk) + "Content-Length: 99999999999\r\n\r\n", piece},
      {std::string(kOk) + "Transfer-Encoding: chunked\r\n\r\n", "10000\r\n" + piece + "\r\n"},
      {std::string(kOk) + "\r\n", piece},  // until the connection ends
      {kOk, lines},
      {"HTTP/1.1 200 ", piece}};
  for (const auto& [head, more] : tries) {
    const Babbler babbler(head, {more});
    LrsClient client(endpointOf(babbler.url("http"), false), {}, {5, 30, 60});
    const LrsAnswer answer = client.get("0a1b2c3d-4e5f-4a6b-8c7d-000000000001");
    EXPECT_EQ(answer.status, 0) << head;
    EXPECT_EQ(answer.trouble, kTooLong) << head;
    EXPECT_EQ(answer.body, "");
    EXPECT_LT(babbler.sent(), kNotMuch) << head;
  }
}

/// A byte now and then, each in time: the whole is not.
TEST(NoHttp, AnAnswerThatDripsIsGivenUp) {
  for (const std::string& head :
       {std::string("HTTP/1.1 200 "), std::string(kOk),
        std::string(kOk) + "Content-Length: 1000000\r\n\r\n", std::string()}) {
    const Babbler babbler(head, {"x", 20ms});
    LrsClient client(endpointOf(babbler.url("http"), false), {}, {5, 5, 1});
    const LrsAnswer answer = client.put("0a1b2c3d-4e5f-4a6b-8c7d-000000000001", "{}");
    EXPECT_EQ(answer.status, 0) << head;
    EXPECT_EQ(answer.trouble, kTooSlow) << head;
  }
  const Babbler babbler("", {"\x16\x03\x03", 20ms});  // as if it would agree on a protection
  LrsClient client(endpointOf(babbler.url("https"), false), {}, {5, 5, 1});
  EXPECT_EQ(client.put("0a1b2c3d-4e5f-4a6b-8c7d-000000000001", "{}").status, 0);
}

/// Whoever ends the program does not wait for a server that hangs.
TEST(NoHttp, AnAnswerThatIsNotWaitedForAnyMoreIsGivenUp) {
  const Babbler babbler("", {"x", 20ms});
  const std::atomic<bool> given_up{true};
  LrsClient client(endpointOf(babbler.url("http"), false), {}, {3600, 3600, 3600, &given_up});
  EXPECT_EQ(client.put("0a1b2c3d-4e5f-4a6b-8c7d-000000000001", "{}").status, 0);
}

/// A megabyte is enough for a statement, and may come.
TEST(NoHttp, ALongAnswerIsTakenUpToItsBound) {
  for (const std::size_t size : {std::size_t{0}, std::size_t{1000}, LrsClient::kLongestAnswer,
                                 LrsClient::kLongestAnswer + 1}) {
    const Babbler babbler(std::string(kOk) + "Content-Length: " + std::to_string(size) +
                          "\r\n\r\n" + std::string(size, 'a'));
    LrsClient client(endpointOf(babbler.url("http"), false), {}, {5, 30, 60});
    const LrsAnswer answer = client.get("0a1b2c3d-4e5f-4a6b-8c7d-000000000001");
    const bool taken = size <= LrsClient::kLongestAnswer;
    EXPECT_EQ(answer.status, taken ? 200 : 0) << size;
    EXPECT_EQ(answer.body.size(), taken ? size : 0);
    EXPECT_EQ(answer.trouble, taken ? "" : kTooLong);
  }
}

/// What it says may reach a terminal, as one line that no terminal obeys.
TEST(NoHttp, ItsWordsAreShownWithoutWhatATerminalWouldObey) {
  const test::ScratchFolder folder("lrs_words");
  const std::string words = "\x1b]0;owned\x07\x1b[2J no room\xff\rsecond";
  const Babbler babbler(
      "HTTP/1.1 400 Bad\r\nX-Experience-API-Version: 1.0.3\r\nConnection: "
      "close\r\nContent-Length: " +
      std::to_string(words.size()) + "\r\n\r\n" + words);
  Outbox outbox(folder / "xapi.sqlite");
  const Endpoint endpoint = endpointOf(babbler.url("http"), false);
  outbox.put({endpoint.text(), "records"},
             {"0a1b2c3d-4e5f-4a6b-8c7d-000000000001", "", "session", 1, "", "{}"});
  LrsClient client(endpoint, {}, {5, 5});
  const Sent sent = sendWaiting(outbox, endpoint, client, {1, 0});
  ASSERT_EQ(sent.refused.size(), 1u);
  EXPECT_EQ(sent.refused[0], "session session, trial 1: it answers 400 (?]0;owned??[2J no room?)");
}

}  // namespace
}  // namespace palpa::link
