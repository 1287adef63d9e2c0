#include <set>
#include <thread>

#include "anatomy/base/error.h"
#include "apps/room/station_line.h"
#include "apps/room/watch.h"
#include "broker.h"
#include "tests/support/scratch_folder.h"

namespace palpa::room {
namespace {

using std::chrono::days;
using std::chrono::seconds;

/// A room with its broker on this computer.
class RoomOfStations : public testing::Test {
 protected:
  void SetUp() override {
    if (!Broker::isInstalled()) GTEST_SKIP() << "mosquitto is not installed";
    broker_.emplace(room_);
  }
  std::unique_ptr<RoomWatch> watch() {
    return std::make_unique<RoomWatch>(room_.watcher(today()), scratch_ / "watch");
  }
  Pairing pairing(const std::string& station, std::chrono::sys_seconds when = today()) {
    Pairing made = room_.pair(station, when);
    broker_->readAgain();
    return made;
  }
  std::unique_ptr<StationLine> station(const Pairing& pairing) {
    return std::make_unique<StationLine>(
        pairing, StationFacts{"http://127.0.0.1:1/", "", std::string(32, 'a'), "1"},
        [this](const Ask& ask) {
          ++asked_;
          return Answer{"", ask.what == Ask::What::pause, "not now"};
        });
  }

  const palpa::test::ScratchFolder scratch_{"room"};
  Room room_ = Room::made(scratch_ / "room", "localhost", freePort(), today());
  std::optional<Broker> broker_;
  std::atomic<int> asked_{0};
};

Happening event(const std::string& session, std::int64_t number) {
  Happening h;
  h.session = session;
  h.record = "rec-" + session;
  h.number = number;
  h.event = "phase";
  h.text = "Event " + std::to_string(number);
  h.tone = "neutral";
  return h;
}

/// All of a session's first `count`, as a station tells them: again and again, until they are
/// taken.
void tellAll(StationLine& line, const std::string& session, int count) {
  for (int i = 0; i < count; ++i)
    ASSERT_TRUE(soon([&] {
      line.look();
      return line.tell(event(session, i));
    }));
}

std::vector<std::int64_t> numbersOf(const RoomWatch& watch, const std::string& station) {
  std::vector<std::int64_t> all;
  for (const Kept& kept : watch.happenings(station)) all.push_back(kept.happening.number);
  return all;
}

std::vector<std::int64_t> upTo(std::int64_t count) {
  std::vector<std::int64_t> all;
  for (std::int64_t i = 0; i < count; ++i) all.push_back(i);
  return all;
}

bool says(const StationLine& line, const std::string& words) {
  return line.state().trouble.find(words) != std::string::npos;
}

TEST_F(RoomOfStations, SeesHowEachStandsAndThatOneIsGone) {
  const auto watch = this->watch();
  auto one = station(pairing("one")), two = station(pairing("two"));
  StationState running;
  running.present = true;
  running.state = "running";
  running.task = "A needle";
  const auto stateOf = [&](const std::string& name) { return watch->stations()[name].state; };
  EXPECT_TRUE(soon([&] {
    one->show(running);
    two->show(running);
    return stateOf("one").task == "A needle" && stateOf("two").present;
  }));
  EXPECT_EQ(watch->stations()["one"].about->url, "http://127.0.0.1:1/");
  two.reset();
  EXPECT_TRUE(soon([&] { return !stateOf("two").present; }));
  EXPECT_EQ(stateOf("two").state, "gone");
  EXPECT_TRUE(stateOf("one").present);
}

TEST_F(RoomOfStations, HearsEveryEventOnceThoughAllAreKilledInTurn) {
  auto watch = this->watch();
  const Pairing pairing = this->pairing("one");
  auto line = station(pairing);
  tellAll(*line, "20260101-a", 50);
  EXPECT_TRUE(soon([&] { return numbersOf(*watch, "one") == upTo(50); }));

  broker_->kill(SIGKILL);
  line->tell(event("20260101-a", 50));
  EXPECT_TRUE(soon([&] { return says(*line, "is gone") || says(*line, "cannot be reached"); }));
  EXPECT_FALSE(line->state().stands);
  broker_->start();
  tellAll(*line, "20260101-a", 90);
  EXPECT_TRUE(soon([&] {
    line->look();
    return numbersOf(*watch, "one") == upTo(90);
  }));

  line.reset();  // a station that was killed tells all that it has, from the first
  line = station(pairing);
  tellAll(*line, "20260101-a", 120);
  EXPECT_TRUE(soon([&] { return numbersOf(*watch, "one") == upTo(120); }));

  watch.reset();
  tellAll(*line, "20260101-a", 130);
  watch = this->watch();
  tellAll(*line, "20260101-a", 150);
  EXPECT_TRUE(soon([&] {
    line->look();
    return numbersOf(*watch, "one") == upTo(150);
  }));
  EXPECT_TRUE(soon([&] { return line->heardOf("20260101-a", "rec-20260101-a") == 149; }));
}

TEST_F(RoomOfStations, AsksAStationAndHearsTheAnswer) {
  const auto watch = this->watch();
  const auto line = station(pairing("one"));
  ASSERT_TRUE(soon([&] { return watch->stations()["one"].about.has_value(); }));
  const auto paused = watch->ask("one", {"a1", "s", Ask::What::pause, {}}, seconds(10));
  ASSERT_TRUE(paused);
  EXPECT_TRUE(paused->done);
  const auto stopped = watch->ask("one", {"a2", "s", Ask::What::stop, {}}, seconds(10));
  ASSERT_TRUE(stopped);
  EXPECT_FALSE(stopped->done);
  EXPECT_EQ(stopped->words, "not now");
  EXPECT_EQ(asked_, 2);
  EXPECT_FALSE(watch->ask("nobody", {"a3", "s", Ask::What::pause, {}}, seconds(1)));
}

TEST_F(RoomOfStations, WhoIsOfAnotherRoomOrOverIsRefusedAndTold) {
  // A certificate that was good for five years, six years ago.
  const auto over = station(pairing("over", today() - days(2190)));
  Room other = Room::made(scratch_ / "other", "localhost", room_.port(), today());
  Pairing foreign = other.pair("one", today());
  const auto stranger = station(foreign);
  EXPECT_TRUE(soon([&] { return says(*stranger, "is not the one of this room"); }));
  foreign.broker.authority = pairing("one").broker.authority;
  const auto forged = station(foreign);
  for (const auto* line : {&over, &forged}) {
    EXPECT_TRUE(soon([&] { return says(**line, "refused this computer's certificate"); }))
        << (*line)->state().trouble;
    EXPECT_FALSE((*line)->state().stands);
  }
}

TEST_F(RoomOfStations, NobodySpeaksForAnotherStation) {
  const auto watch = this->watch();
  const Pairing old = pairing("one"), two = pairing("two");
  Pairing pretends = two;
  pretends.station = "one";
  const auto liar = station(pretends);
  EXPECT_TRUE(soon([&] { return says(*liar, "palpa/one/"); }));
  EXPECT_EQ(watch->stations().count("one"), 0u);
  const auto honest = station(two);
  EXPECT_TRUE(soon([&] { return watch->stations()["two"].about.has_value(); }));
  EXPECT_EQ(honest->state().trouble, "");

  pairing("one");  // again: the certificate of before is of no use
  const auto stolen = station(old);
  EXPECT_TRUE(soon([&] { return says(*stolen, "palpa/one/"); }));
  EXPECT_EQ(watch->stations().count("one"), 0u);
}

TEST_F(RoomOfStations, AWatcherWhosePagesAreGoneIsToldAgain) {
  auto watch = this->watch();
  const auto line = station(pairing("one"));
  tellAll(*line, "20260101-a", 30);
  EXPECT_TRUE(soon([&] { return numbersOf(*watch, "one") == upTo(30); }));
  watch.reset();
  std::filesystem::remove_all(scratch_ / "watch");
  const int before = line->beginnings();
  watch = this->watch();
  EXPECT_TRUE(soon([&] { return line->beginnings() == before + 1; }));
  tellAll(*line, "20260101-a", 40);
  EXPECT_TRUE(soon([&] { return numbersOf(*watch, "one") == upTo(40); }));
}

TEST_F(RoomOfStations, WhatIsAskedWithoutABrokerIsNotDoneLater) {
  const auto watch = this->watch();
  const auto line = station(pairing("one"));
  ASSERT_TRUE(soon([&] { return watch->stations()["one"].about.has_value(); }));
  broker_->kill(SIGKILL);
  ASSERT_TRUE(soon([&] { return !watch->broker().stands; }));
  EXPECT_FALSE(watch->ask("one", {"a1", "s", Ask::What::pause, {}}, seconds(1)));
  broker_->start();
  ASSERT_TRUE(soon([&] { return watch->broker().stands && line->state().stands; }));
  EXPECT_TRUE(watch->ask("one", {"a2", "s", Ask::What::pause, {}}, seconds(10)));
  EXPECT_EQ(asked_, 1);
}

TEST_F(RoomOfStations, AStopGoesBeforeWhatIsBeingDoneAndWhatWaits) {
  const auto watch = this->watch();
  std::atomic<bool> let_go{false}, busy{false};
  std::mutex mutex;
  std::vector<Ask::What> done;
  StationLine line(pairing("one"), {"http://127.0.0.1:1/", "", std::string(32, 'a'), "1"},
                   [&](const Ask& ask) {
                     busy = true;
                     if (ask.what != Ask::What::stop)
                       runtime::comesTrue(seconds(20), [&] { return let_go.load(); });
                     const std::lock_guard lock(mutex);
                     done.push_back(ask.what);
                     return Answer{"", true, ""};
                   });
  ASSERT_TRUE(soon([&] { return watch->stations()["one"].about.has_value(); }));
  std::vector<std::thread> asking;
  for (const char* id : {"a", "b", "c"})
    asking.emplace_back([&, id] {
      watch->ask("one", {id, "s", Ask::What::prepare, {}}, seconds(20));
    });
  EXPECT_TRUE(soon([&] { return busy.load(); }));
  const auto stopped = watch->ask("one", {"d", "s", Ask::What::stop, {}}, seconds(20));
  ASSERT_TRUE(stopped);
  EXPECT_TRUE(stopped->done);
  {
    const std::lock_guard lock(mutex);
    EXPECT_EQ(done, std::vector{Ask::What::stop});
  }
  let_go = true;
  for (std::thread& one : asking) one.join();
}

TEST_F(RoomOfStations, UrgentWordsAreSaidBeforeAllThatWait) {
  std::mutex mutex;
  std::vector<std::string> heard;
  const BrokerLine listens({.access = pairing("one").broker,
                            .last_will = {},
                            .topics = {topicOf("one", Topic::asks)},
                            .greets = {},
                            .hears = [&](const Said& said) {
                              const std::lock_guard lock(mutex);
                              heard.push_back(askIn(said.words).id);
                            }});
  ASSERT_TRUE(soon([&] { return listens.state().stands; }));
  std::unique_ptr<BrokerLine> says;
  std::atomic<bool> there{false};
  const auto say = [&](const std::string& id, bool urgent) {
    const Ask ask{id, "s", urgent ? Ask::What::stop : Ask::What::pause, {}};
    says->say({topicOf("one", Topic::asks), wire(toJson(ask)), false, std::nullopt, urgent});
  };
  BrokerLine::Wish wish{
      .access = room_.watcher(today()), .last_will = {}, .topics = {}, .greets = {}, .hears = {}};
  wish.greets = [&]() -> std::vector<Said> {
    runtime::comesTrue(seconds(20), [&] { return there.load(); });
    for (int i = 0; i < 40; ++i) say("pause" + std::to_string(i), false);
    for (const char* id : {"stop1", "stop2"}) say(id, true);
    return {};
  };
  says = std::make_unique<BrokerLine>(std::move(wish));
  there = true;
  std::vector<std::string> expected{"stop1", "stop2"};
  for (int i = 0; i < 40; ++i) expected.push_back("pause" + std::to_string(i));
  EXPECT_TRUE(soon([&] {
    const std::lock_guard lock(mutex);
    return heard.size() == expected.size();
  }));
  const std::lock_guard lock(mutex);
  EXPECT_EQ(heard, expected);
}

TEST_F(RoomOfStations, TwoByOneNameAreTold) {
  const Pairing both = pairing("one");
  const auto first = station(both), second = station(both);
  EXPECT_TRUE(soon([&] { return says(*first, "another console") || says(*second, "another"); }))
      << first->state().trouble << " | " << second->state().trouble;
}

TEST_F(RoomOfStations, NothingIsKeptTwiceOrOutOfOrder) {
  const auto watch = this->watch();
  ASSERT_TRUE(soon([&] { return watch->broker().stands; }));  // nobody says these words again
  BrokerLine line(
      {.access = pairing("one").broker, .last_will = {}, .topics = {}, .greets = {}, .hears = {}});
  const auto say = [&](const Happening& h) {
    line.say({topicOf("one", Topic::events), wire(toJson(h)), false});
  };
  for (const int number : {0, 1, 1, 3, 0, 2, 2, 3, 4}) say(event("20260101-a", number));
  line.say({topicOf("one", Topic::events), "{\"session\": 7}", false});
  line.say({topicOf("one", Topic::events), std::string(100'000, 'x'), false});  // never said
  say(event("20260101-a", 5));
  EXPECT_TRUE(soon([&] { return numbersOf(*watch, "one") == upTo(6); }));
}

}  // namespace
}  // namespace palpa::room
