#include "apps/console/web/http_framing.h"

#include <gtest/gtest.h>

namespace palpa::console {
namespace {

using Headers = httplib::Headers;

int statusOf(const std::string& method, const Headers& headers) {
  httplib::Request request;
  request.method = method;
  request.headers = headers;
  return judgeFraming(request).status;
}

TEST(Framing, AsThePagesFrameTheirs) {
  EXPECT_EQ(statusOf("GET", {}), 200);
  EXPECT_EQ(statusOf("GET", {{"Content-Length", "0"}}), 200);
  EXPECT_EQ(statusOf("POST", {{"Content-Length", "0"}}), 200);
  EXPECT_EQ(statusOf("POST", {{"Content-Length", "65536"}}), 200);
}

TEST(Framing, ALengthThatCanBeReadInTwoWaysIsNone) {
  EXPECT_EQ(statusOf("POST", {}), 411);
  EXPECT_EQ(statusOf("POST", {{"Transfer-Encoding", "chunked"}}), 411);
  EXPECT_EQ(statusOf("POST", {{"Transfer-Encoding", "identity"}, {"Content-Length", "2"}}), 411);
  EXPECT_EQ(statusOf("GET", {{"transfer-encoding", "chunked"}}), 411);
  EXPECT_EQ(statusOf("POST", {{"Content-Length", "2"}, {"content-length", "2"}}), 400);
  for (const char* length : {"", " ", "-1", "+1", "0x10", "1e3", "1 ", "2,2", "2;", "٢"})
    EXPECT_EQ(statusOf("POST", {{"Content-Length", length}}), 400) << length;
  for (const char* length : {"65537", "1073741824", "9999999999999999999",
                             "99999999999999999999999999999999999", "18446744073709551617"})
    EXPECT_EQ(statusOf("POST", {{"Content-Length", length}}), 413) << length;
}

TEST(Framing, NoBodyWhereNoneBelongs) {
  for (const char* method : {"GET", "HEAD", "OPTIONS", "DELETE"})
    EXPECT_EQ(statusOf(method, {{"Content-Length", "1"}}), 400) << method;
}

TEST(Framing, NothingPackedNothingInPartsNothingTwice) {
  for (const char* packed : {"gzip", "br", "deflate", "identity", ""})
    EXPECT_EQ(statusOf("POST", {{"Content-Length", "2"}, {"Content-Encoding", packed}}), 415)
        << packed;
  for (const char* range : {"bytes=0-", "bytes=0-1,0-1", "x"})
    EXPECT_EQ(statusOf("GET", {{"Range", range}}), 416) << range;
  for (const char* once : {"Host", "Origin", "X-Palpa-Page", "X-Palpa-Write", "Content-Type"})
    EXPECT_EQ(statusOf("GET", {{once, "a"}, {once, "b"}}), 400) << once;
}

constexpr char kFirst[] = "POST /api/trainees HTTP/1.1\r\nHost: 127.0.0.1:1\r\n";

int statusOfHead(const std::string& more) { return judgeHead(kFirst + more + "\r\n").status; }

TEST(Head, AsBrowsersWriteIt) {
  EXPECT_EQ(statusOfHead(""), 200);
  for (const char* line :
       {"Content-Length: 2", "X-A:b", "X-A:", "X-A: \t b \t", "sec-ch-ua: \"a\";v=\"1\"",
        "Cookie: palpa=0123; a=b:c", "X-A: \xc3\xa9", "X_a.b!: c"})
    EXPECT_EQ(statusOfHead(std::string(line) + "\r\n"), 200) << line;
}

/// What one program reads as a header and another does not: no request may hide behind it.
TEST(Head, WhatCanBeReadInTwoWaysIsRefused) {
  for (const char* line : {"Transfer-Encoding:\r\n chunked",
                           "Transfer-Encoding:\r\n\tchunked",
                           " X-A: b",
                           "\tX-A: b",
                           "X-A: b\r\n c",
                           "Transfer-Encoding : chunked",
                           "Content-Length\t: 2",
                           "Content-Length 2",
                           ": 2",
                           " : 2",
                           "nothing",
                           "X A: b",
                           "X-A\": b",
                           "X(A): b",
                           "X-A: b\rTransfer-Encoding: chunked",
                           "X-A: b\nTransfer-Encoding: chunked",
                           "X-A: b\r\r\n",
                           "X-A: \x01",
                           "X-A: \x7f",
                           "X-\xc3\xa9: a"})
    EXPECT_EQ(statusOfHead(std::string(line) + "\r\n"), 400) << line;
  EXPECT_EQ(statusOfHead(std::string("X-A: a\0b\r\n", 10)), 400);
  EXPECT_EQ(judgeHead("GET /\n HTTP/1.1\r\n\r\n").status, 400);
}

/// What the guard judges is the same of a head as it came and of the request that is read from it.
TEST(Head, WhatTheGuardJudges) {
  const GuardedRequest asked = askedIn(
      "POST /api/sessions/a1/stop HTTP/1.1\r\nHost: here:1\r\nOrigin:http://here:1\r\n"
      "SEC-FETCH-SITE: same-origin\r\ncontent-type: \tapplication/json\r\n"
      "Cookie: palpa=0123; a=b:c\r\nX-Palpa-Page: first\r\nX-Palpa-Page: second\r\n"
      "X-Palpa-Write: 7\r\n\r\nHost: body",
      "127.0.0.9");
  EXPECT_EQ(asked.remote, "127.0.0.9");
  EXPECT_EQ(asked.method, "POST");
  EXPECT_EQ(asked.path, "/api/sessions/a1/stop");
  EXPECT_EQ(asked.host, "here:1");
  EXPECT_EQ(asked.origin, "http://here:1");
  EXPECT_EQ(asked.fetch_site, "same-origin");
  EXPECT_EQ(asked.content_type, "application/json");
  EXPECT_EQ(asked.cookie, "palpa=0123; a=b:c");
  EXPECT_EQ(asked.page_key, "first");
  EXPECT_EQ(asked.write_id, "7");
  for (const char* head : {"", " ", "GET", "GET ", "GET /", "\r\n", "\r\n\r\n", "GET  \r\n:\r\n"})
    EXPECT_EQ(askedIn(head, "").host, "") << head;
}

TEST(Head, ItsEndAndTheLengthItStates) {
  EXPECT_EQ(endOfHead(""), std::string::npos);
  EXPECT_EQ(endOfHead("GET / HTTP/1.1\r\n\r"), std::string::npos);
  EXPECT_EQ(endOfHead("a\r\n\r\nb"), 5u);
  EXPECT_EQ(bodyLengthIn(kFirst), 0u);
  for (const char* line : {"Content-Length: 2", "content-length:2", "CONTENT-LENGTH: \t2"})
    EXPECT_EQ(bodyLengthIn(std::string(kFirst) + line + "\r\n\r\n"), 2u) << line;
  for (const char* line : {"Content-Length: 2\r\nContent-Length: 2", "Content-Length: x",
                           "Content-Length:", "Content-Length: -2", "Content-Length: 2 "})
    EXPECT_FALSE(bodyLengthIn(std::string(kFirst) + line + "\r\n\r\n")) << line;
}

}  // namespace
}  // namespace palpa::console
