#include "apps/os/tls/tls_line.h"

#include <gtest/gtest.h>
#include <openssl/err.h>
#include <openssl/pem.h>
#include <openssl/ssl.h>
#include <sys/socket.h>

#include <algorithm>
#include <array>
#include <numeric>
#include <string>
#include <thread>

#include "anatomy/base/error.h"
#include "apps/os/tls/openssl.h"
#include "tests/tls/room.h"

namespace palpa::os {
namespace {

using std::chrono::days;
const TlsServer& server() {
  static const TlsServer made(
      makeIdentity({.name = "Palpa console", .reached_by = {"localhost"}}, authority(), kNow));
  return made;
}

/// Two ends of a connection; the server's never waits.
struct Ends {
  Ends() {
    EXPECT_EQ(::socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, both), 0);
    neverWait(both[0]);
    line = server().lineOver(both[0]);
  }
  ~Ends() {
    line.reset();
    leave();
    closeSocket(both[0]);
  }
  void leave() {
    if (both[1] >= 0) closeSocket(both[1]);
    both[1] = -1;
  }
  /// What comes until the other side is gone, or `enough`.
  std::string hear(std::size_t enough = std::string::npos) {
    std::string all;
    char bytes[1000];
    while (all.size() < enough) {
      const auto got = line->receiveSome(bytes, std::min(sizeof bytes, enough - all.size()));
      if (!got) return all;
      all.append(bytes, *got);
      if (*got == 0 && !line->holdsMore() && !ready(both[0], Wait::to_read, 5000)) return all;
    }
    return all;
  }
  void say(const std::string& text) {
    for (std::size_t at = 0; at < text.size();) {
      const auto sent = line->sendSome(text.data() + at, text.size() - at);
      ASSERT_TRUE(sent);
      at += *sent;
      ASSERT_TRUE(*sent > 0 || ready(both[0], Wait::to_write, 5000));
    }
  }
  int both[2] = {-1, -1};
  std::unique_ptr<Line> line;
};

/// A browser, as OpenSSL plays it: believes one authority, and waits where it has to.
class Visitor {
 public:
  Visitor(int socket, const std::string& believes)
      : context_(SSL_CTX_new(TLS_client_method())), ssl_(SSL_new(context_.get())) {
    X509_STORE* const store = SSL_CTX_get_cert_store(context_.get());
    X509_STORE_add_cert(store, openssl::certificateIn(believes).get());
    X509_VERIFY_PARAM_set_time(SSL_get0_param(ssl_.get()), kNow.time_since_epoch().count());
    SSL_set_verify(ssl_.get(), SSL_VERIFY_PEER, nullptr);
    SSL_set1_host(ssl_.get(), "localhost");
    SSL_set_fd(ssl_.get(), socket);
  }
  bool enters() { return SSL_connect(ssl_.get()) == 1; }
  void say(const std::string& text) {
    EXPECT_EQ(SSL_write(ssl_.get(), text.data(), static_cast<int>(text.size())),
              static_cast<int>(text.size()));
  }
  std::string hear(std::size_t enough) {
    std::string all(enough, '\0');
    std::size_t at = 0;
    for (int got = 1; at < enough && got > 0; at += static_cast<std::size_t>(std::max(got, 0)))
      got = SSL_read(ssl_.get(), all.data() + at, static_cast<int>(enough - at));
    all.resize(at);
    return all;
  }
  void renewsKeys() {
    EXPECT_EQ(SSL_key_update(ssl_.get(), SSL_KEY_UPDATE_NOT_REQUESTED), 1);
    EXPECT_EQ(SSL_do_handshake(ssl_.get()), 1);
  }
  void leave() { SSL_shutdown(ssl_.get()); }

 private:
  std::unique_ptr<SSL_CTX, openssl::Freed<SSL_CTX_free>> context_;
  std::unique_ptr<SSL, openssl::Freed<SSL_free>> ssl_;
};

std::string longText() {
  std::string text(1'000'000, '\0');
  std::iota(text.begin(), text.end(), '\0');
  return text;
}

TEST(TlsLine, CarriesWhatIsSaidBothWays) {
  Ends ends;
  const std::string text = longText();
  std::thread browser([&] {
    Visitor visitor(ends.both[1], authority().certificate);
    ASSERT_TRUE(visitor.enters());
    visitor.say(text);
    EXPECT_EQ(visitor.hear(text.size()), text);
    visitor.leave();
  });
  EXPECT_EQ(ends.hear(text.size()), text);
  ends.say(text);
  EXPECT_EQ(ends.hear(), "");
  browser.join();
}

/// Whoever listens in between the server and a visitor.
struct Tap {
  explicit Tap(int server_side) : server(server_side) {
    EXPECT_EQ(::socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, visitor), 0);
    listens = std::thread([this] {
      while (hand(server, visitor[0]) && hand(visitor[0], server))
        waitForAny(std::array<WatchedSocket, 2>{WatchedSocket{server}, {visitor[0]}}, 1000);
    });
  }
  ~Tap() {
    for (const int end : visitor) closeSocket(end);
  }
  bool hand(int from, int to) {
    char bytes[4096];
    const auto got = receiveSome(from, bytes, sizeof bytes);
    if (!got) return false;
    seen.append(bytes, *got);
    return *got == 0 || ::send(to, bytes, *got, MSG_NOSIGNAL) == static_cast<ssize_t>(*got);
  }
  const int server;
  int visitor[2] = {-1, -1};
  std::string seen;
  std::thread listens;
};

TEST(TlsLine, WhoListensInUnderstandsNothing) {
  Ends ends;
  Tap tap(ends.both[1]);
  const std::string question = "what the educator asks", secret = "what the console answers";
  std::thread browser([&] {
    Visitor visitor(tap.visitor[1], authority().certificate);
    ASSERT_TRUE(visitor.enters());
    visitor.say(question);
    EXPECT_EQ(visitor.hear(secret.size()), secret);
    endBoth(tap.visitor[1]);
  });
  EXPECT_EQ(ends.hear(question.size()), question);
  ends.say(secret);
  browser.join();
  tap.listens.join();
  EXPECT_GT(tap.seen.size(), 500u);
  EXPECT_EQ(tap.seen.find(question), std::string::npos);
  EXPECT_EQ(tap.seen.find(secret), std::string::npos);
}

TEST(TlsLine, WhoBelievesAnotherAuthorityGoes) {
  Ends ends;
  const Identity stranger = makeAuthority("Authority of a room", {}, days{3650}, kNow);
  std::thread browser([&] {
    Visitor visitor(ends.both[1], stranger.certificate);
    EXPECT_FALSE(visitor.enters());
  });
  EXPECT_EQ(ends.hear(), "");
  browser.join();
  EXPECT_FALSE(ends.line->receiveSome(nullptr, 0).value_or(0) > 0);
}

TEST(TlsLine, WhoSpeaksPlainHttpIsToldSo) {
  Ends ends;
  const std::string said = "GET / HTTP/1.1\r\nHost: localhost\r\n\r\n";
  ASSERT_EQ(sendSome(ends.both[1], said.data(), said.size()), said.size());
  char bytes[100];
  EXPECT_FALSE(ends.line->receiveSome(bytes, sizeof bytes)) << "it is over";
  std::string heard(1000, '\0');
  heard.resize(receiveSome(ends.both[1], heard.data(), heard.size()).value_or(0));
  const std::size_t head = heard.find("\r\n\r\n") + 4;
  EXPECT_EQ(heard.substr(head), "This address is encrypted: begin it with https://\n");
  EXPECT_NE(heard.find("Content-Length: " + std::to_string(heard.size() - head) + "\r\n"),
            std::string::npos);
}

/// Who does so without end is not listened to without end.
TEST(TlsLine, PlainHttpWithoutEndHoldsNobodyUp) {
  Ends ends;
  const std::string said = "GET / HTTP/1.1\r\n" + longText();
  std::thread talks([&] {
    while (::send(ends.both[1], said.data(), said.size(), MSG_NOSIGNAL) > 0) continue;
  });
  char bytes[100];
  ready(ends.both[0], Wait::to_read, 5000);
  EXPECT_FALSE(ends.line->receiveSome(bytes, sizeof bytes));
  endBoth(ends.both[0]);
  talks.join();
}

/// New keys are made one at a time: between two of them others have their turn.
TEST(TlsLine, NewKeysWithoutEndHoldNobodyUp) {
  Ends ends;
  std::thread browser([&] {
    Visitor visitor(ends.both[1], authority().certificate);
    ASSERT_TRUE(visitor.enters());
    visitor.say("x");
    for (int i = 0; i < 5; ++i) visitor.renewsKeys();
  });
  EXPECT_EQ(ends.hear(1), "x");
  browser.join();
  char byte = 0;
  for (int i = 0; i < 4; ++i) {
    EXPECT_EQ(ends.line->receiveSome(&byte, 1), 0u);
    EXPECT_TRUE(ready(ends.both[0], Wait::to_read, 0)) << i;
  }
  EXPECT_FALSE(ends.line->greets()) << "they understand each other all the while";
  EXPECT_EQ(ends.line->sendSome("y", 1), 1u);
}

TEST(TlsLine, GarbageSilenceAndHalfAGreetingHoldNobodyUp) {
  for (const std::string& said : {std::string(500, '\xff'), std::string("\x16\x03\x01\x02")}) {
    Ends ends;
    char bytes[100];
    EXPECT_EQ(ends.line->receiveSome(bytes, sizeof bytes), 0u) << "silence is waited for";
    EXPECT_EQ(ends.line->sendSome("a", 1), 0u) << "nobody is there yet";
    EXPECT_FALSE(ends.line->greets());
    sendSome(ends.both[1], said.data(), said.size());
    const auto got = ends.line->receiveSome(bytes, sizeof bytes);
    EXPECT_EQ(got.has_value(), said.size() == 4) << "half a greeting may go on";
    EXPECT_EQ(ends.line->greets(), said.size() == 4);
    ends.leave();
    EXPECT_FALSE(ends.line->receiveSome(bytes, sizeof bytes));
    EXPECT_FALSE(ends.line->sendSome("a", 1).value_or(0) > 0);
  }
}

TEST(TlsLine, WritingToWhoLeftEndsNoProgram) {
  Ends ends;
  std::thread browser([&] {
    Visitor visitor(ends.both[1], authority().certificate);
    ASSERT_TRUE(visitor.enters());
    visitor.say("x");
  });
  EXPECT_EQ(ends.hear(1), "x");
  browser.join();
  ends.leave();
  const std::string text = longText();
  bool gone = false;
  for (int i = 0; i < 100 && !gone; ++i) gone = !ends.line->sendSome(text.data(), text.size());
  EXPECT_TRUE(gone);
}

TEST(TlsServer, TakesAnotherCertificateForThoseWhoComeLater) {
  const Identity stranger = makeAuthority("Another authority", {}, days{3650}, kNow);
  TlsServer renewed(makeIdentity({.name = "a", .reached_by = {"localhost"}}, stranger, kNow));
  for (const bool known : {false, true}) {
    Ends ends;
    ends.line = renewed.lineOver(ends.both[0]);
    renewed.use(makeIdentity({.name = "b", .reached_by = {"localhost"}}, authority(), kNow));
    std::thread browser([&] {
      Visitor visitor(ends.both[1], authority().certificate);
      EXPECT_EQ(visitor.enters(), known);
      endBoth(ends.both[1]);
    });
    ends.hear();
    browser.join();
  }
}

TEST(TlsServer, NeedsACertificateAndItsKey) {
  const Identity made = makeIdentity({.name = "a", .reached_by = {"localhost"}}, authority(), kNow);
  EXPECT_THROW(TlsServer({made.certificate, authority().key}), UsageError);
  EXPECT_THROW(TlsServer({"", ""}), UsageError);
  EXPECT_NO_THROW(TlsServer({made.certificate + authority().certificate, made.key}));
  const std::string damaged = "-----BEGIN CERTIFICATE-----\nAAAA\n-----END CERTIFICATE-----\n";
  EXPECT_THROW(TlsServer({made.certificate + damaged, made.key}), UsageError);
}

}  // namespace
}  // namespace palpa::os
