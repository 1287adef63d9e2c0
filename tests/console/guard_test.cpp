#include "apps/console/web/guard.h"

#include <gtest/gtest.h>

#include <set>

namespace palpa::console {
namespace {

constexpr char kHere[] = "127.0.0.1:8123", kToken[] = "correct-horse-battery-staple";

std::string nextNumber() {
  static int count = 0;
  char text[33];
  std::snprintf(text, sizeof text, "%032x", ++count);
  return text;
}

struct Door {
  explicit Door(const std::string& token = "") : guard(token) {
    guard.answerTo({kHere, "localhost:8123", "[::1]:8123"});
  }
  GuardedRequest get(const std::string& path = "/api/sessions") const {
    return {.remote = "127.0.0.1",
            .method = "GET",
            .path = path,
            .host = kHere,
            .origin = {},
            .fetch_site = {},
            .content_type = {},
            .cookie = {},
            .page_key = {},
            .write_id = {}};
  }
  GuardedRequest post(const std::string& path = "/api/sessions") const {
    GuardedRequest asked = get(path);
    asked.method = "POST";
    asked.origin.assign("http://").append(kHere);
    asked.fetch_site = "same-origin";
    asked.content_type = "application/json";
    asked.page_key = guard.pageKey();
    asked.write_id = nextNumber();
    return asked;
  }
  Guard guard;
};

TEST(Guard, NobodyMayBeforeItKnowsItsNames) {
  Guard guard("");
  GuardedRequest asked = Door().get();
  EXPECT_EQ(guard.judge(asked).status, 421);
  asked.host.clear();
  EXPECT_EQ(guard.judge(asked).status, 421);
}

TEST(Guard, OnlyItsOwnNames) {
  Door door;
  for (const char* host : {kHere, "localhost:8123", "[::1]:8123"}) {
    GuardedRequest asked = door.get();
    asked.host = host;
    EXPECT_EQ(door.guard.judge(asked).status, 200) << host;
  }
  for (const std::string host :
       {"", "127.0.0.1", "localhost", "127.0.0.1:8124", "127.0.0.1:81230", "evil.example",
        "evil.example:8123", "localhost.evil.example:8123", "127.0.0.1.evil.example:8123",
        "evil@127.0.0.1:8123", "127.0.0.1:8123, evil", " 127.0.0.1:8123", "127.0.0.1:8123 ",
        "127.1:8123", "2130706433:8123", "0.0.0.0:8123", "::1:8123"}) {
    GuardedRequest asked = door.get("/");
    asked.host = host;
    EXPECT_EQ(door.guard.judge(asked).status, 421) << host;
  }
  GuardedRequest asked = door.get();
  asked.host = std::string(100'000, 'x');
  EXPECT_LT(door.guard.judge(asked).words.size(), 200u);
}

TEST(Guard, NoOtherOrigin) {
  Door door;
  for (const char* origin :
       {"null", "https://127.0.0.1:8123", "http://evil.example", "http://127.0.0.1",
        "http://127.0.0.1:8124", "http://127.0.0.1:8123/", "HTTP://127.0.0.1:8123",
        "http://127.0.0.1:8123.evil.example", "file://"}) {
    for (GuardedRequest asked : {door.get(), door.get("/"), door.post()}) {
      asked.origin = origin;
      EXPECT_EQ(door.guard.judge(asked).status, 403) << origin << ' ' << asked.method << asked.path;
    }
  }
  for (const char* host : {kHere, "localhost:8123", "[::1]:8123"}) {
    GuardedRequest asked = door.post();
    asked.origin = std::string("http://") + host;
    EXPECT_EQ(door.guard.judge(asked).status, 200) << host;
  }
}

/// A link from elsewhere may open the page; it may not ask anything, nor write.
TEST(Guard, WhatABrowserSaysOfTheAskingSite) {
  Door door;
  for (const char* site : {"cross-site", "same-site", "SAME-ORIGIN", "x"}) {
    for (GuardedRequest asked :
         {door.get(), door.get("/api/me"), door.post(), door.post("/api/enter")}) {
      asked.fetch_site = site;
      EXPECT_EQ(door.guard.judge(asked).status, 403) << site << ' ' << asked.method << asked.path;
    }
    GuardedRequest page = door.get("/");
    page.fetch_site = site;
    EXPECT_EQ(door.guard.judge(page).status, 200) << site;
  }
  GuardedRequest typed = door.get(), write = door.post();
  typed.fetch_site = write.fetch_site = "none";
  EXPECT_EQ(door.guard.judge(typed).status, 200);
  EXPECT_EQ(door.guard.judge(write).status, 403);
}

TEST(Guard, OnlyGetAndPost) {
  Door door;
  for (const char* method :
       {"", "HEAD", "PUT", "DELETE", "OPTIONS", "PATCH", "TRACE", "CONNECT", "PRI", "get"}) {
    GuardedRequest asked = door.get();
    asked.method = method;
    EXPECT_EQ(door.guard.judge(asked).status, 405) << method;
  }
}

TEST(Guard, AWriteNeedsThePagesKeyAndItsType) {
  Door door;
  GuardedRequest right = door.post();
  EXPECT_EQ(door.guard.judge(right).status, 200);
  for (const std::string& key : {std::string(), std::string("0"), Door().guard.pageKey(),
                                 door.guard.pageKey() + "0", door.guard.pageKey().substr(1)}) {
    GuardedRequest asked = door.post();
    asked.page_key = key;
    EXPECT_EQ(door.guard.judge(asked).status, 403) << key;
  }
  for (const char* type : {"", "text/plain", "application/x-www-form-urlencoded",
                           "multipart/form-data; boundary=application/json", " application/json",
                           "text/plain;application/json"}) {
    GuardedRequest asked = door.post();
    asked.content_type = type;
    EXPECT_EQ(door.guard.judge(asked).status, 415) << type;
  }
}

TEST(Guard, ANumberCountsOnce) {
  Door door;
  GuardedRequest asked = door.post();
  EXPECT_EQ(door.guard.judge(asked).status, 200);
  EXPECT_EQ(door.guard.judge(asked).status, 409);
  asked.path = "/api/trainees";
  asked.remote = "10.0.0.9";
  EXPECT_EQ(door.guard.judge(asked).status, 409) << "from elsewhere, for something else";
  for (const std::string& number :
       {std::string(), std::string("1"), std::string(31, 'a'), std::string(33, 'a'),
        std::string(32, 'A'), std::string(32, 'g'), std::string(32, '\0'),
        std::string(1 << 20, 'a')}) {
    GuardedRequest bad = door.post();
    bad.write_id = number;
    EXPECT_EQ(door.guard.judge(bad).status, 400) << number.substr(0, 40);
  }
}

/// A refused write uses no number up: the page may try again with the token given.
TEST(Guard, WhoIsRefusedEarlierUsesNoNumberUp) {
  Door door;
  GuardedRequest asked = door.post();
  asked.page_key = "";
  EXPECT_EQ(door.guard.judge(asked).status, 403);
  asked.page_key = door.guard.pageKey();
  EXPECT_EQ(door.guard.judge(asked).status, 200);
}

/// A learning platform sends browsers with a form of its own; what it holds is looked at behind.
TEST(Guard, AFormOfAnotherSiteOpensLaunchesAndNothingElse) {
  Door door(kToken);
  const auto form = [&](const std::string& path) {
    GuardedRequest asked = door.get(path);
    asked.method = "POST";
    asked.origin = "https://lms.example";
    asked.fetch_site = "cross-site";
    asked.content_type = "application/x-www-form-urlencoded";
    return asked;
  };
  EXPECT_EQ(door.guard.judge(form("/learning/lti/launch")).status, 200);
  for (const char* other : {"/api/sessions", "/api/enter", "/learning", "/learning/../api/sessions",
                            "/api/sessions/20260301-1/stop", "//learning/lti/launch"})
    EXPECT_NE(door.guard.judge(form(other)).status, 200) << other;
  GuardedRequest link = door.get("/learning/cmi5/pulse");
  link.fetch_site = "cross-site";
  EXPECT_EQ(door.guard.judge(link).status, 200);
  GuardedRequest script = form("/learning/lti/launch");
  script.content_type = "application/json";
  EXPECT_EQ(door.guard.judge(script).status, 415);
  GuardedRequest foreign = form("/learning/lti/launch");
  foreign.host = "elsewhere:8123";
  EXPECT_EQ(door.guard.judge(foreign).status, 421);
  GuardedRequest put = form("/learning/lti/launch");
  put.method = "PUT";
  EXPECT_EQ(door.guard.judge(put).status, 405);
  for (int i = 0; i < 100; ++i) door.guard.judge(form("/learning/lti/launch"));
  EXPECT_EQ(door.guard.judge(form("/learning/lti/launch")).status, 429);
  GuardedRequest stop = door.post("/api/sessions/20260301-1/stop");
  stop.cookie = "palpa=" + door.guard.enter("127.0.0.1", kToken);
  EXPECT_EQ(door.guard.judge(stop).status, 200) << "no flood of launches stands before a stop";
}

TEST(Guard, AFloodOfWritesIsStoppedWhereItComesFrom) {
  Door door;
  int passed = 0, stopped = 0;
  for (int i = 0; i < 300; ++i) {
    const int status = door.guard.judge(door.post()).status;
    passed += status == 200;
    stopped += status == 429;
  }
  EXPECT_EQ(passed + stopped, 300);
  EXPECT_GE(passed, 60);
  EXPECT_GT(stopped, 0);
  GuardedRequest other = door.post();
  other.remote = "10.0.0.9";
  EXPECT_EQ(door.guard.judge(other).status, 200);
  EXPECT_EQ(door.guard.judge(door.get()).status, 200) << "looking on goes on";
}

/// The emergency stop has no limit of writes before it, and all else that a write needs.
TEST(Guard, NoFloodStandsBeforeTheEmergencyStop) {
  Door door;
  const std::string stop = "/api/sessions/20260101-120000-0a1b2c3d/stop";
  for (int i = 0; i < 100; ++i) door.guard.judge(door.post());
  ASSERT_EQ(door.guard.judge(door.post()).status, 429);
  for (int i = 0; i < 200; ++i) EXPECT_EQ(door.guard.judge(door.post(stop)).status, 200);
  EXPECT_EQ(door.guard.judge(door.post("/api/sessions/x/command")).status, 429);
  EXPECT_EQ(door.guard.judge(door.post("/api/trainees/stop")).status, 429);
  GuardedRequest asked = door.post(stop);
  asked.origin = "http://evil.example";
  EXPECT_EQ(door.guard.judge(asked).status, 403);
  asked = door.post(stop);
  asked.page_key = "";
  EXPECT_EQ(door.guard.judge(asked).status, 403);
  asked = door.post(stop);
  asked.host = "evil.example";
  EXPECT_EQ(door.guard.judge(asked).status, 421);
  asked = door.post(stop);
  EXPECT_EQ(door.guard.judge(asked).status, 200);
  EXPECT_EQ(door.guard.judge(asked).status, 409) << "a number counts once";
  Door locked(kToken);
  EXPECT_EQ(locked.guard.judge(locked.post(stop)).status, 401);
}

/// Who may stop is known without a number being used up, however many writes there were.
TEST(Guard, WhoMayStopIsJudgedBeforeIt) {
  const std::string stop = "/api/sessions/20260101-120000-0a1b2c3d/stop";
  Door door;
  for (int i = 0; i < 100; ++i) door.guard.judge(door.post());
  GuardedRequest asked = door.post(stop);
  for (int i = 0; i < 3; ++i) EXPECT_TRUE(door.guard.mayStop(asked));
  EXPECT_EQ(door.guard.judge(asked).status, 200) << "its number is its own still";
  const auto may = [&](auto change) {
    GuardedRequest changed = door.post(stop);
    change(changed);
    return door.guard.mayStop(changed);
  };
  EXPECT_FALSE(may([](GuardedRequest& r) { r.method = "GET"; }));
  EXPECT_FALSE(may([](GuardedRequest& r) { r.host = "evil.example"; }));
  EXPECT_FALSE(may([](GuardedRequest& r) { r.origin = "http://evil.example"; }));
  EXPECT_FALSE(may([](GuardedRequest& r) { r.fetch_site = "cross-site"; }));
  EXPECT_FALSE(may([](GuardedRequest& r) { r.content_type = "text/plain"; }));
  EXPECT_FALSE(may([](GuardedRequest& r) { r.page_key = std::string(32, '0'); }));
  EXPECT_FALSE(may([](GuardedRequest& r) { r.write_id = "1"; }));
  for (const char* path :
       {"/api/sessions/x/command", "/api/sessions/stop", "/api/sessions//stop",
        "/api/sessions/x/y/stop", "/api/sessions/x/command?/stop", "/api/sessions/x/stop?a"})
    EXPECT_FALSE(may([&](GuardedRequest& r) { r.path = path; })) << path;
  Door locked(kToken);
  EXPECT_FALSE(locked.guard.mayStop(locked.post(stop)));
  asked = locked.post(stop);
  asked.cookie = "palpa=" + locked.guard.enter("127.0.0.1", kToken);
  EXPECT_TRUE(locked.guard.mayStop(asked));
}

/// 20,000 numbers are kept, whoever they came from: what is remembered does not grow for ever.
TEST(Guard, NumbersAreKeptUpToABound) {
  Door door;
  const GuardedRequest first = door.post();
  ASSERT_EQ(door.guard.judge(first).status, 200);
  const auto write = [&](int i) {
    GuardedRequest asked = door.post();
    asked.remote = "10.0." + std::to_string(i / 50 / 250) + "." + std::to_string(i / 50 % 250);
    return door.guard.judge(asked).status;
  };
  for (int i = 0; i < 19'000; ++i) ASSERT_EQ(write(i), 200);
  EXPECT_EQ(door.guard.judge(first).status, 409);
}

TEST(Guard, WithATokenOnlyThePageAndTheDoorAreOpen) {
  Door door(kToken);
  for (const char* path : {"/", "/static/console.js", "/api/me"})
    EXPECT_EQ(door.guard.judge(door.get(path)).status, 200) << path;
  EXPECT_EQ(door.guard.judge(door.post("/api/enter")).status, 200);
  for (const char* path : {"/api/sessions", "/api/trainees", "/api/me/", "/api/me/../sessions",
                           "/api/enter/", "/API/ME", "//", "", "/api/sessions/x/live",
                           "/api/sessions/x/file/report.html", "/api/pages/x", "/static"}) {
    EXPECT_EQ(door.guard.judge(door.get(path)).status, 401) << path;
    EXPECT_EQ(door.guard.judge(door.post(path)).status, 401) << path;
  }
}

TEST(Guard, TheCookieComesForTheTokenAndOpens) {
  Door door(kToken);
  const std::string cookie = door.guard.enter("10.0.0.1", kToken);
  ASSERT_EQ(cookie.size(), 32u);
  EXPECT_EQ(cookie.find(kToken), std::string::npos);
  GuardedRequest asked = door.get();
  for (const std::string& header :
       {"palpa=" + cookie, "a=b; palpa=" + cookie, "palpa=" + cookie + "; a=b"}) {
    asked.cookie = header;
    EXPECT_EQ(door.guard.judge(asked).status, 200) << header;
  }
  for (const std::string& header :
       {std::string("palpa="), "palpa=" + cookie + "0", "palpa=" + cookie.substr(1),
        "xpalpa=" + cookie, "Palpa=" + cookie, cookie, std::string("palpa=") + kToken,
        "palpa=" + door.guard.pageKey(), "palpa=; palpa=" + cookie}) {
    asked.cookie = header;
    EXPECT_EQ(door.guard.judge(asked).status, 401) << header;
  }
  EXPECT_FALSE(Door(kToken).guard.entered("palpa=" + cookie)) << "another console's";
}

TEST(Guard, FiveWrongTokensThenNotEvenTheRightOneFromThere) {
  Door door(kToken);
  for (const char* wrong : {"", "x", "correct-horse-battery-stapl", "correct-horse-battery-staple ",
                            "Correct-horse-battery-staple"})
    EXPECT_EQ(door.guard.enter("10.0.0.1", wrong), "");
  EXPECT_EQ(door.guard.enter("10.0.0.1", kToken), "");
  EXPECT_NE(door.guard.enter("10.0.0.2", kToken), "");
}

TEST(Guard, WithoutATokenNobodyIsGivenACookie) {
  Door door;
  EXPECT_EQ(door.guard.enter("10.0.0.1", ""), "");
  EXPECT_TRUE(door.guard.entered(""));
}

/// Whoever guesses learns nothing from the answer: it is the same, whatever was wrong.
TEST(Guard, AnswersTellNothingOfWhatWouldBeRight) {
  Door door(kToken);
  std::set<std::string> words;
  for (const std::string& cookie : {std::string(), std::string("palpa="),
                                    "palpa=" + std::string(32, '0'), std::string(10'000, 'x')}) {
    GuardedRequest asked = door.get();
    asked.cookie = cookie;
    words.insert(door.guard.judge(asked).words);
  }
  EXPECT_EQ(words.size(), 1u);
  words.clear();
  for (const std::string& key : {std::string(), std::string("0"), std::string(32, '0'),
                                 door.guard.pageKey().substr(0, 31) + "x"}) {
    GuardedRequest asked = door.post();
    asked.page_key = key;
    words.insert(door.guard.judge(asked).words);
  }
  EXPECT_EQ(words.size(), 1u);
}

TEST(Guard, KeysAreDrawnAnew) {
  std::set<std::string> keys;
  for (int i = 0; i < 1000; ++i) keys.insert(randomKey());
  EXPECT_EQ(keys.size(), 1000u);
  for (const std::string& key : keys)
    EXPECT_EQ(key.find_first_not_of("0123456789abcdef"), std::string::npos);
}

TEST(SafeHeaders, NoPageMayRunOrFrameAnythingElses) {
  std::string policy;
  for (const auto& [name, value] : safeHeaders())
    if (name == "Content-Security-Policy") policy = value;
  EXPECT_NE(policy.find("default-src 'none'"), std::string::npos);
  EXPECT_NE(policy.find("frame-ancestors 'none'"), std::string::npos);
  for (const std::string& one : {policy, std::string(kReportPolicy)}) {
    EXPECT_EQ(one.find("unsafe-eval"), std::string::npos);
    EXPECT_EQ(one.find('*'), std::string::npos);
    EXPECT_EQ(one.find("http"), std::string::npos);
  }
  EXPECT_EQ(std::string(kReportPolicy).find("allow-scripts"), std::string::npos);
  EXPECT_EQ(std::string(kReportPolicy).find("script-src"), std::string::npos)
      << "default-src 'none' covers it";
}

}  // namespace
}  // namespace palpa::console
