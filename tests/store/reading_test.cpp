#include "apps/record/store/record_reading.h"

#include <malloc.h>

#include <cmath>
#include <set>

#include "apps/record/store/migrations.h"
#include "tests/store/stores.h"

/// Records read row by row.
namespace palpa::record {
namespace {

class Reading : public Store {};

INSTANTIATE_TEST_SUITE_P(Both, Reading, testing::Values("SQLite", "PostgreSQL"),
                         [](const auto& p) { return std::string(p.param); });

/// `count` trials of a session; `words` in each.
std::vector<StoredTrial> drawn(int count, const std::string& words = "") {
  std::vector<StoredTrial> all;
  for (int i = 1; i <= count; ++i) {
    all.push_back(trialOf(i, 0.1 * i));
    all.back().reason = words;
    all.back().events.resize(1);
  }
  return all;
}

/// More rows than a server sends at once, every kind of value, other requests between them.
TEST_P(Reading, ACursorGivesTheRowsOfAQuery) {
  RecordStore store(url);
  store.addTrainee(novice("A"));
  EXPECT_EQ(store.addTrials(sessionOf("A", "u1"), drawn(1204)), 1204);
  SqlConnection& connection = store.connection();
  const std::string sql =
      "SELECT e.session,e.number,e.value,e.text,t.seed FROM trials t LEFT JOIN events e ON "
      "e.session=t.session AND e.number=t.number AND e.number<>$1 WHERE t.number>$2 ORDER BY "
      "t.number";
  const std::vector<SqlValue> values{std::int64_t{7}, std::int64_t{3}};
  const SqlRows rows = connection.query(sql, values);
  ASSERT_EQ(rows.size(), 1201u);
  const SqlTransaction moment(connection, Access::read);
  const auto cursor = connection.cursor(sql, values);
  for (std::size_t i = 0; i < rows.size(); ++i) {
    ASSERT_TRUE(cursor->next()) << i;
    EXPECT_EQ(cursor->row(), rows.row(i));
    EXPECT_EQ(cursor->text(0), rows.text(i, 0));
    EXPECT_EQ(cursor->integer(1), rows.integer(i, 1));
    EXPECT_EQ(std::isnan(cursor->real(2)), std::isnan(rows.real(i, 2)));
    if (i % 100 == 0) {
      EXPECT_EQ(connection.query("SELECT 1").size(), 1u);
    }
  }
  EXPECT_FALSE(cursor->next());
}

TEST_P(Reading, TrialsComeInTheirOrderWithTheirSessions) {
  RecordStore store(url);
  for (const char* id : {"B", "A"}) store.addTrainee(novice(id));
  store.addTrials(sessionOf("B", "u3"), drawn(2));
  store.addTrials(sessionOf("A", "u2"), drawn(3));
  store.addTrials(sessionOf("A", "u1"), drawn(11));
  StoredSession none = sessionOf("A", "u0");
  store.addTrials(none, {});
  std::vector<std::string> seen;
  const TrialWithSession* held = nullptr;
  store.eachTrial({}, [&](const TrialWithSession& t) {
    EXPECT_TRUE(!held || held == &t);  // one is held at a time
    held = &t;
    EXPECT_EQ(t.trial.metric("total"), 0.1 * static_cast<double>(t.trial.number));
    EXPECT_EQ(t.session.facts_json, none.facts_json);
    seen.push_back(t.session.trainee + std::to_string(t.session.arrival) + '/' +
                   std::to_string(t.trial.number));
  });
  std::vector<std::string> should{"A1/1", "A1/2", "A1/3"};
  for (int i = 1; i <= 11; ++i) should.push_back("A2/" + std::to_string(i));
  should.insert(should.end(), {"B1/1", "B1/2"});
  EXPECT_EQ(seen, should);

  std::vector<std::string> sessions;
  std::size_t events = 0;
  const SqlTransaction moment(store.connection(), Access::read);
  eachSession(store.connection(), {}, [&](const StoredSession& s) {
    sessions.push_back(s.uuid);
    EXPECT_EQ(s.calibrations.size(), 1u);
  });
  EXPECT_EQ(sessions, (std::vector<std::string>{"u2", "u1", "u0", "u3"}));
  eachEvent(store.connection(), {.trainee = "A"}, [&](const TrialEvent& e) {
    ++events;
    EXPECT_EQ(e.trainee, "A");
    EXPECT_EQ(e.event.kind, "puncture");
  });
  EXPECT_EQ(events, 14u);
}

TEST_P(Reading, CountsWithoutReadingTrials) {
  RecordStore store(url);
  for (const char* id : {"A", "B", "C"}) store.addTrainee(novice(id));
  store.addTrials(sessionOf("A", "u1"), drawn(3));
  store.addTrials(sessionOf("A", "u2"), {});
  store.addTrials(sessionOf("B", "u3"), drawn(2));
  const std::vector<Tally> all = store.tallies();
  ASSERT_EQ(all.size(), 2u);
  EXPECT_EQ(all[0].sessions, 2);
  EXPECT_EQ(all[0].trials, 3);
  ASSERT_EQ(store.tallies("B").size(), 1u);
  EXPECT_EQ(store.tallies("B")[0].trials, 2);
  EXPECT_EQ(metricNames(store.connection(), {}),
            (std::vector<std::string>{"closest_artery", "total"}));
}

/// Whoever reads sees one moment and keeps nobody from writing.
TEST_P(Reading, IsOfOneMomentWhileAnotherStationWrites) {
  RecordStore reader(url), writer(url);
  writer.addTrainee(novice("A"));
  writer.addTrials(sessionOf("A", "u1"), drawn(1500));
  int seen = 0;
  reader.eachTrial({}, [&](const TrialWithSession&) {
    if (++seen == 1) {
      EXPECT_TRUE(writer.addTrial(sessionOf("A", "u1"), trialOf(1501)));
    }
  });
  EXPECT_EQ(seen, 1500);
  EXPECT_EQ(reader.trials().size(), 1501u);
}

/// 32 MB of trials pass through a tenth of that, a thousand at a time through three quarters.
/// (Memory that is in use, by the allocator's own count.)
TEST_P(Reading, HoldsNoMoreThanItShows) {
  constexpr int kTrials = 2000;
  RecordStore store(url);
  store.addTrainee(novice("A"));
  for (int s = 0; s < 4; ++s)
    store.addTrials(sessionOf("A", "u" + std::to_string(s)),
                    drawn(kTrials / 4, std::string(16'000, 'x')));
  const auto before = static_cast<double>(::mallinfo2().uordblks + ::mallinfo2().hblkhd);
  double most = 0;
  int seen = 0;
  store.eachTrial({}, [&](const TrialWithSession& t) {
    seen += t.trial.reason.size() == 16'000 ? 1 : 0;
    const auto now = static_cast<double>(::mallinfo2().uordblks + ::mallinfo2().hblkhd);
    most = std::max(most, now - before);
  });
  EXPECT_EQ(seen, kTrials);
  EXPECT_LT(most, onServer() ? 24e6 : 3.2e6);
}

/// Each metric had a row of its own up to version 4.
TEST_P(Reading, MetricsOfOlderTablesComeAlong) {
  const double odd = 0.1 + 0.2, nothing = std::nan("");
  {
    const auto connection = connect(url);
    migrate(*connection, 4);
    SqlTransaction all(*connection);
    connection->query("INSERT INTO trainees VALUES('A','novice','','right','2026-03-01','','','')");
    connection->query(
        "INSERT INTO sessions VALUES('u1','A',1,'2026-03-01','palpa','search','bench',0,'',0,'',"
        "'','{}')");
    for (int n = 1; n <= 4; ++n)
      connection->query("INSERT INTO trials VALUES('u1',$1,0,1,'scored','1',1,'success','',1,'')",
                        {std::int64_t{n}});
    for (const auto& [number, name, value] :
         {std::tuple{1, "total", odd}, std::tuple{1, "success", nothing},
          std::tuple{1, "peak_force_N", -1.5e-300}, std::tuple{3, "total", 1e22},
          std::tuple{3, "Chosen", 1.0}, std::tuple{4, "Chosen", 0.0}, std::tuple{4, "total", -0.0}})
      connection->query("INSERT INTO metrics VALUES('u1',$1,$2,$3)",
                        {std::int64_t{number}, std::string(name), value});
    all.commit();
  }
  RecordStore store(url);
  const auto trials = store.trials();
  ASSERT_EQ(trials.size(), 4u);
  EXPECT_EQ(trials[0].trial.metrics.size(), 3u);
  EXPECT_EQ(trials[0].trial.metric("total"), odd);  // to the last bit
  EXPECT_EQ(trials[0].trial.metric("peak_force_N"), -1.5e-300);
  EXPECT_TRUE(std::isnan(trials[0].trial.metric("success")));
  EXPECT_TRUE(trials[1].trial.metrics.empty());
  EXPECT_EQ(trials[2].trial.metric("total"), 1e22);
  EXPECT_EQ(trials[3].trial.metric("Chosen"), 0);
  EXPECT_EQ(trials[3].trial.metric("total"), 0);
  EXPECT_FALSE(store.connection().hasTable("metrics"));
  EXPECT_EQ(store.connection().query("SELECT 1 FROM metric_sets").size(), 2u);
}

TEST(Metrics, ArePackedInTheOrderOfTheirNamesOrRefused) {
  const PackedMetrics all = packed({{"time_s", 20.5}, {"a", std::nan("")}, {"lung", 0}});
  EXPECT_EQ(all.names, "a,lung,time_s");
  EXPECT_EQ(all.values, ",0,20.5");
  EXPECT_EQ(packed({{"a", -0.0}, {"b", 0.1 + 0.2}}).values, "-0,0.30000000000000004");
  EXPECT_EQ(packed({{"lung", 1}, {"time_s", 2}, {"a", 3}}).set, all.set);
  EXPECT_TRUE(packed({}).set.empty());
  EXPECT_THROW(packed({{"a", 1}, {"a", 2}}), Error);
  EXPECT_THROW(packed({{"a,b", 1}}), Error);
  EXPECT_THROW(packed({{"", 1}}), Error);
}

TEST(Metrics, ThatDoNotFitTheirNamesAreDamage) {
  const auto folder = test::freshFolder("store", "packed");
  RecordStore store((folder / "records.sqlite").string());
  store.addTrainee(novice("A"));
  store.addTrial(sessionOf("A", "u1"), trialOf(1, 5));
  for (const char* damaged : {"", "1", ",1,2", ",one", ",1x"}) {
    store.connection().query("UPDATE trials SET metric_values=$1", {std::string(damaged)});
    EXPECT_THROW(store.trials(), Error) << damaged;
  }
  store.connection().query("UPDATE trials SET metric_values=',5'");
  EXPECT_EQ(store.trials().at(0).trial.metric("total"), 5);
  store.connection().query("UPDATE trials SET metric_set='unheard of'");
  EXPECT_THROW(store.trials(), Error);
}

TEST(Metrics, ChosenOnesStandInTheirOrder) {
  MetricColumns columns({"time_s", "total", "nothing"});
  EXPECT_EQ(columns.of({{"total", 1}, {"time_s", 2}})[0], 2);
  const std::vector<double> other = columns.of({{"a", 5}, {"b", 6}, {"total", 7}});
  EXPECT_TRUE(std::isnan(other[0]));
  EXPECT_EQ(other[1], 7);
  EXPECT_TRUE(std::isnan(other[2]));
  EXPECT_TRUE(std::isnan(columns.of({})[1]));
}

}  // namespace
}  // namespace palpa::record
