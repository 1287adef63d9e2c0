#include "apps/console/web/own_door.h"

#include <gtest/gtest.h>

#include <set>

#include "apps/console/web/guard.h"

namespace palpa::console {
namespace {

std::string cookieOf(const std::string& key) { return "palpa-mine=" + key; }

TEST(OwnDoor, APinOpensOnceAndForWhomItWasGiven) {
  OwnDoor door;
  const std::string pin = door.pinFor("T001");
  EXPECT_EQ(pin.size(), 6u);
  EXPECT_EQ(pin.find_first_not_of("0123456789"), std::string::npos);
  const std::string key = door.enter("10.0.0.7", pin);
  ASSERT_FALSE(key.empty());
  EXPECT_EQ(door.traineeOf(cookieOf(key)), "T001");
  EXPECT_EQ(door.enter("10.0.0.7", pin), "") << "it was used";
}

TEST(OwnDoor, ANewPinTakesTheOldOnesPlace) {
  OwnDoor door;
  const std::string first = door.pinFor("T001"), other = door.pinFor("T002"),
                    second = door.pinFor("T001");
  EXPECT_EQ(door.enter("10.0.0.7", first), "");
  EXPECT_EQ(door.traineeOf(cookieOf(door.enter("10.0.0.7", second))), "T001");
  EXPECT_EQ(door.traineeOf(cookieOf(door.enter("10.0.0.7", other))), "T002");
}

TEST(OwnDoor, WhoGuessesIsMadeToWaitAndOthersAreNot) {
  OwnDoor door;
  const std::string pin = door.pinFor("T001");
  for (int i = 0; i < 5; ++i) EXPECT_EQ(door.enter("10.0.0.66", i == 0 ? "" : "nonsense"), "");
  EXPECT_EQ(door.enter("10.0.0.66", pin), "") << "even the right one";
  EXPECT_NE(door.enter("10.0.0.7", pin), "");
}

TEST(OwnDoor, FiftyWrongOnesFromAnywhereEndEveryPin) {
  OwnDoor door;
  const std::string pin = door.pinFor("T001");
  for (int i = 0; i < 50; ++i) EXPECT_EQ(door.enter("10.0.1." + std::to_string(i), "nonsense"), "");
  EXPECT_EQ(door.enter("10.0.0.7", pin), "");
}

TEST(OwnDoor, WhatIsTooOldOpensNothing) {
  using namespace std::chrono_literals;
  OwnDoor old_pins(0ms, OwnDoor::kKeyLasts), old_keys(OwnDoor::kPinLasts, 0ms);
  EXPECT_EQ(old_pins.enter("10.0.0.7", old_pins.pinFor("T001")), "");
  const std::string key = old_keys.enter("10.0.0.7", old_keys.pinFor("T001"));
  ASSERT_FALSE(key.empty());
  EXPECT_EQ(old_keys.traineeOf(cookieOf(key)), "");
}

TEST(OwnDoor, WhoLeavesIsOutside) {
  OwnDoor door;
  const std::string key = door.enter("10.0.0.7", door.pinFor("T001"));
  door.leave(cookieOf(key));
  EXPECT_EQ(door.traineeOf(cookieOf(key)), "");
}

TEST(OwnDoor, NobodysCookieIsNobody) {
  OwnDoor door;
  const std::string key = door.enter("10.0.0.7", door.pinFor("T001"));
  for (const std::string& cookies :
       {std::string(), std::string("palpa-mine="), std::string("palpa-mine"), "palpa=" + key,
        "xpalpa-mine=" + key, cookieOf(key + "0"), cookieOf(key.substr(1))})
    EXPECT_EQ(door.traineeOf(cookies), "") << cookies;
  EXPECT_EQ(door.traineeOf("palpa=1; palpa-mine=" + key + "; x=2"), "T001");
}

TEST(OwnDoor, PinsDifferAndNeedAllTheirDigits) {
  OwnDoor door;
  std::set<std::string> pins;
  std::set<char> firsts;
  for (int i = 0; i < 300; ++i) {
    const std::string pin = door.pinFor("T" + std::to_string(i));
    ASSERT_EQ(pin.size(), 6u);
    pins.insert(pin);
    firsts.insert(pin.front());
  }
  EXPECT_EQ(pins.size(), 300u);
  EXPECT_EQ(firsts.size(), 10u);
}

/// A trainee's key opens nothing but what lies under /api/mine, and there it only reads.
TEST(OwnDoor, ItsKeyIsNotTheConsoles) {
  Guard guard("the educator's token");
  guard.answerTo({"10.0.0.1:8123"});
  const std::string key = guard.own().enter("10.0.0.7", guard.own().pinFor("T001"));
  const auto asked = [&](const std::string& method, const std::string& path) {
    GuardedRequest request;
    request.remote = "10.0.0.7";
    request.method = method;
    request.path = path;
    request.host = "10.0.0.1:8123";
    request.cookie = cookieOf(key);
    if (method == "POST") {
      request.origin = "http://10.0.0.1:8123";
      request.fetch_site = "same-origin";
      request.content_type = "application/json";
      request.page_key = guard.pageKey();
      request.write_id = randomKey();
    }
    return guard.judge(request).status;
  };
  EXPECT_EQ(asked("GET", "/api/mine"), 200);
  EXPECT_EQ(asked("GET", "/api/mine/A/file/report.html"), 200);
  EXPECT_EQ(asked("POST", "/api/mine/enter"), 200);
  for (const char* path :
       {"/api/sessions", "/api/trainees", "/api/minecraft", "/api/sessions/A/file/report.html",
        "/api/mine/../sessions", "/api/health", "/api/trainees/T001/report"})
    EXPECT_EQ(asked("GET", path), 401) << path;
  for (const char* path :
       {"/api/mine", "/api/sessions", "/api/trainees/T001/pin", "/api/sessions/A/stop"})
    EXPECT_EQ(asked("POST", path), 401) << path;
}

}  // namespace
}  // namespace palpa::console
