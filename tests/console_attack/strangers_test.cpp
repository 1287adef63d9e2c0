// Requests that no page of this console makes.
#include "attacked.h"

#include <set>

namespace palpa::console_attack {
namespace {

Headers changed(Headers headers, const std::string& name, const std::string& value) {
  std::erase_if(headers, [&](const auto& one) { return one.first == name; });
  if (value != "-") headers.emplace_back(name, value);
  return headers;
}

void expectSafe(const Answer& answer) {
  EXPECT_EQ(answer.header("X-Content-Type-Options"), "nosniff") << answer.head;
  EXPECT_NE(answer.header("Content-Security-Policy").find("default-src 'none'"), std::string::npos);
  EXPECT_EQ(answer.header("Cache-Control"), "no-store");
  EXPECT_EQ(answer.header("Access-Control-Allow-Origin"), "");
  EXPECT_EQ(answer.header("Server"), "");
}

class Strangers : public Attacked {};

TEST_F(Strangers, WhoIsNotItsPageIsRefusedNotedAndChangesNothing) {
  session();
  struct Try {
    const char *header, *value;
    int read, write;  // 200: may pass
    const char* noted;
  };
  const Try tries[] = {
      {"Host", "evil.example", 421, 421, "421 this console is not called"},
      {"Host", "-", 421, 421, "421 this console is not called"},
      {"Host", "127.0.0.1:1", 421, 421, "421 this console is not called"},
      {"Origin", "http://evil.example", 403, 403, "403 requested by another site"},
      {"Origin", "null", 403, 403, "403 requested by another site"},
      {"Sec-Fetch-Site", "cross-site", 403, 403, "403 requested by another site"},
      {"Sec-Fetch-Site", "same-site", 403, 403, "403 requested by another site"},
      {"X-Palpa-Page", "-", 200, 403, "403 not requested by a page"},
      {"X-Palpa-Page", "00000000000000000000000000000000", 200, 403, "403 not requested by a page"},
      {"X-Palpa-Write", "-", 200, 400, "400 a write needs a number"},
      {"X-Palpa-Write", "1", 200, 400, "400 a write needs a number"},
      {"Content-Type", "text/plain", 200, 415, "415 a write must be JSON"},
      {"Content-Type", "application/x-www-form-urlencoded", 200, 415, "415 a write must be JSON"}};
  const std::string stop = "{\"command\":\"stop\"}",
                    path = "/api/sessions/" + session() + "/command";
  for (const Try& one : tries) {
    const Answer read = console().raw(
        requestOf("GET", "/api/sessions", changed(console().readHeaders(), one.header, one.value)));
    const Answer write = console().raw(requestOf(
        "POST", path, changed(console().writeHeaders(stop), one.header, one.value), stop));
    EXPECT_EQ(read.status, one.read) << one.header << ' ' << one.value;
    EXPECT_EQ(write.status, one.write) << one.header << ' ' << one.value;
    EXPECT_TRUE(isNoted(one.noted));
    for (const Answer& answer : {read, write}) expectSafe(answer);
    EXPECT_EQ(write.header("Content-Type"), "application/json");
    EXPECT_TRUE(write.json().contains("error"));
  }
  EXPECT_TRUE(goesOn()) << "an emergency stop came through";
}

TEST_F(Strangers, AWriteThatIsSentAgainIsRefused) {
  const std::string body = "{\"command\":\"note\",\"reason\":\"once\"}";
  const std::string request = requestOf("POST", "/api/sessions/" + session() + "/command",
                                        console().writeHeaders(body), body);
  EXPECT_EQ(console().raw(request).status, 202);
  for (int i = 0; i < 3; ++i) EXPECT_EQ(console().raw(request).status, 409);
  EXPECT_TRUE(isNoted("409 this was requested before"));
  const std::string other = "{\"command\":\"note\",\"reason\":\"last\"}";
  EXPECT_EQ(console()
                .post("/api/sessions/" + session() + "/command",
                      {{"command", "note"}, {"reason", "last"}})
                .status,
            202);
  int once = 0;
  console().events(session(), "", [&](const auto& all) {
    once = 0;
    bool last = false;
    for (const Event& event : all) {
      once += event.data.value("text", "") == "once";
      last |= event.data.value("text", "") == "last";
    }
    return last;
  });
  EXPECT_EQ(once, 1);
}

TEST_F(Strangers, OtherMethodsAreNotUnderstood) {
  for (const char* method : {"HEAD", "PUT", "DELETE", "OPTIONS", "PATCH", "TRACE", "CONNECT"}) {
    const Answer answer =
        console().raw(requestOf(method, "/api/sessions", console().readHeaders()));
    EXPECT_TRUE(answer.status == 405 || answer.status == 400) << method << ' ' << answer.status;
    expectSafe(answer);
  }
  EXPECT_TRUE(isNoted("OPTIONS /api/sessions 405"));
}

/// What is no HTTP, or bends it, gets one answer and the end of its connection.
TEST_F(Strangers, NoRequestHidesInAnother) {
  const std::string hidden = requestOf("GET", "/api/me", console().readHeaders());
  Headers alive = changed(console().readHeaders(), "Connection", "-");
  const auto with = [&](const Headers& more) {
    Headers all = alive;
    all.insert(all.end(), more.begin(), more.end());
    return all;
  };
  const std::string length = std::to_string(hidden.size());
  const std::string tries[] = {
      requestOf("GET", "/api/me", with({{"Content-Length", length}}), hidden),
      requestOf("POST", "/api/trainees",
                changed(with({{"Content-Length", length}}), "Host", "evil.example"), hidden),
      requestOf("POST", "/api/trainees",
                with({{"Content-Length", length}, {"Content-Type", "text/plain"}}), hidden),
      requestOf("POST", "/api/trainees",
                with({{"Content-Length", "0"}, {"Content-Length", length}}), hidden),
      requestOf("POST", "/api/trainees",
                with({{"Content-Length", length}, {"Transfer-Encoding", "chunked"}}),
                "0\r\n\r\n" + hidden),
      requestOf("POST", "/api/trainees", with({{"Transfer-Encoding", "chunked"}}),
                "0\r\n\r\n" + hidden),
      requestOf("POST", "/api/trainees",
                with({{"Transfer-Encoding", "\r\n chunked"}, {"Content-Length", length}}), hidden),
      requestOf("POST", "/api/trainees",
                with({{"Transfer-Encoding ", "chunked"}, {"Content-Length", length}}), hidden),
      requestOf("POST", "/api/trainees",
                with({{"Content-Length ", "0"}, {"Content-Length", length}}), hidden),
      requestOf("GET", "/api/me", with({{"X-A", "b\nContent-Length: " + length}}), hidden),
      requestOf("GET", "/api/me", with({{"X-A", "b\r\n c"}}), hidden),
      requestOf("OPTIONS", "/api/trainees", with({{"Content-Length", length}}), hidden),
      "garbage\r\n\r\n" + hidden,
      "GET  /api/me HTTP/1.1\r\n\r\n" + hidden,
      "GET /api/me HTTP/9.9\r\n\r\n" + hidden,
      std::string("\0\xff\x16\x03\x01\x02", 6) + "\r\n\r\n" + hidden,
      "PRI * HTTP/2.0\r\n\r\nSM\r\n\r\n" + hidden};
  for (const std::string& bytes : tries) {
    Wire wire(console().port());
    wire.send(bytes);
    const std::string all = wire.read(std::chrono::seconds(60));
    EXPECT_TRUE(wire.closed()) << bytes.substr(0, 200);
    int answers = 0;
    for (std::size_t at = 0; (at = all.find("HTTP/1.1 ", at)) != std::string::npos; ++at) ++answers;
    EXPECT_EQ(answers, 1) << bytes.substr(0, 200) << '\n' << all;
    EXPECT_EQ(all.find("page_key"), std::string::npos) << bytes.substr(0, 200);
    expectSafe(answerIn(all));
  }
  EXPECT_TRUE(isNoted("400 a header is folded over two lines"));
  EXPECT_TRUE(isNoted("400 a header has a blank before its colon"));
  EXPECT_TRUE(goesOn());
}

/// Over one connection, one after the other, or all sent at once.
TEST_F(Strangers, OneConnectionMayAskOften) {
  const std::string ask =
      requestOf("GET", "/api/me", changed(console().readHeaders(), "Connection", "-"));
  Wire wire(console().port());
  wire.send(ask + ask + ask);
  std::string all;
  const auto answers = [&all] {
    int count = 0;
    for (std::size_t at = 0; (at = all.find("HTTP/1.1 200", at)) != std::string::npos; ++at)
      ++count;
    return count;
  };
  for (int wanted = 3; wanted <= 6; ++wanted) {
    EXPECT_TRUE(inTime([&] {
      all += wire.readSome(std::chrono::milliseconds(200));
      return answers() >= wanted || wire.closed();
    }));
    EXPECT_EQ(answers(), wanted);
    if (wanted < 6) wire.send(ask);
  }
}

}  // namespace
}  // namespace palpa::console_attack
