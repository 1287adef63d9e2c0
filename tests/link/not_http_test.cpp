// What answers is no learning record store, or not the one that it says it is.
#include <arpa/inet.h>
#include <gtest/gtest.h>
#include <sys/socket.h>
#include <unistd.h>

#include <string>
#include <thread>

#include "apps/link/lrs_client.h"

namespace palpa::link {
namespace {

/// Answers every connection with the same bytes.
class Babbler {
 public:
  explicit Babbler(std::string bytes) : bytes_(std::move(bytes)) {
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
  std::string url(const std::string& scheme) const {
    return scheme + "://127.0.0.1:" + std::to_string(port_);
  }

 private:
  void run() {
    for (int client; (client = ::accept(socket_, nullptr, nullptr)) >= 0; ::close(client)) {
      char request[4096];
      (void)!::read(client, request, sizeof request);
      (void)!::write(client, bytes_.data(), bytes_.size());
    }
  }
  const std::string bytes_;
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

}  // namespace
}  // namespace palpa::link
