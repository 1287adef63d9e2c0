#include <optional>

#include "apps/console/room_station.h"
#include "apps/console/routes.h"
#include "apps/os/tcp_socket.h"
#include "apps/record/session_file.h"
#include "apps/room/watch.h"
#include "tests/console/served.h"
#include "tests/room/broker.h"

/// A station's console in its room, and the console that watches it, on a real broker.
namespace palpa::console {
namespace {

namespace fs = std::filesystem;
using room::Broker;
using room::today;

class ConsoleInARoom : public testing::Test {
 protected:
  void SetUp() override {
    if (!Broker::isInstalled()) GTEST_SKIP() << "mosquitto is not installed";
    writePairing(pairing_, room_.pair("one", today() - std::chrono::hours(1)));
    broker_.emplace(room_);
  }
  void join() {
    station_.emplace(folder_ / "home", sockets_.path(), "", pairing_);
    ASSERT_TRUE(inTime([this] { return !station_->url().empty(); }));
  }
  std::unique_ptr<room::RoomWatch> watch() {
    return std::make_unique<room::RoomWatch>(room_.watcher(today()), folder_ / "watch");
  }
  /// A session that was held while nobody listened.
  void hold(const std::string& id, bool blind) {
    const fs::path session = folder_ / "home/sessions" / id;
    fs::create_directories(session);
    std::ofstream(session / "console.json")
        << json{{"started_utc", runtime::utcNow()}, {"blind", blind}, {"trainee", "t-07"}};
    record::SessionInfo info;
    info.session_json = info.station_json = info.task_json = "{}";
    info.uuid = "record-of-" + id;
    record::SessionWriter writer(session / "session.palpa", info);
    const auto event = [&writer](runtime::EventKind kind, const char* text) {
      writer.event({1'000'000'000, 1, nameOf(kind), text, 0});
    };
    event(runtime::EventKind::trial_case, "the answer");
    event(runtime::EventKind::start, "Trial 1 starts");
    event(runtime::EventKind::vein, "The tip is in the vein");
    event(runtime::EventKind::note, "Mary's hand shook");
    event(runtime::EventKind::emergency_stop, "Emergency stop");
    writer.event({2'000'000'000, 1, "void", "Mary felt faint", 0});
    writer.close();
  }

  const palpa::test::ScratchFolder folder_{"console-room"};
  const palpa::test::ShortFolder sockets_;
  const fs::path pairing_ = folder_ / "one.palpa-pairing";
  room::Room room_ = room::Room::made(folder_ / "room", "localhost", room::freePort(), today());
  std::optional<Broker> broker_;
  std::optional<Served> station_;
};

std::vector<std::string> textsOf(const room::RoomWatch& watch, const std::string& session) {
  std::vector<std::string> all;
  for (const room::Kept& kept : watch.happenings("one"))
    if (kept.happening.session == session) all.push_back(kept.happening.text);
  return all;
}

TEST_F(ConsoleInARoom, AStationPreparesTellsShowsAndStopsAsItIsAsked) {
  join();
  const auto watch = this->watch();
  const auto now = [&] { return watch->stations()["one"]; };
  ASSERT_TRUE(inTime([&] { return now().about && now().state.present; }));
  EXPECT_EQ(now().about->url, station_->url());
  const auto asks = [&](const char* id, room::Ask::What what, const json& wish = {}) {
    return watch->ask("one", {id, now().state.session, what, wish}, 20s).value_or(room::Answer{});
  };
  EXPECT_EQ(asks("a", room::Ask::What::stop).words, "that session is not running there (any more)");
  EXPECT_NE(asks("b", room::Ask::What::prepare, {{"task", "../x"}}).words, "");
  const auto prepared = asks("c", room::Ask::What::prepare,
                             {{"task", "paracentesis"}, {"operator", "expert"}, {"film", true}});
  EXPECT_TRUE(prepared.done) << prepared.words;
  ASSERT_TRUE(inTime([&] { return !now().state.session.empty(); }));
  EXPECT_EQ(now().state.task, "Access to the subclavian vein");
  ASSERT_TRUE(inTime([&] { return now().events >= 50; }));
  std::int64_t next = 0;
  for (const room::Kept& kept : watch->happenings("one")) EXPECT_EQ(kept.happening.number, next++);

  httplib::Client client = station_->client();
  const auto picture = [&](const std::string& key) {
    return client.Get(kRoomPicture, {{"X-Palpa-Room", key}})->status;
  };
  EXPECT_TRUE(inTime([&] { return picture(now().about->picture_key) == 200; }));
  EXPECT_EQ(picture("00000000000000000000000000000000"), 403);
  EXPECT_EQ(picture(""), 403);

  EXPECT_TRUE(asks("d", room::Ask::What::pause).done);
  EXPECT_TRUE(asks("e", room::Ask::What::stop).done);
  EXPECT_TRUE(asks("f", room::Ask::What::leave).done);
  EXPECT_TRUE(inTime([&] { return now().state.session.empty(); }));
  station_.reset();
  EXPECT_TRUE(inTime([&] { return !now().state.present; }));
}

TEST_F(ConsoleInARoom, WhatWasRecordedWhileNobodyListenedIsToldWithoutNamesOrAnswers) {
  hold("20260101-000000-open", false);
  hold("20260101-000001-blind", true);
  join();
  const auto watch = this->watch();
  const std::vector<std::string> open{"Trial 1 starts", "The tip is in the vein",
                                      "Somebody noted something", "Emergency stop",
                                      "The trial ended: void"};
  EXPECT_TRUE(inTime([&] { return textsOf(*watch, "20260101-000000-open") == open; }));
  const std::vector<std::string> blind{"The trial began", "Somebody noted something",
                                       "Emergency stop"};
  EXPECT_TRUE(inTime([&] { return textsOf(*watch, "20260101-000001-blind") == blind; }));
  const auto isTold = [&](const char* id) {
    std::ifstream in(folder_ / "home/sessions" / id / "console.json");
    return json::parse(in, nullptr, false).value("told", false);
  };
  EXPECT_TRUE(
      inTime([&] { return isTold("20260101-000000-open") && isTold("20260101-000001-blind"); }));
  std::ifstream kept(folder_ / "watch/events.jsonl");
  const std::string all(std::istreambuf_iterator<char>(kept), {});
  for (const char* never : {"t-07", "Mary", "the answer"})
    EXPECT_EQ(all.find(never), std::string::npos) << never;
}

TEST_F(ConsoleInARoom, TheOneThatWatchesShowsWhatItHearsAndPassesOnWhatIsAsked) {
  station_.emplace(folder_ / "home", sockets_.path(), "", room_.brokerSettings().parent_path());
  const json nobody = station_->get("/api/room");
  EXPECT_EQ(nobody["watch"]["stations"].size(), 0u);
  EXPECT_EQ(station_->get("/api/me")["room"]["watches"], true);
  room::StationLine line(room::readPairing(pairing_, today()),
                         {"http://127.0.0.1:1/", "", std::string(32, 'a'), "1"},
                         [](const room::Ask& ask) {
                           return room::Answer{"", ask.what == room::Ask::What::pause, "never"};
                         });
  ASSERT_TRUE(inTime([&] { return station_->get("/api/room")["watch"]["stations"].size() == 1; }));
  room::Happening event{"20260101-a", "r", 0, 1.5, 1, "phase", "On the way", "neutral"};
  ASSERT_TRUE(inTime([&] { return line.tell(event); }));
  ASSERT_TRUE(inTime([&] { return station_->get("/api/room/one/events").size() == 1; }));
  EXPECT_EQ(station_->get("/api/room/one/events")[0]["text"], "On the way");
  EXPECT_EQ(station_->post("/api/room/one/ask", {{"ask", "pause"}, {"session", "s"}}), 200);
  json told;
  EXPECT_EQ(station_->post("/api/room/one/ask", {{"ask", "stop"}, {"session", "s"}}, &told), 409);
  EXPECT_EQ(told["error"], "one: never");
  EXPECT_EQ(station_->post("/api/room/one/ask", {{"ask", "start"}, {"session", "s"}}), 422);
  EXPECT_EQ(station_->post("/api/room/two/ask", {{"ask", "pause"}, {"session", "s"}}), 404);
  EXPECT_EQ(station_->client().Get("/api/room/one/picture")->status, 204);
  EXPECT_EQ(station_->client().Get("/api/room/two/picture")->status, 404);
}

TEST(PicturePlaces, AreFewAndNotForWhoIsSlow) {
  PicturePlaces places;
  const PicturePlaces::Time now{std::chrono::hours(1)};
  EXPECT_TRUE(places.take("a", now));
  EXPECT_FALSE(places.take("a", now)) << "one a station";
  for (const char* other : {"b", "c", "d"}) EXPECT_TRUE(places.take(other, now));
  EXPECT_FALSE(places.take("e", now)) << "no place is left";
  places.giveBack("a", now, now + 100ms);
  EXPECT_TRUE(places.take("e", now + 1s));
  places.giveBack("b", now, now + 4s);
  EXPECT_FALSE(places.take("b", now + 5s)) << "it was slow";
  EXPECT_TRUE(places.take("a", now + 5s));
  places.giveBack("a", now + 5s, now + 5s);
  EXPECT_TRUE(places.take("b", now + 15s));
}

TEST_F(ConsoleInARoom, AStationThatKeepsItsPictureBackIsNotAskedAgainAtOnce) {
  station_.emplace(folder_ / "home", sockets_.path(), "", room_.brokerSettings().parent_path());
  os::TcpListener silent("127.0.0.1", 0);  // takes whoever comes, and says nothing
  const room::StationLine line(
      room::readPairing(pairing_, today()),
      {"http://127.0.0.1:" + std::to_string(silent.port()) + "/", "", std::string(32, 'a'), "1"},
      [](const room::Ask&) {
        return room::Answer{"", false, ""};
      });
  ASSERT_TRUE(inTime([&] { return station_->get("/api/room")["watch"]["stations"].size() == 1; }));
  EXPECT_EQ(station_->client().Get("/api/room/one/picture")->status, 204);
  EXPECT_TRUE(silent.accept().open());
  EXPECT_EQ(station_->client().Get("/api/room/one/picture")->status, 204);
  EXPECT_FALSE(silent.accept().open());
}

TEST_F(ConsoleInARoom, AStationWhoseFileIsDamagedStartsAloneAndSaysSo) {
  std::ofstream(pairing_) << "{}";
  join();
  const json joined = station_->get("/api/room")["joined"];
  EXPECT_EQ(joined["stands"], false);
  EXPECT_NE(joined.value("trouble", "").find("version"), std::string::npos) << joined.dump();
}

TEST_F(ConsoleInARoom, WithoutARoomNothingOfItIsThere) {
  Served alone(folder_ / "home", sockets_.path());
  EXPECT_TRUE(alone.get("/api/room")["watch"].is_null());
  EXPECT_TRUE(alone.get("/api/room")["joined"].is_null());
  EXPECT_EQ(alone.client().Get(kRoomPicture)->status, 403);
  EXPECT_EQ(alone.client().Get("/api/room/one/events")->status, 422);
}

}  // namespace
}  // namespace palpa::console
