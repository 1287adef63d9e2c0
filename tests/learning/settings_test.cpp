#include "apps/learning/settings.h"

#include <gtest/gtest.h>

#include <fstream>

#include "anatomy/base/error.h"
#include "apps/learning/cmi5_package.h"
#include "apps/learning/lti_launch.h"
#include "tests/support/files.h"

namespace palpa::learning {
namespace {

Settings both() {
  return {
      .address = "https://bench1.local:8443/",
      .platforms = {{.name = "campus", .kind = PlatformKind::cmi5, .origin = "https://lms.example"},
                    {.name = "uni",
                     .kind = PlatformKind::lti,
                     .issuer = "https://uni.example",
                     .client_id = "tool-1",
                     .login = "https://uni.example/auth?a=1",
                     .token = "https://uni.example/token",
                     .keys = "https://uni.example/keys",
                     .deployments = {"1"}}}};
}

TEST(LearningSettings, AreOffUntilTheyAreWrittenAndComeBack) {
  const Folder folder(test::freshFolder("learning", "settings"));
  EXPECT_TRUE(readSettings(folder).isOff());
  writeSettings(folder, both());
  const Settings read = readSettings(folder);
  ASSERT_EQ(read.platforms.size(), 2u);
  EXPECT_EQ(read.named("uni")->deployments, std::vector<std::string>{"1"});
  EXPECT_EQ(read.ofOrigin("https://lms.example/xapi?x")->name, "campus");
  EXPECT_EQ(read.ofOrigin("https://lms.example:444/xapi"), nullptr);
  EXPECT_EQ(read.ofOrigin("https://uni.example/xapi"), nullptr) << "is LTI's";
  std::ofstream(folder.settings()) << "{";
  EXPECT_THROW(readSettings(folder), Error);
}

TEST(LearningSettings, TakeNoPlatformThatCannotBeOne) {
  const auto refuses = [](auto change) {
    Settings settings = both();
    change(settings);
    EXPECT_THROW(requireUsable(settings), UsageError);
  };
  refuses([](Settings& s) { s.address = "https://bench1.local:8443"; });
  refuses([](Settings& s) { s.address = "http://bench1.local/"; });
  refuses([](Settings& s) { s.performer = "robot"; });
  refuses([](Settings& s) { s.trials = 0; });
  refuses([](Settings& s) { s.platforms[0].name = "../campus"; });
  refuses([](Settings& s) { s.platforms[0].origin = "http://lms.example"; });
  refuses([](Settings& s) { s.platforms[0].origin = "https://u:p@lms.example"; });
  refuses([](Settings& s) { s.platforms[1].deployments.clear(); });
  refuses([](Settings& s) { s.platforms[1].keys = "ftp://uni.example"; });
  EXPECT_NO_THROW(requireUsable(both()));
}

TEST(LtiLogin, IsForOneUseInOneBrowserWithinTenMinutes) {
  const Settings settings = both();
  const LoginRequest request = readLogin({{"iss", "https://uni.example"},
                                          {"login_hint", "h&1"},
                                          {"target_link_uri", settings.address + "learning/lti/x"}},
                                         settings);
  Logins logins;
  const Logins::Time now{std::chrono::seconds(1'000'000)};
  const auto stateOf = [](const Logins::Begun& begun) {
    const std::size_t at = begun.address.find("state=") + 6;
    return begun.address.substr(at, 36);
  };
  const Logins::Begun first = logins.begin(request, settings, now);
  EXPECT_TRUE(first.address.starts_with("https://uni.example/auth?a=1&scope=openid&"));
  EXPECT_NE(first.address.find("login_hint=h%261"), std::string::npos);
  EXPECT_THROW(logins.take(stateOf(first), "another", now), UsageError);
  EXPECT_THROW(logins.take(stateOf(first), "", now), UsageError);
  EXPECT_EQ(logins.take(stateOf(first), first.browser, now).platform, "uni");
  EXPECT_THROW(logins.take(stateOf(first), first.browser, now), UsageError) << "a second time";
  const Logins::Begun late = logins.begin(request, settings, now);
  EXPECT_THROW(logins.take(stateOf(late), late.browser, now + std::chrono::minutes(11)),
               UsageError);
  const Logins::Begun forgotten = logins.begin(request, settings, now);
  for (std::size_t i = 0; i < Logins::kMost; ++i)
    logins.begin(request, settings, now + std::chrono::seconds(1));
  EXPECT_THROW(logins.take(stateOf(forgotten), forgotten.browser, now), UsageError)
      << "whoever begins many pushes out the oldest, and fills no memory";
}

TEST(CoursePackage, HoldsAUnitForEachTaskWithWordsThatAreEscaped) {
  const std::string xml =
      courseStructure({{"search", "Search & find", "a < b"}, {"pulse", "Pulse", "\"beats\""}},
                      "https://bench1.local:8443/");
  EXPECT_NE(xml.find("Search &amp; find"), std::string::npos);
  EXPECT_NE(xml.find("a &lt; b"), std::string::npos);
  EXPECT_NE(xml.find("<url>https://bench1.local:8443/learning/cmi5/search</url>"),
            std::string::npos);
  EXPECT_NE(xml.find("masteryScore=\"1.0\""), std::string::npos);
  const std::string zip = coursePackage(xml);
  EXPECT_TRUE(zip.starts_with("PK\x03\x04"));
  EXPECT_NE(zip.find(xml), std::string::npos) << "stored as it is";
  EXPECT_EQ(coursePackage(xml), zip) << "the same course is the same file";
}

}  // namespace
}  // namespace palpa::learning
