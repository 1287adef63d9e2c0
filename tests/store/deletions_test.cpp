#include "apps/record/store/deletions.h"

#include <fstream>

#include "anatomy/base/sha256.h"
#include "apps/record/store/migrations.h"
#include "tests/store/stores.h"

/// Who was deleted stays deleted, whatever backup is restored.
namespace palpa::record {
namespace {

namespace fs = std::filesystem;

constexpr char kPerson[] = "Zq-Person-7";
constexpr char kDeletion[] = "2026-04-01T00:00:00Z";

class Deleted : public Store {
 protected:
  void SetUp() override {
    Store::SetUp();
    if (IsSkipped()) return;
    RecordStore store(url);
    for (const char* id : {kPerson, "B"}) store.addTrainee(novice(id));
    store.addTrial(sessionOf(kPerson, "u1"), trialOf(1));
    store.addTrial(sessionOf(kPerson, "u2"), trialOf(1));
    store.addTrial(sessionOf("B", "u3"), trialOf(1));
  }

  std::string backUp(const std::string& name) const {
    std::string file = (folder / name).string();
    copyStore(*connect(url), *connect(file));
    return file;
  }
  /// The backup as the records: over the file, or into another database.
  std::string restore(const std::string& backup) const {
    if (onServer()) {
      std::string other = server->freshDatabase();
      copyStore(*connect(backup), *connect(other));
      return other;
    }
    for (const char* log : {"-wal", "-shm"}) fs::remove(url + log);
    fs::copy_file(backup, url, fs::copy_options::overwrite_existing);
    return url;
  }
  static void expectOnlyB(RecordStore& store) {
    ASSERT_EQ(store.trainees().size(), 1u);
    EXPECT_EQ(store.trainees()[0].id, "B");
    ASSERT_EQ(store.sessions().size(), 1u);
    EXPECT_EQ(store.sessions()[0].uuid, "u3");
  }
  std::vector<fs::path> filesNaming(const std::string& words) const {
    std::vector<fs::path> files;
    for (const auto& entry : fs::recursive_directory_iterator(folder))
      if (entry.is_regular_file() && test::slurp(entry.path()).find(words) != std::string::npos)
        files.push_back(entry.path());
    return files;
  }
};
INSTANTIATE_TEST_SUITE_P(Both, Deleted, testing::Values("SQLite", "PostgreSQL"),
                         [](const auto& p) { return std::string(p.param); });

TEST_P(Deleted, ABackupThatIsRestoredObeys) {
  const std::string backup = backUp("before.sqlite");
  {
    RecordStore store(url);
    EXPECT_EQ(store.deletePerson(kPerson, kDeletion).size(), 2u);
    store.evidenceDeleted("u1");
    EXPECT_TRUE(store.settleDeletions().empty());
  }
  RecordStore restored(restore(backup));
  expectOnlyB(restored);
  EXPECT_THROW(restored.addTrial(sessionOf(kPerson, "u2"), trialOf(1)), PersonDeleted);
  const auto left = restored.evidenceToDelete();
  ASSERT_EQ(left.size(), 1u) << "of u1 it was deleted already";
  EXPECT_EQ(left[0].uuid, "u2");
}

TEST_P(Deleted, ABackupAtAnotherPlaceObeysToo) {
  const std::string backup = backUp("before.sqlite");
  RecordStore(url).deletePerson(kPerson, kDeletion);
  RecordStore copy(backup);
  expectOnlyB(copy);
}

TEST_P(Deleted, WhoCameAnewStays) {
  {
    RecordStore store(url);
    store.deletePerson(kPerson, kDeletion);
    Trainee anew = novice(kPerson);
    anew.added_utc = "2026-05-01T00:00:00Z";
    store.addTrainee(anew);
    StoredSession later = sessionOf(kPerson, "u9");
    later.started_utc = "2026-05-01T10:00:00Z";
    store.addTrial(later, trialOf(1));
  }
  const std::string backup = backUp("after.sqlite");
  RecordStore(url).deletePerson("B", "2026-06-01T00:00:00Z");
  RecordStore restored(restore(backup));
  ASSERT_EQ(restored.trainees().size(), 1u);
  EXPECT_EQ(restored.trainees()[0].id, kPerson);
  EXPECT_EQ(restored.sessions().size(), 1u);
}

TEST_P(Deleted, AnotherCentresRecordsAreTheirOwn) {
  const std::string other =
      onServer() ? server->freshDatabase() : (folder / "other.sqlite").string();
  {
    RecordStore store(other);
    store.addTrainee(novice(kPerson));
    store.addTrial(sessionOf(kPerson, "u7"), trialOf(1));
  }
  RecordStore(url).deletePerson(kPerson, kDeletion);
  EXPECT_EQ(RecordStore(other).sessions(kPerson).size(), 1u);
}

TEST_P(Deleted, AListThatIsDamagedIsNone) {
  RecordStore store(url);
  store.deletePerson(kPerson, kDeletion);
  std::size_t lists = 0;
  for (const fs::path& file : Deletions(store.connection(), url).listFiles()) {
    ASSERT_TRUE(readDeletions(file)) << file;
    EXPECT_EQ(readDeletions(file)->sessions.size(), 2u);
    std::ofstream(file) << "{\"kind\": 1";
    EXPECT_FALSE(readDeletions(file));
    ++lists;
  }
  EXPECT_EQ(lists, onServer() ? 1u : 2u);
  RecordStore again(url);
  expectOnlyB(again);
  for (const fs::path& file : Deletions(store.connection(), url).listFiles())
    EXPECT_TRUE(readDeletions(file)) << "written anew: " << file;
}

TEST_P(Deleted, NoByteOfThePersonStays) {
  if (onServer()) GTEST_SKIP() << "a server clears its files in its own time";
  ASSERT_FALSE(filesNaming(kPerson).empty());
  {
    RecordStore store(url);
    store.deletePerson(kPerson, kDeletion);
    EXPECT_TRUE(store.settleDeletions().empty());
    for (const fs::path& file : filesNaming(kPerson)) ADD_FAILURE() << file;
    for (const fs::path& file : filesNaming(sha256(kPerson))) ADD_FAILURE() << file;
  }
  for (const fs::path& file : filesNaming(kPerson)) ADD_FAILURE() << file;
}

/// Tables as version 3 had them: no name, no salt.
void makeOlder(SqlConnection& store) {
  migrate(store, 3);
  for (const char* id : {kPerson, "B"})
    store.query("INSERT INTO trainees(" + columnsOf("trainees") +
                    ") VALUES($1,'','','right','2026-03-01T10:00:00Z','','','')",
                {std::string(id)});
  for (const auto& [uuid, id] : {std::pair("u1", kPerson), {"u2", kPerson}, {"u3", "B"}})
    store.query("INSERT INTO sessions(" + columnsOf("sessions") +
                    ") VALUES($1,$2,$3,'2026-03-01T10:00:00Z','','','',0,'',0,'','','{}')",
                {std::string(uuid), std::string(id), std::int64_t{uuid[1] - '0'}});
  store.query("INSERT INTO deletions(digest,deleted_utc) VALUES($1,'2026-02-01T00:00:00Z')",
              {sha256("Early")});
}

TEST_P(Deleted, ABackupFromBeforeThereWereListsObeysToo) {
  if (onServer()) GTEST_SKIP() << "of files alone";
  for (const char* name : {"old.sqlite", "records.sqlite", "elsewhere.sqlite"}) {
    const fs::path file = folder / name;
    if (name == std::string("old.sqlite")) {
      makeOlder(*connect(file.string()));
      continue;
    }
    for (const char* log : {"", "-wal", "-shm", ".deletions.json"}) fs::remove(file.string() + log);
    fs::copy_file(folder / "old.sqlite", file);
    if (name == std::string("records.sqlite")) {
      RecordStore(url).deletePerson(kPerson, kDeletion);
      fs::remove(url);
      fs::copy_file(folder / "old.sqlite", url);
    }
    RecordStore restored(file.string());
    expectOnlyB(restored);
    EXPECT_TRUE(restored.wasDeleted(sha256("Early")));
    EXPECT_TRUE(restored.connection().query("SELECT 1 FROM deletions").empty());
  }
}

TEST(Mentions, AreWords) {
  EXPECT_TRUE(mentions("T1", "T1"));
  EXPECT_TRUE(mentions("out/report-T1/x", "T1"));
  EXPECT_FALSE(mentions("out/report-T1/x", "T1", true));
  EXPECT_TRUE(mentions("a T10, then \"T1\"", "T1", true));
  EXPECT_FALSE(mentions("T10 AT1", "T1"));
}

}  // namespace
}  // namespace palpa::record
