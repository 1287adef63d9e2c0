#include <fstream>
#include <functional>
#include <map>

#include "apps/record/store/migrations.h"
#include "apps/record/store/store_look.h"
#include "tests/store/stores.h"

/// Whoever only looks at the records changes nothing.
namespace palpa::record {
namespace {

namespace fs = std::filesystem;

/// Every file beside the records, with its bytes; without the log's index, in which readers leave
/// marks.
std::map<std::string, std::string> bytesIn(const fs::path& folder) {
  std::map<std::string, std::string> all;
  for (const auto& entry : fs::directory_iterator(folder))
    if (!entry.path().string().ends_with("-shm"))
      all[entry.path().filename().string()] = test::slurp(entry.path());
  return all;
}

/// What is refused, in words; "" where it is not.
std::string refusalOf(const std::function<void()>& action) {
  try {
    action();
  } catch (const Error& e) {
    return e.what();
  }
  return "";
}

bool tells(const std::string& message, const std::string& words) {
  return message.find(words) != std::string::npos;
}

std::string tablesOf(SqlConnection& connection) {
  std::string known;
  for (const std::string& table : tableNames())
    if (connection.hasTable(table)) known += table + " ";
  return known;
}

TEST_P(Store, ALookSaysWhichVersionAndChangesNothing) {
  for (int version = 0; version <= newestSchema(); ++version) {
    std::string tables;
    {
      const auto connection = connect(url);
      if (onServer())
        connection->query("DROP SCHEMA public CASCADE"), connection->query("CREATE SCHEMA public");
      migrate(*connection, version);
      tables = tablesOf(*connection);
    }
    const auto before = bytesIn(folder);
    const StoreLook look = lookAtStore(url);
    EXPECT_EQ(look.state, version == 0               ? StoreState::empty
                          : version < newestSchema() ? StoreState::older
                                                     : StoreState::current)
        << version;
    EXPECT_EQ(look.schema, version);
    EXPECT_EQ(bytesIn(folder), before) << version;
    EXPECT_EQ(tablesOf(*connect(url)), tables) << version;
    if (!onServer()) fs::remove(url);
  }
}

TEST_P(Store, ALookSeesWhoIsThereWhileOthersWriteAndCannotWriteItself) {
  RecordStore store(url);
  store.addTrainee(novice("A"));
  store.addTrainee(novice("B"));
  const auto before = bytesIn(folder);  // of a file: what was just written stands in its log
  EXPECT_EQ(lookAtStore(url).trainees, 2u);
  EXPECT_EQ(bytesIn(folder), before);
  const auto reading = connectToRead(url);
  EXPECT_THROW(reading->query("DELETE FROM trainees"), Error);
  EXPECT_EQ(store.trainees().size(), 2u);
}

TEST_P(Store, ALookNamesANewerStore) {
  { RecordStore store(url); }
  connect(url)->query("UPDATE palpa_schema SET version=99");
  const std::string message = refusalOf([&] { lookAtStore(url); });
  EXPECT_TRUE(tells(message, "newer version of Palpa")) << message;
}

TEST(Look, AtFilesThatAreNotThereEmptyForeignOrDamaged) {
  const fs::path folder = test::freshFolder("store", "look");
  const std::string file = (folder / "records.sqlite").string();
  EXPECT_EQ(lookAtStore(file).state, StoreState::absent);
  EXPECT_TRUE(fs::is_empty(folder));
  std::ofstream(file).close();
  EXPECT_EQ(lookAtStore(file).state, StoreState::empty);
  EXPECT_EQ(fs::file_size(file), 0u);
  const auto refused = [&](const std::string& bytes, const std::string& words) {
    std::ofstream(file, std::ios::binary) << bytes;
    const std::string message = refusalOf([&] { lookAtStore(file); });
    EXPECT_TRUE(tells(message, words)) << message;
    EXPECT_EQ(bytesIn(folder), (std::map<std::string, std::string>{{"records.sqlite", bytes}}));
  };
  refused("this is no database, but long enough", "is not a records file");
  fs::remove(file);
  {
    RecordStore store(file);
    for (int i = 0; i < 200; ++i) store.addTrainee(novice("T" + std::to_string(i)));
  }
  const std::string whole = test::slurp(file);
  std::string torn = whole;
  torn.replace(4096, 4096, 4096, '\x55');
  refused(torn, "damaged");
  refused(whole.substr(0, whole.size() - 1000), "cut short");
  fs::remove(file);
  const auto other = connect(file);
  other->query("CREATE TABLE recipes(name TEXT)");
  other->query("PRAGMA application_id=0");
  EXPECT_TRUE(tells(refusalOf([&] { lookAtStore(file); }), "another program"));
  EXPECT_TRUE(tells(refusalOf([&] { RecordStore store(file); }), "another program"))
      << "nor does a session put its tables there";
}

}  // namespace
}  // namespace palpa::record
