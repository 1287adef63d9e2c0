#include "tests/store/stores.h"

#include <cmath>
#include <fstream>

#include "apps/record/store/migrations.h"
#include "tests/support/counts.h"
#include "tests/support/damage.h"

namespace palpa::record {
namespace {

INSTANTIATE_TEST_SUITE_P(Both, Store, testing::Values("SQLite", "PostgreSQL"),
                         [](const auto& p) { return std::string(p.param); });

std::string messageOf(const std::function<void()>& action) {
  try {
    action();
  } catch (const Error& e) {
    return e.what();
  }
  return "";
}

bool says(const std::string& message, const std::string& words) {
  return message.find(words) != std::string::npos;
}

TEST_P(Store, KeepsATrialAsItWas) {
  RecordStore store(url);
  store.addTrainee(novice("T001"));
  const double odd = 0.1 + 0.2;
  EXPECT_TRUE(store.addTrial(sessionOf("T001", "u1"), trialOf(1, odd)));
  const auto trials = RecordStore(url).trials();
  ASSERT_EQ(trials.size(), 1u);
  const StoredSession& s = trials[0].session;
  const StoredTrial& t = trials[0].trial;
  EXPECT_EQ(s.trainee, "T001");
  EXPECT_EQ(s.arrival, 1);
  EXPECT_FALSE(s.simulated);
  EXPECT_EQ(t.seed, 0xfedcba9876543210u);
  EXPECT_EQ(t.end_ns, 32'524'000'000);
  EXPECT_TRUE(t.success);
  EXPECT_EQ(t.metric("total"), odd);  // to the last bit
  EXPECT_TRUE(std::isnan(t.metric("closest_artery")));
  EXPECT_EQ(t.metrics.size(), 2u);
  EXPECT_TRUE(std::isnan(t.metric("unheard of")));
  const auto events = store.events("u1", 1);
  ASSERT_EQ(events.size(), 2u);
  EXPECT_EQ(events[0].value, 1.5);
  EXPECT_EQ(events[1].text, "It's a note: ü");
  EXPECT_TRUE(std::isnan(events[1].value));
  EXPECT_EQ(store.session("u1")->calibrations.at(0).verdict, "pass");
  EXPECT_FALSE(store.session("u2"));
}

TEST_P(Store, ATrialDeliveredTwiceIsThereOnce) {
  RecordStore store(url);
  store.addTrainee(novice("T001"));
  EXPECT_TRUE(store.addTrial(sessionOf("T001", "u1"), trialOf(1, 1)));
  EXPECT_FALSE(store.addTrial(sessionOf("T001", "u1"), trialOf(1, 2)));
  EXPECT_TRUE(store.addTrial(sessionOf("T001", "u1"), trialOf(2)));
  EXPECT_TRUE(store.addTrial(sessionOf("T001", "u2"), trialOf(1)));
  const auto trials = store.trials();
  ASSERT_EQ(trials.size(), 3u);
  EXPECT_EQ(trials[0].trial.metric("total"), 1);
  EXPECT_EQ(trials[2].session.arrival, 2);
  EXPECT_EQ(store.sessions("T001").size(), 2u);
}

TEST_P(Store, OrderIsThatOfArrivalWhateverTheClockSays) {
  RecordStore store(url);
  store.addTrainee(novice("T001"));
  StoredSession late = sessionOf("T001", "u1"), jumped = sessionOf("T001", "u2");
  late.started_utc = "2031-01-01T00:00:00Z";
  jumped.started_utc = "1970-01-01T00:00:00Z";
  store.addTrial(late, trialOf(1));
  store.addTrial(jumped, trialOf(1));
  EXPECT_EQ(store.sessions("T001").at(0).uuid, "u1");
  EXPECT_EQ(store.sessions("T001").at(1).uuid, "u2");
}

TEST_P(Store, FiltersTrials) {
  RecordStore store(url);
  for (const char* id : {"A", "B"}) store.addTrainee(novice(id));
  StoredSession a = sessionOf("A", "u1"), b = sessionOf("B", "u2");
  b.simulated = true;
  b.study = "pilot";
  b.task = "search";
  store.addTrial(a, trialOf(1));
  store.addTrial(b, trialOf(1));
  EXPECT_EQ(store.trials({.trainee = "A"}).size(), 1u);
  EXPECT_EQ(store.trials({.task = "search"}).at(0).session.trainee, "B");
  EXPECT_EQ(store.trials({.study = "pilot"}).size(), 1u);
  EXPECT_EQ(store.trials({.simulated = 0}).at(0).session.uuid, "u1");
  EXPECT_EQ(store.trials({.session = "u2", .simulated = 1}).size(), 1u);
  EXPECT_TRUE(store.trials({.trainee = "A", .task = "search"}).empty());
}

TEST_P(Store, SaysWhatIsWrongWithATrainee) {
  RecordStore store(url);
  store.addTrainee(novice("T001"));
  EXPECT_TRUE(
      says(messageOf([&] { store.addTrainee(novice("T001")); }), "is in the records already"));
  EXPECT_TRUE(says(messageOf([&] { store.addTrainee(novice("Dr. Smith")); }), "pseudonym"));
  EXPECT_TRUE(
      says(messageOf([&] { store.changeTrainee(novice("T002")); }), "is not in the records"));
  EXPECT_TRUE(says(messageOf([&] { store.addTrial(sessionOf("T002", "u1"), trialOf(1)); }),
                   "palpa records trainee add"));
  store.addTrainee(novice("T002"));
  store.addTrial(sessionOf("T001", "u1"), trialOf(1));
  EXPECT_TRUE(says(messageOf([&] { store.addTrial(sessionOf("T002", "u1"), trialOf(2)); }),
                   "belongs to another trainee"));
  Trainee left = novice("T003");
  left.handedness = "both";
  EXPECT_THROW(store.addTrainee(left), UsageError);
  EXPECT_EQ(store.trials().size(), 1u);
  Trainee changed = novice("T001");
  changed.experience = "4th year";
  store.changeTrainee(changed);
  EXPECT_EQ(store.trainee("T001")->experience, "4th year");
  EXPECT_EQ(store.trainees().size(), 2u);
}

TEST_P(Store, DeletesAPersonForGood) {
  RecordStore store(url);
  for (const char* id : {"A", "B"}) store.addTrainee(novice(id));
  store.addTrial(sessionOf("A", "u1"), trialOf(1));
  store.addTrial(sessionOf("B", "u2"), trialOf(1));
  const auto evidence = store.deletePerson("A", "2026-04-01T00:00:00Z");
  ASSERT_EQ(evidence.size(), 1u);
  EXPECT_EQ(evidence[0].evidence, "/somewhere/u1/session.palpa");
  EXPECT_FALSE(store.trainee("A"));
  EXPECT_TRUE(store.trials({.trainee = "A"}).empty());
  EXPECT_TRUE(store.events("u1", 1).empty());
  EXPECT_EQ(store.trials().size(), 1u);
  EXPECT_THROW(store.addTrial(sessionOf("A", "u1"), trialOf(1)), PersonDeleted);  // a late delivery
  store.addTrainee(novice("A"));  // somebody may have this pseudonym anew
  EXPECT_THROW(store.addTrial(sessionOf("A", "u1"), trialOf(1)), PersonDeleted);
  StoredSession unknown = sessionOf("A", "u8"), later = sessionOf("A", "u9");
  later.started_utc = "2026-04-01T00:00:01Z";
  EXPECT_THROW(store.addTrial(unknown, trialOf(1)), PersonDeleted);  // from before the deletion
  EXPECT_TRUE(store.addTrial(later, trialOf(1)));
  ASSERT_EQ(store.evidenceToDelete().size(), 1u);
  store.evidenceDeleted("u1");
  EXPECT_TRUE(store.evidenceToDelete().empty());
  EXPECT_THROW(store.deletePerson("C", ""), UsageError);
}

TEST_P(Store, KnowsWhoseTimeIsOver) {
  RecordStore store(url);
  store.addTrainee(novice("A"));
  Trainee forever = novice("B");
  forever.retain_until = "";
  store.addTrainee(forever);
  EXPECT_TRUE(store.overdue("2027-03-01").empty());
  ASSERT_EQ(store.overdue("2027-03-02").size(), 1u);
  EXPECT_EQ(store.overdue("2027-03-02")[0].id, "A");
}

TEST_P(Store, RefusesANewerStoreAndLeavesItAlone) {
  { RecordStore store(url); }
  const auto connection = connect(url);
  EXPECT_EQ(schemaOf(*connection), newestSchema());
  connection->query("UPDATE palpa_schema SET version=99");
  const std::string message = messageOf([&] { RecordStore again(url); });
  EXPECT_TRUE(says(message, "newer version of Palpa (tables 99")) << message;
  EXPECT_TRUE(says(message, "Update Palpa"));
  EXPECT_EQ(connection->query("SELECT version FROM palpa_schema").integer(0, 0), 99);
}

TEST_P(Store, MigratesFromEveryVersion) {
  for (int version = 0; version <= newestSchema(); ++version) {
    const auto connection =
        connect(onServer() ? url : (folder / ("v" + std::to_string(version))).string());
    if (onServer())
      connection->query("DROP SCHEMA public CASCADE"), connection->query("CREATE SCHEMA public");
    migrate(*connection, version);
    EXPECT_EQ(schemaOf(*connection), version);
    EXPECT_EQ(migrate(*connection), version);
    EXPECT_EQ(schemaOf(*connection), newestSchema());
    for (const std::string& table : tableNames()) EXPECT_TRUE(connection->hasTable(table)) << table;
  }
}

TEST_P(Store, AFailedCallLeavesNothingHalfDone) {
  RecordStore store(url);
  store.addTrainee(novice("A"));
  StoredTrial twice = trialOf(1);
  twice.metrics = {{"total", 1}, {"total", 2}};
  EXPECT_THROW(store.addTrial(sessionOf("A", "u1"), twice), Error);
  EXPECT_TRUE(store.trials().empty());
  EXPECT_TRUE(store.sessions().empty());
  EXPECT_TRUE(store.addTrial(sessionOf("A", "u1"), trialOf(1)));  // the connection still serves
}

TEST(Addresses, AreToldApart) {
  EXPECT_TRUE(isServer("postgresql://me@host/db"));
  EXPECT_FALSE(isServer("/home/me/records.sqlite"));
  const std::string secret = messageOf([] { connect("postgresql://me:geheim@host/db"); });
  EXPECT_TRUE(says(secret, "PGPASSWORD")) << secret;
  EXPECT_FALSE(says(secret, "geheim"));
  EXPECT_FALSE(says(messageOf([] { connect("postgresql://host/db?password=geheim"); }), "geheim"));
  EXPECT_TRUE(says(messageOf([] { connect("mysql://host/db"); }), "neither a file nor"));
  EXPECT_THROW(connect(""), UsageError);
  EXPECT_TRUE(says(messageOf([] { connect("/no/such/folder/records.sqlite"); }),
                   "its folder does not exist"));
}

TEST(DamagedFile, IsNamedAndLeftAlone) {
  const auto folder = test::freshFolder("store", "damaged");
  const std::string file = (folder / "records.sqlite").string();
  std::ofstream(file) << "this is no database, but long enough";
  EXPECT_TRUE(says(messageOf([&] { RecordStore store(file); }), "is not a records file"));
  std::filesystem::remove(file);
  {
    RecordStore store(file);
    store.addTrainee(novice("A"));
    for (int i = 1; i <= 200; ++i) store.addTrial(sessionOf("A", "u1"), trialOf(i));
  }
  {  // the middle of the file, a page long
    std::fstream stream(file, std::ios::in | std::ios::out | std::ios::binary);
    stream.seekp(static_cast<std::streamoff>(std::filesystem::file_size(file) / 2 / 4096 * 4096));
    stream << std::string(4096, '\x55');
  }
  const auto size = std::filesystem::file_size(file);
  const std::string message = messageOf([&] { RecordStore store(file); });
  EXPECT_TRUE(says(message, "damaged") || says(message, "malformed")) << message;
  EXPECT_EQ(std::filesystem::file_size(file), size);
}

/// A flipped byte within a text may go unseen, one in the file's structure may not; a file that was
/// cut never does. What is refused stays as it is.
TEST(DamagedFile, FlippedBytesAndCutsAreNamed) {
  const auto folder = test::freshFolder("store", "flipped");
  const std::string whole = (folder / "whole.sqlite").string(),
                    file = (folder / "records.sqlite").string();
  {
    RecordStore store(whole);
    store.addTrainee(novice("A"));
    for (int i = 1; i <= 40; ++i) store.addTrial(sessionOf("A", "u1"), trialOf(i));
  }
  const std::string bytes = test::slurp(whole);
  test::DamageDice dice(5);
  int named = 0;
  const int rounds = test::counted(80, 3000);
  for (int i = 0; i < rounds; ++i) {
    std::string damaged = bytes;
    const bool cut = i % 4 == 0;
    if (cut)
      damaged.resize(1 + dice.below(bytes.size() - 1));
    else
      damaged[dice.below(bytes.size())] ^= static_cast<char>(1 + dice.below(255));
    for (const char* beside : {"", "-wal", "-shm"}) std::filesystem::remove(file + beside);
    std::ofstream(file, std::ios::binary) << damaged;
    try {
      RecordStore store(file);
      for (const TrialWithSession& t : store.trials()) store.events(t.session.uuid, t.trial.number);
      EXPECT_FALSE(cut) << damaged.size();
    } catch (const Error& e) {
      test::expectClearWord(e, "records file " + file);
      EXPECT_EQ(test::slurp(file), damaged) << e.what();
      ++named;
    }
  }
  EXPECT_GT(named, rounds / 4);
}

TEST(Server, SaysWhyItRefuses) {
  if (const std::string why = test::PostgresServer::whyNot(); !why.empty()) GTEST_SKIP() << why;
  test::PostgresServer server;
  const std::string right = std::getenv("PGPASSWORD");
  ::setenv("PGPASSWORD", "wrong", 1);
  const std::string refused = messageOf([&] { connect(server.url()); });
  EXPECT_TRUE(says(refused, "Check user and password")) << refused;
  ::setenv("PGPASSWORD", right.c_str(), 1);
  const std::string no_database = messageOf([&] { connect(server.url("palpa", "nowhere")); });
  EXPECT_TRUE(says(no_database, "Ask whoever runs the server")) << no_database;
  server.kill();
  EXPECT_THROW(connect(server.url()), StoreUnreachable);
}

}  // namespace
}  // namespace palpa::record
