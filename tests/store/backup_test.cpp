#include "apps/record/store/migrations.h"

#include <algorithm>
#include <cmath>

#include "tests/store/stores.h"

namespace palpa::record {
namespace {

class Backup : public Store {};
INSTANTIATE_TEST_SUITE_P(Both, Backup, testing::Values("SQLite", "PostgreSQL"),
                         [](const auto& p) { return std::string(p.param); });

TEST_P(Backup, ThereAndBackIsTheSame) {
  {
    RecordStore store(url);
    for (const char* id : {"A", "B", "C"}) store.addTrainee(novice(id));
    for (int i = 1; i <= 5; ++i) store.addTrial(sessionOf("A", "u1"), trialOf(i, 0.1 * i));
    store.addTrial(sessionOf("C", "u3"), trialOf(1));
    store.deletePerson("C", "2026-04-01T00:00:00Z");
  }
  const std::string file = (folder / "backup.sqlite").string(),
                    other =
                        onServer() ? server->freshDatabase() : (folder / "other.sqlite").string();
  const std::size_t copied = copyStore(*connect(url), *connect(file));
  EXPECT_EQ(copyStore(*connect(file), *connect(other)), copied);
  RecordStore restored(other);
  EXPECT_EQ(restored.trainees().size(), 2u);
  const auto trials = restored.trials();
  ASSERT_EQ(trials.size(), 5u);
  for (int i = 1; i <= 5; ++i)
    EXPECT_EQ(trials[static_cast<std::size_t>(i - 1)].trial.metric("total"), 0.1 * i);
  EXPECT_TRUE(std::isnan(trials[0].trial.metric("closest_artery")));
  EXPECT_EQ(restored.events("u1", 1).at(1).text, "It's a note: ü");
  restored.addTrainee(novice("C"));  // anew; what was recorded before stays deleted
  EXPECT_THROW(restored.addTrial(sessionOf("C", "u3"), trialOf(1)), PersonDeleted);
  EXPECT_THROW(restored.addTrial(sessionOf("C", "u4"), trialOf(1)), PersonDeleted);
  EXPECT_EQ(restored.evidenceToDelete().size(), 1u);
}

TEST_P(Backup, NeverOverwrites) {
  RecordStore(url).addTrainee(novice("A"));
  const std::string file = (folder / "backup.sqlite").string();
  RecordStore(file).addTrainee(novice("B"));
  EXPECT_THROW(copyStore(*connect(url), *connect(file)), UsageError);
  EXPECT_EQ(RecordStore(file).trainees().at(0).id, "B");
  EXPECT_EQ(RecordStore(url).trainees().size(), 1u);
}

/// Every column of every table is named, or a backup would lose it.
TEST_P(Backup, NamesEveryColumn) {
  const auto connection = connect(url);
  migrate(*connection);
  for (const std::string& table : tableNames()) {
    const std::string columns = columnsOf(table);
    const SqlRows rows = onServer()
                             ? connection->query(
                                   "SELECT column_name FROM information_schema.columns WHERE "
                                   "table_schema=current_schema() AND table_name=$1",
                                   {table})
                             : connection->query("SELECT name FROM pragma_table_info($1)", {table});
    EXPECT_EQ(rows.size(),
              static_cast<std::size_t>(1 + std::count(columns.begin(), columns.end(), ',')))
        << table;
    for (std::size_t i = 0; i < rows.size(); ++i)
      EXPECT_NE(("," + columns + ",").find("," + rows.text(i, 0) + ","), std::string::npos)
          << table << " " << rows.text(i, 0);
  }
}

}  // namespace
}  // namespace palpa::record
