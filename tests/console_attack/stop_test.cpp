// The emergency stop, whatever else is asked of the console.
#include <algorithm>

#include "attacked.h"

namespace palpa::console_attack {
namespace {

using namespace std::chrono_literals;

Headers without(Headers headers, const std::string& name) {
  std::erase_if(headers, [&](const auto& one) { return one.first == name; });
  return headers;
}

/// Places taken, from one address and from many.
class Crowd {
 public:
  explicit Crowd(Console& console) : console_(console) {}
  void silent(int count, const std::string& from) {
    for (int i = 0; i < count; ++i) all_.emplace_back(console_.port(), from);
  }
  /// A write whose body never comes: it keeps a thread as long as a body may take.
  void slow(int count, const std::string& from) {
    Headers headers = console_.writeHeaders("");
    for (auto& [name, value] : headers)
      if (name == "Content-Length") value = "60000";
    for (int i = 0; i < count; ++i) {
      all_.emplace_back(console_.port(), from);
      headers = without(std::move(headers), "X-Palpa-Write");
      headers.emplace_back("X-Palpa-Write", Console::newNumber());
      all_.back().send(requestOf("POST", "/api/none", headers));
    }
  }

 private:
  Console& console_;
  std::vector<Wire> all_;
};

class Stops : public Attacked {
 protected:
  static Answer stop(const std::string& from = "") {
    return console().raw(requestOf("POST", path(), console().writeHeaders("{}"), "{}"), from);
  }
  static std::string path() { return "/api/sessions/" + session() + "/stop"; }
  static std::size_t stopsTold() {
    const auto all = console().events(session(), "", [](const auto& seen) {
      return std::any_of(seen.begin(), seen.end(), isStop);
    });
    return static_cast<std::size_t>(std::count_if(all.begin(), all.end(), isStop));
  }
  static bool isStop(const Event& event) {
    return event.data.value("event", "") == "emergency_stop";
  }
  static void leave(const std::string& id) {
    EXPECT_EQ(console().post("/api/sessions/" + id + "/command", {{"command", "leave"}}).status,
              202);
    EXPECT_TRUE(inTime([&] {
      return console().get("/api/sessions/" + id).json().value("state", "") != "running";
    }));
  }
};

/// 150 silent connections of one address; another's page, and its own, are answered at once.
TEST_F(Stops, SilentOnesKeepNobodyOut) {
  session();
  Crowd crowd(console());
  crowd.silent(150, "127.0.0.2");
  const std::string ask = requestOf("GET", "/api/me", console().readHeaders());
  EXPECT_EQ(console().raw(ask, "127.0.0.3").status, 200) << "another's";
  EXPECT_EQ(console().raw(ask, "127.0.0.2").status, 200) << "its own";
  for (int address = 10; address < 30; ++address)
    crowd.silent(10, "127.0.0." + std::to_string(address));
  EXPECT_EQ(console().raw(ask, "127.0.0.3").status, 200) << "from many addresses";
  EXPECT_TRUE(isNoted("503 too many connections"));
  EXPECT_TRUE(goesOn());
}

/// Token, origin and page key stand before it as before every write.
TEST_F(Stops, AStrangersIsNone) {
  session();
  const auto statusOf = [&](const Headers& headers) {
    return console().raw(requestOf("POST", path(), headers, "{}")).status;
  };
  Headers foreign = without(console().writeHeaders("{}"), "Origin");
  foreign.emplace_back("Origin", "http://evil.example");
  EXPECT_EQ(statusOf(foreign), 403);
  EXPECT_EQ(statusOf(without(console().writeHeaders("{}"), "X-Palpa-Page")), 403);
  EXPECT_EQ(statusOf(without(console().writeHeaders("{}"), "X-Palpa-Write")), 400);
  EXPECT_EQ(statusOf(without(console().writeHeaders("{}"), "Host")), 421);
  EXPECT_EQ(console().raw(requestOf("GET", path(), console().readHeaders())).status, 404);
  EXPECT_TRUE(isNoted("/stop 403 requested by another site")) << "later, but it is";
  EXPECT_EQ(
      console()
          .raw(requestOf("POST", "/api/sessions/none/stop", console().writeHeaders("{}"), "{}"))
          .status,
      409);
  EXPECT_TRUE(goesOn()) << "an emergency stop came through";
}

/// A hundred whole ones of a stranger at the educator's own address, before the educator's. Who is
/// turned away before the request is read may find the connection reset, and 503 lost with it.
TEST_F(Stops, AHundredOfAStrangerAreNotBeforeTheRightOne) {
  const std::string id = session();
  ASSERT_GE(console().events(id, "", until(5)).size(), 5u);
  std::vector<Wire> strangers;
  for (int i = 0; i < 100; ++i) {
    Headers headers = without(console().writeHeaders("{}"), "X-Palpa-Page");
    headers.emplace_back("X-Palpa-Page", std::string(32, '0'));
    strangers.emplace_back(console().port());
    strangers.back().send(requestOf("POST", path(), headers, "{}"));
  }
  const Answer right = stop();
  EXPECT_EQ(right.status, 202) << right.head << right.body;
  int refused = 0;
  for (Wire& stranger : strangers) {
    const int status = answerIn(stranger.read(60s)).status;
    const bool turned_away = status == 503 || (status == 0 && stranger.closed());
    EXPECT_TRUE(status == 403 || turned_away) << status;
    refused += status == 403;
  }
  EXPECT_GT(refused, 0) << "none was heard";
  leave(id);
}

/// Every limit reached: writes, connections, threads. One request, one answer, and it has stopped.
TEST_F(Stops, ItGetsThroughWithEveryPlaceTakenAndTheFloodLimitReached) {
  const std::string id = session();
  ASSERT_GE(console().events(id, "", until(5)).size(), 5u);
  const std::string note = R"({"command":"note","reason":"again"})";
  int refused = 0;
  for (int i = 0; i < 80; ++i)
    refused += console()
                   .raw(requestOf("POST", "/api/sessions/" + id + "/command",
                                  console().writeHeaders(note), note))
                   .status == 429;
  EXPECT_GT(refused, 0);
  Crowd crowd(console());
  for (const char* from : {"127.0.0.2", "127.0.0.3", "127.0.0.4", "127.0.0.5"}) {
    crowd.slow(24, from);
    crowd.silent(60, from);
  }
  crowd.silent(150, "127.0.0.1");
  const Answer answer = stop();
  EXPECT_EQ(answer.status, 202) << answer.head << answer.body;
  EXPECT_TRUE(answer.json().value("confirmed", false)) << answer.body;
  EXPECT_EQ(stop("127.0.0.2").status, 202) << "from an address that has taken all it may";
  EXPECT_GE(stopsTold(), 1u);
  leave(id);
  const std::string late = "/api/sessions/" + id + "/stop";
  EXPECT_EQ(console().raw(requestOf("POST", late, console().writeHeaders("{}"), "{}")).status, 409);
}

/// The commands' old path to it has no limit in the session either.
TEST_F(Stops, AsACommandItIsTheSame) {
  const std::string id = session();
  ASSERT_GE(console().events(id, "", until(5)).size(), 5u);
  EXPECT_EQ(console().post("/api/sessions/" + id + "/command", {{"command", "stop"}}).status, 202);
  EXPECT_GE(stopsTold(), 1u);
  leave(id);
}

}  // namespace
}  // namespace palpa::console_attack
