#include "apps/console/http_framing.h"

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

}  // namespace
}  // namespace palpa::console
