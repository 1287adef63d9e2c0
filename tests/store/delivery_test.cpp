// Many stations, killed programs, a server that goes away: no trial lost, none twice.
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <set>

#include "apps/record/store/delivery.h"
#include "apps/record/store/pending.h"
#include "apps/runtime/clock.h"
#include "tests/store/stores.h"

namespace palpa::record {
namespace {

void rest(std::int64_t milliseconds) { runtime::SteadyClock().sleepUntil(milliseconds * runtime::kMillisecond); }

constexpr int kStations = 8, kTrialsEach = 25;
constexpr Patience kPatient{2000, 20 * runtime::kMillisecond};

class Delivery : public Store {
 protected:
  void SetUp() override {
    Store::SetUp();
    if (IsSkipped()) return;
    RecordStore store(url);
    for (int s = 0; s < kStations; ++s) store.addTrainee(novice("T" + std::to_string(s)));
  }

  static std::vector<StoredTrial> trials() {
    std::vector<StoredTrial> all;
    for (int i = 1; i <= kTrialsEach; ++i) all.push_back(trialOf(i, i));
    return all;
  }

  /// A process of its own that delivers the session of a station; `slowly`: with a pause after each trial, so that something can happen in between.
  pid_t station(int number, bool slowly) const {
    const pid_t child = ::fork();
    if (child != 0) return child;
    int code = 1;
    try {
      const StoredSession session = sessionOf("T" + std::to_string(number), "session-" + std::to_string(number));
      for (const StoredTrial& trial : trials()) {
        deliver(url, session, {trial}, kPatient);
        if (slowly) rest(10);
      }
      code = 0;
    } catch (const std::exception& e) {
      std::fprintf(stderr, "station %d: %s\n", number, e.what());
    }
    ::_exit(code);
  }

  static void expectDone(pid_t child) {
    int status = 0;
    ASSERT_EQ(::waitpid(child, &status, 0), child);
    EXPECT_TRUE(WIFEXITED(status) && WEXITSTATUS(status) == 0) << status;
  }

  void expectAllOnce() const {
    const auto all = RecordStore(url).trials();
    EXPECT_EQ(all.size(), static_cast<std::size_t>(kStations * kTrialsEach));
    std::set<std::pair<std::string, std::int64_t>> seen;
    for (const TrialWithSession& t : all) {
      EXPECT_TRUE(seen.insert({t.session.uuid, t.trial.number}).second);
      EXPECT_EQ(t.trial.metric("total"), static_cast<double>(t.trial.number));
      EXPECT_EQ(t.trial.metrics.size(), 2u);
    }
    EXPECT_EQ(RecordStore(url).events("session-3", 7).size(), 2u);
  }
};

INSTANTIATE_TEST_SUITE_P(Both, Delivery, testing::Values("SQLite", "PostgreSQL"), [](const auto& p) { return std::string(p.param); });

/// What only a server can do.
class ServerDelivery : public Delivery {};
INSTANTIATE_TEST_SUITE_P(Server, ServerDelivery, testing::Values("PostgreSQL"), [](const auto& p) { return std::string(p.param); });

TEST_P(Delivery, EightStationsAtOnce) {
  std::vector<pid_t> stations;
  for (int s = 0; s < kStations; ++s) stations.push_back(station(s, false));
  for (const pid_t child : stations) expectDone(child);
  expectAllOnce();
}

TEST_P(Delivery, EightStationsOnAStoreThatNobodyMadeYet) {
  const std::string fresh = onServer() ? server->freshDatabase() : (folder / "fresh.sqlite").string();
  std::vector<pid_t> stations;
  for (int s = 0; s < kStations; ++s) {
    const pid_t child = ::fork();
    if (child == 0) {
      int code = 1;
      try {
        RecordStore(fresh).addTrainee(novice("T" + std::to_string(s)));
        code = 0;
      } catch (const std::exception& e) {
        std::fprintf(stderr, "station %d: %s\n", s, e.what());
      }
      ::_exit(code);
    }
    stations.push_back(child);
  }
  for (const pid_t child : stations) expectDone(child);
  EXPECT_EQ(RecordStore(fresh).trainees().size(), static_cast<std::size_t>(kStations));
}

TEST_P(Delivery, KilledWritersAreMadeUpFor) {
  std::vector<pid_t> stations;
  for (int s = 0; s < kStations; ++s) stations.push_back(station(s, true));
  rest(200);
  for (int s = 0; s < kStations; ++s) {
    ::kill(stations[static_cast<std::size_t>(s)], SIGKILL);
    rest(7);   // each at another moment
  }
  for (const pid_t child : stations) ::waitpid(child, nullptr, 0);
  EXPECT_LT(RecordStore(url).trials().size(), static_cast<std::size_t>(kStations * kTrialsEach));
  for (int s = 0; s < kStations; ++s) expectDone(station(s, false));   // started again
  expectAllOnce();
}

TEST_P(ServerDelivery, TheServerIsKilledAndComesBack) {
  std::vector<pid_t> stations;
  for (int s = 0; s < kStations; ++s) stations.push_back(station(s, true));
  rest(150);
  server->kill();
  rest(300);
  server->start();
  for (const pid_t child : stations) expectDone(child);
  expectAllOnce();
}

TEST_P(ServerDelivery, GivesUpInTheEndAndSaysThatNothingIsLost) {
  server->kill();
  try {
    deliver(url, sessionOf("T0", "session-0"), trials(), {2, runtime::kMillisecond});
    ADD_FAILURE() << "delivered to nobody";
  } catch (const StoreUnreachable& e) {
    EXPECT_NE(std::string(e.what()).find("kept on this station and sent later"), std::string::npos) << e.what();
  }
  server->start();
  EXPECT_EQ(deliver(url, sessionOf("T0", "session-0"), trials()).added, kTrialsEach);
  EXPECT_EQ(deliver(url, sessionOf("T0", "session-0"), trials()).present, kTrialsEach);
}

TEST(Pending, OutlivesTheProcess) {
  const auto folder = test::freshFolder("store", "pending") / "deep/pending";
  EXPECT_TRUE(PendingList(folder).sessions().empty());
  PendingList(folder).note({"b", "/x/b/session.palpa", "postgresql://host/db"});
  PendingList(folder).note({"a", "/x/a/session.palpa", "/r.sqlite"});
  PendingList(folder).note({"a", "/x/a/session.palpa", "/r.sqlite"});
  std::ofstream(folder / "torn.pending") << "";
  std::ofstream(folder / "other.txt") << "x\ny\n";
  const auto sessions = PendingList(folder).sessions();
  ASSERT_EQ(sessions.size(), 2u);
  EXPECT_EQ(sessions[0].uuid, "a");
  EXPECT_EQ(sessions[1].url, "postgresql://host/db");
  PendingList(folder).forget("a");
  PendingList(folder).forget("never noted");
  EXPECT_EQ(PendingList(folder).sessions().size(), 1u);
}

}  // namespace
}  // namespace palpa::record
