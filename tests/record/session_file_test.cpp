#include "apps/record/session_file.h"

#include <gtest/gtest.h>
#include <sqlite3.h>
#include <sys/stat.h>

#include <limits>

#include "synthetic_session.h"

namespace palpa::record {
namespace {

using namespace test;
namespace fs = std::filesystem;

TEST(SessionFile, GivesBackEveryBit) {
  const fs::path file = freshFolder("round_trip") / "session.palpa";
  SessionInfo info = syntheticInfo();
  {
    SessionWriter writer(file, info);
    writeTrial(writer, 1234);  // the last chunk is a partial one
    writer.close();
  }
  const SessionReader reader(file);
  EXPECT_EQ(reader.info().patient_glb, info.patient_glb);
  EXPECT_EQ(bits(reader.info().tick_config), bits(info.tick_config));

  std::int64_t ticks = 0;
  reader.ticks([&](const haptics::FlightRecord& record) {
    ASSERT_EQ(bits(record), bits(syntheticTick(ticks))) << "tick " << ticks;
    ++ticks;
  });
  EXPECT_EQ(ticks, 1234);
  std::uint64_t snapshots = 0;
  reader.snapshots([&](const LocalGeometry& geometry) {
    ASSERT_EQ(bits(geometry), bits(syntheticSnapshot(++snapshots)));
  });
  EXPECT_EQ(snapshots, 78u);  // every 16 ticks from 0
  std::int64_t keyframes = 0;
  reader.keyframes([&](std::int64_t tick, const haptics::TickState& state) {
    EXPECT_EQ(tick, 200 * keyframes++);
    ASSERT_EQ(bits(state), bits(syntheticState(tick)));
  });
  EXPECT_EQ(keyframes, 7);
}

TEST(SessionFile, GivesBackTrialsAndEvents) {
  const fs::path file = freshFolder("trials") / "session.palpa";
  const double nan = std::numeric_limits<double>::quiet_NaN();
  {
    SessionWriter writer(file, syntheticInfo());
    writer.event({1, 0, "note", "", nan});
    writeTrial(writer, 10);
    writer.beginTrial({2, 99, 5, "familiarisation", false, 1.25});
  }
  const SessionReader reader(file);
  const auto trials = reader.trials();
  ASSERT_EQ(trials.size(), 2u);
  EXPECT_EQ(trials[0].header.seed, 0xfedcba9876543210u);
  EXPECT_TRUE(trials[0].ended);
  EXPECT_EQ(trials[0].end.scores_json, R"({"TOTAL": 12.5})");
  EXPECT_FALSE(trials[1].ended);
  EXPECT_FALSE(trials[1].header.force_feedback);
  EXPECT_EQ(trials[1].header.role, "familiarisation");
  const auto events = reader.events();
  ASSERT_EQ(events.size(), 3u);
  EXPECT_TRUE(std::isnan(events[0].value));
  EXPECT_EQ(events[2].text, "Blood was aspirated — good");
}

TEST(SessionFile, ClosedSessionIsOnePlainFileThatNamesItself) {
  const fs::path folder = freshFolder("closed");
  const fs::path file = folder / "session.palpa";
  SessionWriter writer(file, syntheticInfo());
  writeTrial(writer, 400);
  EXPECT_TRUE(fs::exists(file.string() + "-wal"));
  writer.close();
  writer.close();  // twice is harmless
  EXPECT_EQ(std::distance(fs::directory_iterator(folder), fs::directory_iterator()), 1);
  { SessionReader(file).trials(); }
  EXPECT_EQ(std::distance(fs::directory_iterator(folder), fs::directory_iterator()), 1);
  EXPECT_THROW(writer.commit(), Error);

  sqlite3* db = nullptr;
  ASSERT_EQ(sqlite3_open(file.c_str(), &db), SQLITE_OK);
  const auto pragma = [&](const char* sql) {
    sqlite3_stmt* statement = nullptr;
    EXPECT_EQ(sqlite3_prepare_v2(db, sql, -1, &statement, nullptr), SQLITE_OK);
    EXPECT_EQ(sqlite3_step(statement), SQLITE_ROW);
    const int value = sqlite3_column_int(statement, 0);
    sqlite3_finalize(statement);
    return value;
  };
  EXPECT_EQ(pragma("PRAGMA application_id"), 0x70616c70);
  EXPECT_EQ(pragma("PRAGMA user_version"), 1);
  EXPECT_EQ(pragma("SELECT count(*) FROM ticks"), 2);
  sqlite3_close(db);
}

/// The process stopped in the middle of the second trial.
TEST(SessionFile, ATrialThatDidNotEndLastsUntilItsLastTick) {
  const fs::path file = freshFolder("unended") / "session.palpa";
  SessionWriter writer(file, syntheticInfo());
  writer.beginTrial({1, 0, 1, "scored", true, 1.7});
  writer.endTrial({1, 90'000'000, "success", "", ""});
  writer.beginTrial({2, 100'000'000, 2, "scored", true, 1.7});
  writer.commit();
  const auto length_s = [&] { return SessionReader(file).trials().at(1).length_s(); };
  EXPECT_EQ(length_s(), 0) << "no tick yet: it has just begun";
  writeTicks(writer, 0, 400);
  EXPECT_NEAR(length_s(), 0.299, 1e-12);
  EXPECT_NEAR(SessionReader(file).trials().at(0).length_s(), 0.09, 1e-12);
}

TEST(SessionFile, IsItsOwnersAlone) {
  const fs::path file = freshFolder("private") / "session.palpa";
  const mode_t mask = ::umask(022);
  SessionWriter writer(file, syntheticInfo());
  writeTicks(writer, 0, 400);
  ::umask(mask);
  for (const char* beside : {"", "-wal", "-shm"})
    EXPECT_EQ(fs::status(file.string() + beside).permissions(),
              fs::perms::owner_read | fs::perms::owner_write)
        << beside;
}

TEST(SessionFile, CanBeReadWhileItIsWritten) {
  const fs::path file = freshFolder("live") / "session.palpa";
  SessionWriter writer(file, syntheticInfo());
  writeTicks(writer, 0, 400);
  const SessionReader reader(file);
  std::int64_t ticks = 0;
  reader.ticks([&](const haptics::FlightRecord&) { ++ticks; });
  EXPECT_EQ(ticks, 400);
  writeTicks(writer, 400, 600);
  ticks = 0;
  reader.ticks([&](const haptics::FlightRecord&) { ++ticks; });
  EXPECT_EQ(ticks, 600);
  EXPECT_NO_THROW(writer.close());  // with the reader still there
}

TEST(SessionFile, KeepsTwoHundredTicksAtMostToItself) {
  const fs::path file = freshFolder("own_commit") / "session.palpa";
  SessionWriter writer(file, syntheticInfo());
  for (std::int64_t tick = 0; tick < 200; ++tick) writer.tick(syntheticTick(tick));
  std::int64_t ticks = 0;
  SessionReader(file).ticks([&](const haptics::FlightRecord&) { ++ticks; });
  EXPECT_EQ(ticks, 200);  // nobody has called commit
}

TEST(SessionFile, MakesAUuidWhenNoneIsGiven) {
  const fs::path folder = freshFolder("uuid");
  SessionInfo info = syntheticInfo();
  info.uuid.clear();
  { SessionWriter(folder / "a.palpa", info), SessionWriter(folder / "b.palpa", info); }
  const std::string a = SessionReader(folder / "a.palpa").info().uuid;
  EXPECT_EQ(a.size(), 36u);
  EXPECT_EQ(a[14], '4');
  EXPECT_NE(a, SessionReader(folder / "b.palpa").info().uuid);
}

TEST(SessionFile, NeverOverwritesEvidence) {
  const fs::path file = freshFolder("twice") / "session.palpa";
  { SessionWriter writer(file, syntheticInfo()); }
  const auto size = fs::file_size(file);
  EXPECT_THROW(SessionWriter(file, syntheticInfo()), Error);
  EXPECT_EQ(fs::file_size(file), size);
}

TEST(SessionFile, RefusesWhatContradictsItself) {
  SessionWriter writer(freshFolder("order") / "session.palpa", syntheticInfo());
  writer.tick(syntheticTick(5));
  EXPECT_THROW(writer.tick(syntheticTick(5)), Error);
  writer.snapshot(syntheticSnapshot(3));
  EXPECT_NO_THROW(writer.snapshot(syntheticSnapshot(3)));
  EXPECT_THROW(writer.snapshot(syntheticSnapshot(2)), Error);
  EXPECT_THROW(writer.endTrial({1, 0, "success", "", ""}), Error);
  writer.beginTrial({1, 0, 0, "scored", true, 1});
  EXPECT_THROW(writer.beginTrial({1, 0, 0, "scored", true, 1}), Error);
  EXPECT_NO_THROW(writer.close());  // none of it stands in the way of the rest
}

haptics::FlightRecord ofTool(std::int64_t tick, std::uint8_t tool) {
  haptics::FlightRecord record = syntheticTick(tick);
  record.tool = tool;
  record.indentation = 0.001 * tool;
  return record;
}

/// A tick's two records stay together, however it is committed, and come back in order.
TEST(SessionFile, TwoDevicesAreTwoRecordsATick) {
  const fs::path file = freshFolder("pairs") / "session.palpa";
  SessionInfo info = syntheticInfo();
  info.pair_config.emplace();
  info.pair_config->squeezing = 1;
  constexpr std::int64_t kTicks = 431;
  {
    SessionWriter writer(file, info);
    for (std::int64_t tick = 0; tick < kTicks; ++tick) {
      writer.tick(ofTool(tick, 0));
      if (tick % 7 == 3) writer.commit();  // in the middle of a tick
      writer.tick(ofTool(tick, 1));
    }
    EXPECT_THROW(writer.tick(ofTool(kTicks - 1, 0)), Error) << "that was";
    writer.close();
  }
  const SessionReader reader(file);
  ASSERT_TRUE(reader.info().pair_config);
  EXPECT_EQ(bits(*reader.info().pair_config), bits(*info.pair_config));
  std::int64_t count = 0;
  reader.ticks([&](const haptics::FlightRecord& record) {
    ASSERT_EQ(bits(record), bits(ofTool(count / 2, static_cast<std::uint8_t>(count % 2)))) << count;
    ++count;
  });
  EXPECT_EQ(count, 2 * kTicks);
}

/// The last tick of a process that was stopped between its two halves is not lost either.
TEST(SessionFile, HalfATickAtTheEndIsKept) {
  const fs::path file = freshFolder("half") / "session.palpa";
  SessionInfo info = syntheticInfo();
  info.pair_config.emplace();
  {
    SessionWriter writer(file, info);
    writer.tick(ofTool(0, 0));
    writer.commit();
    writer.close();
  }
  std::int64_t count = 0;
  SessionReader(file).ticks([&](const haptics::FlightRecord&) { ++count; });
  EXPECT_EQ(count, 1);
}

}  // namespace
}  // namespace palpa::record
