#include <gtest/gtest.h>
#include <sqlite3.h>
#include <sys/resource.h>

#include <csignal>
#include <fstream>

#include "apps/record/record_codec.h"
#include "synthetic_session.h"

namespace palpa::record {
namespace {

using namespace test;
namespace fs = std::filesystem;

void spill(const fs::path& file, const std::string& bytes) {
  std::ofstream(file, std::ios::binary) << bytes;
}

/// What a reader says: everything, or "" and the words of the error.
std::string readAll(const fs::path& file, std::string* words = nullptr) {
  try {
    return everything(SessionReader(file));
  } catch (const Error& error) {
    if (words) *words = error.what();
    return "";
  }
}

std::string wholeSession(const fs::path& file) {
  SessionWriter writer(file, syntheticInfo());
  writeTrial(writer, 900);
  writer.close();
  return slurp(file);
}

TEST(Damage, WordsNameTheFile) {
  const fs::path folder = freshFolder("not_a_session");
  spill(folder / "empty.palpa", "");
  spill(folder / "text.palpa", "Dear professor, this is a letter and no session at all.\n");
  spill(folder / "short.palpa", "SQLite");
  for (const char* name : {"empty.palpa", "text.palpa", "short.palpa", "missing.palpa"}) {
    std::string words;
    EXPECT_EQ(readAll(folder / name, &words), "");
    EXPECT_NE(words.find(name), std::string::npos) << words;
  }
  EXPECT_THROW(SessionReader{folder}, Error);
}

TEST(Damage, FileCutShortIsAnError) {
  const fs::path folder = freshFolder("cut");
  const std::string whole = wholeSession(folder / "session.palpa");
  for (int tenth = 0; tenth < 10; ++tenth) {
    spill(folder / "cut.palpa", whole.substr(0, whole.size() * tenth / 10));
    EXPECT_EQ(readAll(folder / "cut.palpa"), "") << tenth << "/10 of the file";
  }
}

/// The law of the row checksums: after any flipped bit, an error or exactly the same evidence.
TEST(Damage, FlippedBitIsAnErrorOrHarmless) {
  const fs::path folder = freshFolder("flip");
  const std::string whole = wholeSession(folder / "session.palpa");
  const std::string truth = readAll(folder / "session.palpa");
  ASSERT_FALSE(truth.empty());
  int errors = 0;
  for (std::uint64_t k = 0; k < 400; ++k) {
    std::string flipped = whole;
    // Half of them among the first two pages: header and schema.
    const std::uint64_t range = k % 2 ? whole.size() : 8192;
    flipped[splitMix64(2 * k) % range] ^= static_cast<char>(1u << splitMix64(2 * k + 1) % 8);
    const fs::path file = folder / "flipped.palpa";
    spill(file, flipped);
    const std::string read = readAll(file);
    ASSERT_TRUE(read.empty() || read == truth) << "flip " << k;
    errors += read.empty();
    fs::remove(file.string() + "-wal");
    fs::remove(file.string() + "-shm");
  }
  EXPECT_GT(errors, 100);  // most bits of the data matter
}

void alter(const fs::path& file, const std::string& sql) {
  sqlite3* db = nullptr;
  ASSERT_EQ(sqlite3_open(file.c_str(), &db), SQLITE_OK);
  char* words = nullptr;
  ASSERT_EQ(sqlite3_exec(db, sql.c_str(), nullptr, nullptr, &words), SQLITE_OK) << words;
  sqlite3_close(db);
}

TEST(Damage, ErrorNamesTableAndRow) {
  const fs::path folder = freshFolder("row");
  const std::string whole = wholeSession(folder / "session.palpa");
  const std::pair<const char*, const char*> cases[] = {
      {"UPDATE ticks SET blob=zeroblob(40) WHERE first_tick=200", "table ticks, row 200"},
      {"UPDATE ticks SET count=100 WHERE first_tick=400", "table ticks, row 400"},
      {"UPDATE snapshots SET blob=x'00' WHERE number=3", "table snapshots, row 3"},
      {"UPDATE keyframes SET tick=7 WHERE tick=200", "table keyframes, row 7"},
      {"UPDATE trials SET outcome='aborted'", "table trials, row 1"},
      {"UPDATE events SET text='' WHERE id=2", "table events, row 2"},
      {"UPDATE meta SET value='' WHERE key='uuid'", "table meta, row uuid"},
      {"PRAGMA user_version=2", "newer version"},
      {"PRAGMA application_id=1", "another program"}};
  for (const auto& [sql, expected] : cases) {
    const fs::path file = folder / "altered.palpa";
    spill(file, whole);
    alter(file, sql);
    std::string words;
    EXPECT_EQ(readAll(file, &words), "") << sql;
    EXPECT_NE(words.find(expected), std::string::npos) << words;
  }
}

TEST(Damage, OtherLayoutIsRefusedWithItsName) {
  const fs::path file = freshFolder("layout") / "session.palpa";
  wholeSession(file);
  const std::int64_t sum =
      rowChecksum(std::string_view("layout"), std::string_view("layout 0, big-endian"));
  alter(file, "UPDATE meta SET value='layout 0, big-endian', crc=" + std::to_string(sum) +
                  " WHERE key='layout'");
  std::string words;
  EXPECT_EQ(readAll(file, &words), "");
  EXPECT_NE(words.find("another layout (layout 0, big-endian; known: layout 9"), std::string::npos)
      << words;
}

TEST(Damage, FolderThatIsNotThereIsAnError) {
  EXPECT_THROW(SessionWriter("/nowhere/at/all/session.palpa", syntheticInfo()), Error);
  EXPECT_THROW(SessionWriter("/proc/session.palpa", syntheticInfo()), Error);
}

TEST(Damage, LockedFileIsAnErrorAndNothingIsLostOnceItIsFree) {
  const fs::path file = freshFolder("locked") / "session.palpa";
  SessionWriter writer(file, syntheticInfo());
  writeTicks(writer, 0, 200);
  sqlite3* other = nullptr;
  ASSERT_EQ(sqlite3_open(file.c_str(), &other), SQLITE_OK);
  ASSERT_EQ(sqlite3_exec(other, "BEGIN IMMEDIATE", nullptr, nullptr, nullptr), SQLITE_OK);
  EXPECT_THROW(writeTicks(writer, 200, 400), Error);  // at its last tick
  sqlite3_exec(other, "ROLLBACK", nullptr, nullptr, nullptr);
  sqlite3_close(other);
  writer.commit();
  std::int64_t ticks = 0;
  SessionReader(file).ticks([&](const haptics::FlightRecord&) { ++ticks; });
  EXPECT_EQ(ticks, 400);
}

/// A limit on the file size stands in for a full disk.
TEST(Damage, FullDiskIsAnErrorAndNothingIsLostOnceThereIsSpace) {
  const fs::path file = freshFolder("full") / "session.palpa";
  SessionWriter writer(file, syntheticInfo());
  writeTicks(writer, 0, 400);
  rlimit before{};
  getrlimit(RLIMIT_FSIZE, &before);
  const auto handler = std::signal(SIGXFSZ, SIG_IGN);
  const rlimit tight{fs::file_size(file.string() + "-wal"), before.rlim_max};
  setrlimit(RLIMIT_FSIZE, &tight);
  std::string words;
  try {
    writeTicks(writer, 400, 600);
  } catch (const Error& error) {
    words = error.what();
  }
  setrlimit(RLIMIT_FSIZE, &before);
  std::signal(SIGXFSZ, handler);
  EXPECT_NE(words.find("session.palpa"), std::string::npos);
  EXPECT_NE(words.find("free"), std::string::npos) << words;
  {
    std::int64_t ticks = 0;
    SessionReader(file).ticks([&](const haptics::FlightRecord&) { ++ticks; });
    EXPECT_EQ(ticks, 400);  // what was committed is safe
  }
  writeTicks(writer, 600, 800);
  writer.close();
  std::int64_t ticks = 0;
  SessionReader(file).ticks([&](const haptics::FlightRecord& r) { EXPECT_EQ(r.tick, ticks++); });
  EXPECT_EQ(ticks, 800);  // and what could not be, came later
}

}  // namespace
}  // namespace palpa::record
