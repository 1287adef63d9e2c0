#include "apps/link/lrs_client.h"

#include <gtest/gtest.h>

#include <fstream>

#include "anatomy/base/error.h"
#include "tests/support/files.h"

namespace palpa::link {
namespace {

std::string complaintAbout(const std::string& url) {
  try {
    endpointOf(url, false);
  } catch (const UsageError& e) {
    return e.what();
  }
  return "";
}

TEST(Endpoint, IsTakenApart) {
  const Endpoint e = endpointOf("https://lrs.example:8443/xapi/", false);
  EXPECT_EQ(e.origin, "https://lrs.example:8443");
  EXPECT_EQ(e.host, "lrs.example");
  EXPECT_EQ(e.path, "/xapi");
  EXPECT_EQ(endpointOf("https://lrs.example/a/statements", false).path, "/a");
  EXPECT_EQ(endpointOf("https://lrs.example", false).path, "");
  EXPECT_EQ(endpointOf("http://[::1]:80/x", false).host, "::1");
}

TEST(Endpoint, RefusesWhatWouldLeak) {
  const std::string secret = complaintAbout("https://me:geheim@lrs.example/xapi");
  EXPECT_NE(secret.find("PALPA_XAPI_PASSWORD"), std::string::npos) << secret;
  EXPECT_EQ(secret.find("geheim"), std::string::npos);
  EXPECT_NE(complaintAbout("http://lrs.example/xapi").find("--insecure"), std::string::npos);
  EXPECT_NO_THROW(endpointOf("http://lrs.example/xapi", true));
  for (const char* here :
       {"http://127.0.0.1:8080/xapi", "http://localhost/xapi", "http://[::1]/xapi"})
    EXPECT_EQ(complaintAbout(here), "") << here;
  for (const char* none : {"", "lrs.example", "ftp://lrs.example", "https://", "https:///xapi",
                           "https://a:port/x", "https://a/x?y=1", "https://a/x y"})
    EXPECT_NE(complaintAbout(none), "") << none;
}

class Logins : public testing::Test {
 protected:
  void SetUp() override {
    file_ =
        test::freshFolder("link", testing::UnitTest::GetInstance()->current_test_info()->name()) /
        "netrc";
    std::ofstream(file_)
        << "machine other.example login a password one\nmachine lrs.example\n  login b\n  password "
           "two\nmachine lrs.example login c password three\ndefault login d password four\n";
    std::filesystem::permissions(file_, std::filesystem::perms::owner_read);
    ::setenv("NETRC", file_.c_str(), 1);
    ::unsetenv("PALPA_XAPI_PASSWORD");
  }
  void TearDown() override { ::unsetenv("NETRC"), ::unsetenv("PALPA_XAPI_PASSWORD"); }
  std::filesystem::path file_;
};

TEST_F(Logins, ComeFromTheFile) {
  EXPECT_EQ(loginFor("lrs.example", "").user, "b");
  EXPECT_EQ(loginFor("lrs.example", "c").password, "three");
  EXPECT_EQ(loginFor("elsewhere.example", "").password, "four");
  EXPECT_THROW(loginFor("lrs.example", "nobody"), UsageError);
}

TEST_F(Logins, TheEnvironmentGoesFirst) {
  ::setenv("PALPA_XAPI_PASSWORD", "five", 1);
  EXPECT_EQ(loginFor("lrs.example", "c").password, "five");
  EXPECT_EQ(loginFor("lrs.example", "").password, "two");  // without a user it is nobody's
}

TEST_F(Logins, AFileThatOthersReadIsRefused) {
  std::filesystem::permissions(file_, std::filesystem::perms::group_read,
                               std::filesystem::perm_options::add);
  EXPECT_THROW(loginFor("lrs.example", ""), UsageError);
}

}  // namespace
}  // namespace palpa::link
