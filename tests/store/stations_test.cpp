// Eight stations, each a process of its own, write 200 trials at once; writers are killed, the
// server goes away and comes back: no trial lost, none twice.
#include <algorithm>
#include <chrono>
#include <set>

#include "anatomy/base/random.h"
#include "apps/record/store/sql_connection.h"
#include "apps/runtime/clock.h"
#include "tests/store/stores.h"
#include "tests/store/writer_process.h"
#include "tests/support/counts.h"

namespace palpa::record {
namespace {

using test::WriterProcess;

constexpr int kStations = 8, kTrialsEach = 25;

std::string traineeOf(int station) { return "T" + std::to_string(station); }

class Stations : public Store {
 protected:
  void SetUp() override {
    Store::SetUp();
    if (IsSkipped()) return;
    RecordStore store(url);
    for (int s = 0; s < kStations; ++s) store.addTrainee(novice(traineeOf(s)));
  }

  /// All at once, none allowed to write yet.
  std::vector<WriterProcess> start() const {
    std::vector<WriterProcess> stations;
    for (int s = 0; s < kStations; ++s)
      stations.push_back(WriterProcess({url, traineeOf(s), std::to_string(kTrialsEach)}));
    return stations;
  }

  static void runToTheEnd(std::vector<WriterProcess>& stations) {
    for (WriterProcess& station : stations) station.allowAll();
    for (WriterProcess& station : stations) EXPECT_EQ(station.wait(), 0);
  }

  void expectAllOnce() const {
    RecordStore store(url);
    const auto all = store.trials();
    EXPECT_EQ(all.size(), static_cast<std::size_t>(kStations * kTrialsEach));
    std::set<std::pair<std::string, std::int64_t>> seen;
    for (const TrialWithSession& t : all) {
      EXPECT_TRUE(seen.insert({t.session.uuid, t.trial.number}).second);
      EXPECT_EQ(t.session.arrival, 1);
      EXPECT_EQ(t.trial.metric("total"), static_cast<double>(t.trial.number));
      EXPECT_EQ(t.trial.metrics.size(), 2u);
      EXPECT_EQ(store.events(t.session.uuid, t.trial.number).size(), 2u);
      if (HasFailure()) return;
    }
  }

  RandomStream dice_{2026, "stations"};
};

INSTANTIATE_TEST_SUITE_P(Both, Stations, testing::Values("SQLite", "PostgreSQL"),
                         [](const auto& p) { return std::string(p.param); });

/// What only a server can do.
class ServerStations : public Stations {};
INSTANTIATE_TEST_SUITE_P(Server, ServerStations, testing::Values("PostgreSQL"),
                         [](const auto& p) { return std::string(p.param); });

TEST_P(Stations, AllAtOnce) {
  auto stations = start();
  runToTheEnd(stations);
  expectAllOnce();
}

/// Each is allowed one trial more than it has to say has arrived before it is killed: in the middle
/// of that one, or just after.
TEST_P(Stations, KilledWritersAreMadeUpFor) {
  const int rounds = test::counted(1, 8);
  for (int round = 0; round < rounds; ++round) {
    auto stations = start();
    for (WriterProcess& station : stations) {
      const int whole = 1 + static_cast<int>(dice_.bits() % 4);
      station.allow(whole + 1);
      ASSERT_TRUE(station.waitFor(whole));
      runtime::SteadyClock().sleepUntil(static_cast<std::int64_t>(dice_.uniform() * 6e6));
      station.kill();
      EXPECT_EQ(station.wait(), 128 + SIGKILL);
    }
    RecordStore store(url);
    for (int s = 0; s < kStations; ++s) {  // what was said to have arrived is there
      const auto there = store.trials({.trainee = traineeOf(s)}).size();
      EXPECT_GE(there, static_cast<std::size_t>(stations[static_cast<std::size_t>(s)].arrived()));
      EXPECT_LT(there, static_cast<std::size_t>(kTrialsEach));
    }
  }
  auto again = start();
  runToTheEnd(again);
  expectAllOnce();
}

TEST_P(ServerStations, TheServerIsKilledAndComesBack) {
  const int kills = test::counted(2, 8);
  auto stations = start();
  for (int k = 0; k < kills; ++k) {
    const int more = kTrialsEach / (kills + 1),
              whole = k * more + 1 + static_cast<int>(dice_.bits() % static_cast<unsigned>(more));
    for (WriterProcess& station : stations) station.allow(more);
    for (WriterProcess& station : stations)
      ASSERT_TRUE(station.waitFor(std::min(whole, (k + 1) * more)));
    runtime::SteadyClock().sleepUntil(static_cast<std::int64_t>(dice_.uniform() * 10e6));
    server->kill();
    if (k + 1 == kills)
      for (WriterProcess& station : stations)
        station.allowAll();  // they write against a server that is not there
    runtime::SteadyClock().sleepUntil(
        static_cast<std::int64_t>((0.05 + 0.2 * dice_.uniform()) * 1e9));
    server->start();
  }
  runToTheEnd(stations);
  expectAllOnce();
}

TEST_P(Stations, OnAStoreThatNobodyMadeYet) {
  const std::string fresh =
      onServer() ? server->freshDatabase() : (folder / "fresh.sqlite").string();
  std::vector<WriterProcess> stations;
  for (int s = 0; s < kStations; ++s) stations.push_back(WriterProcess({fresh, traineeOf(s)}));
  for (WriterProcess& station : stations) EXPECT_EQ(station.wait(), 0);
  EXPECT_EQ(RecordStore(fresh).trainees().size(), static_cast<std::size_t>(kStations));
}

/// A console has the records open more than once. What one opens and closes must not let go of the
/// file for the others: a station that is done would then clear away the log they write to.
TEST_P(Stations, OneProgramMayOpenThemTwice) {
  RecordStore first(url);
  { RecordStore second(url); }
  EXPECT_EQ(WriterProcess({url, "Elsewhere"}).wait(), 0);
  first.addTrainee(novice("Here"));
  EXPECT_EQ(WriterProcess({url, "Here"}).wait(), 3);  // it sees that one
  EXPECT_EQ(RecordStore(url).trainees().size(), static_cast<std::size_t>(kStations + 2));
}

TEST_P(Stations, OfTheSameNewTraineeOneIsAdded) {
  std::vector<WriterProcess> stations;
  for (int s = 0; s < kStations; ++s) stations.push_back(WriterProcess({url, "Same"}));
  int added = 0, refused = 0;
  for (WriterProcess& station : stations) {
    const int code = station.wait();
    added += code == 0;
    refused += code == 3;
  }
  EXPECT_EQ(added, 1);
  EXPECT_EQ(refused, kStations - 1);
}

/// One that takes a request and says nothing is given up; one that takes its time over a long
/// answer is not.
TEST_P(ServerStations, OneThatSaysNothingIsGivenUp) {
  const auto asked = openPostgres(url, Access::write, std::chrono::seconds(2));
  EXPECT_EQ(
      asked->query("SELECT repeat('x', 20000), pg_sleep(0.3) FROM generate_series(1, 10)").size(),
      10u);
  const auto expectGivenUp = [](auto ask) {
    try {
      ask();
      ADD_FAILURE() << "was waited for";
    } catch (const StoreUnreachable& e) {
      EXPECT_NE(std::string(e.what()).find("does not answer"), std::string::npos) << e.what();
    }
  };
  expectGivenUp([&] { asked->query("SELECT pg_sleep(3600)"); });
  expectGivenUp([&] { asked->query("SELECT 1"); });
  const auto writing = openPostgres(url, Access::write, std::chrono::seconds(2));
  expectGivenUp([&] {
    SqlTransaction transaction(*writing);
    writing->query("SELECT pg_sleep(3600)");
  });
}

/// The system counts no silence of a Unix socket: a slow answer is waited for there.
TEST_P(ServerStations, OneOnAUnixSocketIsWaitedFor) {
  const auto asked =
      openPostgres(server->localUrl(), Access::write, std::chrono::milliseconds(200));
  EXPECT_EQ(asked->query("SELECT 1 FROM pg_sleep(2)").size(), 1u);
}

/// libpqxx 6 would connect anew as soon as a transaction begins.
TEST_P(ServerStations, AConnectionThatIsLostStaysLost) {
  const auto lost = connect(url), writing = connect(url), other = connect(url);
  const auto end = [&](SqlConnection& of) {
    const auto process = of.query("SELECT pg_backend_pid()").integer(0, 0);
    other->query("SELECT pg_terminate_backend($1::integer, 60000)", {process});
  };
  const auto write = [](SqlConnection& to) {
    SqlTransaction transaction(to);
    to.query("SELECT 1");
    transaction.commit();
  };
  end(*lost);
  for (int i = 0; i < 3; ++i) EXPECT_THROW(write(*lost), StoreUnreachable) << i;
  {
    SqlTransaction transaction(*writing);
    end(*writing);
    EXPECT_THROW(writing->query("SELECT 1"), StoreUnreachable);
  }
  EXPECT_THROW(write(*writing), StoreUnreachable);
  EXPECT_NO_THROW(write(*other));
}

}  // namespace
}  // namespace palpa::record
