#include "apps/link/data_tables.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <optional>
#include <set>
#include <sstream>

#include "apps/assess/metrics/metric_table.h"
#include "apps/record/store/migrations.h"
#include "tests/link/trials.h"
#include "tests/support/files.h"

namespace palpa::link_test {
namespace {

using nlohmann::json;

class Export : public testing::Test {
 protected:
  void SetUp() override {
    folder_ =
        test::freshFolder("link", testing::UnitTest::GetInstance()->current_test_info()->name());
    store_.emplace((folder_ / "records.sqlite").string());
    for (const char* id : {"A", "B"}) store_->addTrainee(person(id));
    for (int i = 1; i <= 3; ++i) store_->addTrial(sessionOf("A", 1), trialOf(i, 0.1 * i));
    record::StoredTrial foreign = trialOf(1);
    foreign.metrics.push_back({"of_the_future", 7});
    store_->addTrial(sessionOf("B", 2, true), foreign);
    source_.emplace(link::ExportSource{store_->connection(), store_->trainees(), false});
  }

  struct Filled {
    std::vector<link::TableColumn> columns;
    std::vector<link::TableRow> rows;
  };

  std::vector<link::ExportTable> tables() { return link::tablesOf(*source_); }

  Filled table(const std::string& name) {
    const record::SqlTransaction moment(store_->connection(), record::Access::read);
    for (const link::ExportTable& t : tables()) {
      if (t.name != name) continue;
      Filled filled{t.columns, {}};
      t.rows([&](const link::TableRow& row) { filled.rows.push_back(row); });
      return filled;
    }
    ADD_FAILURE() << "no table " << name;
    return {};
  }

  static json cell(const Filled& table, std::size_t row, const std::string& column) {
    for (std::size_t i = 0; i < table.columns.size(); ++i)
      if (table.columns[i].name == column) return table.rows.at(row).at(i);
    ADD_FAILURE() << "no column " << column;
    return {};
  }

  static std::string csvOf(const link::ExportTable& table) {
    std::string text;
    link::writeCsv(table, [&](std::string_view more) { text += more; });
    return text;
  }

  std::string allAsText() {
    const record::SqlTransaction moment(store_->connection(), record::Access::read);
    std::string text;
    link::writeJson(tables(), [&](std::string_view more) { text += more; });
    for (const link::ExportTable& t : tables()) text += csvOf(t);
    return text;
  }

  std::filesystem::path folder_;
  std::optional<record::RecordStore> store_;
  std::optional<link::ExportSource> source_;
};

TEST_F(Export, EveryTrialWithEveryFigure) {
  const Filled trials = table("trials");
  ASSERT_EQ(trials.rows.size(), 4u);
  EXPECT_EQ(cell(trials, 2, "total"), 0.1 * 3);  // to the last bit
  EXPECT_TRUE(cell(trials, 0, "closest_artery_mm").is_null());
  EXPECT_EQ(cell(trials, 3, "of_the_future"), 7.0);
  EXPECT_EQ(cell(trials, 0, "seed"), "18364758544493064720");
  EXPECT_EQ(cell(trials, 3, "simulated"), 1);
  EXPECT_EQ(cell(trials, 0, "end_s").get<double>(), 131.524);
  for (const metrics::MetricDefinition& d : metrics::metricTable()) cell(trials, 0, d.name);
}

TEST_F(Export, SessionsCalibrationsEvents) {
  const Filled sessions = table("sessions");
  EXPECT_EQ(cell(sessions, 0, "study_condition"), "with");
  EXPECT_EQ(cell(sessions, 0, "operator"), "person");
  EXPECT_EQ(table("calibrations").rows.size(), 2u);
  EXPECT_EQ(cell(table("events"), 0, "text"), "The skin was punctured, at 5 s");
}

TEST_F(Export, FilesReadBack) {
  {
    const record::SqlTransaction moment(store_->connection(), record::Access::read);
    link::writeTables(tables(), link::DataFormat::both, folder_ / "");
  }
  const json all = json::parse(test::slurp(folder_ / "records.json"));
  EXPECT_EQ(all["trainees"][0]["experience"], "3rd year, left \"early\"");
  EXPECT_EQ(all["trials"][2]["total"], 0.1 * 3);
  EXPECT_EQ(all["sessions"][0]["facts"]["study"]["id"], "pilot");
  const std::string trainees = test::slurp(folder_ / "trainees.csv");
  EXPECT_NE(trainees.find("A,novice,\"3rd year, left \"\"early\"\"\",left,"), std::string::npos)
      << trainees;
  const std::string trials = test::slurp(folder_ / "trials.csv");
  EXPECT_EQ(std::count(trials.begin(), trials.end(), '\n'), 5);
  EXPECT_NE(trials.find("0.30000000000000004"), std::string::npos);
}

TEST_F(Export, PlacesOfThisComputerOnlyWhenAsked) {
  EXPECT_EQ(allAsText().find("/home/"), std::string::npos);
  source_->with_paths = true;
  EXPECT_NE(allAsText().find("/home/somebody/out/session.palpa"), std::string::npos);
}

TEST_F(Export, TheDictionaryHasEveryColumnOfEveryFile) {
  source_->with_paths = true;
  const record::SqlTransaction moment(store_->connection(), record::Access::read);
  const auto all = tables();
  std::vector<link::TableRow> rows;
  link::dictionaryOf(all).rows([&](const link::TableRow& row) { rows.push_back(row); });
  const std::string markdown = link::dictionaryAsMarkdown(all);
  std::size_t row = 0;
  for (const link::ExportTable& t : all) {
    std::istringstream csv(csvOf(t));
    std::string header;
    std::getline(csv, header);
    std::istringstream names(header);
    for (std::string name; std::getline(names, name, ','); ++row) {
      EXPECT_EQ(rows.at(row).at(0), t.name);
      EXPECT_EQ(rows.at(row).at(1), name);
      for (std::size_t i : {2u, 3u}) EXPECT_FALSE(rows[row][i].get<std::string>().empty()) << name;
      EXPECT_NE(markdown.find("| " + name + " |"), std::string::npos) << name;
    }
  }
  EXPECT_EQ(row, rows.size());
  EXPECT_NE(markdown.find("| total | 1 | Total penalty: sum of weight x value"), std::string::npos);
}

/// A person's export is everything: also what the store learns to keep later.
TEST_F(Export, HasEveryTableThatNamesATrainee) {
  std::set<std::string> exported;
  for (const link::ExportTable& t : tables()) exported.insert(t.name);
  for (const std::string& name : record::tableNames()) {
    const bool names_one =
        ("," + record::columnsOf(name) + ",").find(",trainee,") != std::string::npos;
    EXPECT_TRUE(!names_one || exported.contains(name)) << name;
  }
  const link::ExportTable answers =
      link::furtherTable("answers", {"trainee", "answer", "later"}, [](const auto& visit) {
        visit({std::string("A"), std::int64_t{5}, std::monostate{}});
      });
  EXPECT_EQ(csvOf(answers), "trainee,answer,later\nA,5,\n");
  for (const link::TableColumn& c : answers.columns) EXPECT_FALSE(c.meaning.empty());
}

TEST_F(Export, WhatIsNoTextLosesNoFile) {
  store_->connection().query("UPDATE trials SET reason=$1", {std::string("broken \xff\xfe text")});
  store_->connection().query("UPDATE sessions SET facts_json='{damaged'");
  const record::SqlTransaction moment(store_->connection(), record::Access::read);
  std::string text;
  link::writeJson(tables(), [&](std::string_view more) { text += more; });
  const json all = json::parse(text, nullptr, false);
  ASSERT_FALSE(all.is_discarded());
  EXPECT_TRUE(all["sessions"][0]["facts"].is_null());
  EXPECT_EQ(all["trials"].size(), 4u);
}

/// One person's export holds nothing of the others, and says how much it is.
TEST_F(Export, HasTheChosenPeopleAlone) {
  source_->who.erase(source_->who.begin());
  const link::Extent extent = [&] {
    const record::SqlTransaction moment(store_->connection(), record::Access::read);
    return link::extentOf(*source_);
  }();
  EXPECT_EQ(extent.sessions, 1u);
  EXPECT_EQ(extent.simulated, 1u);
  EXPECT_EQ(extent.trials, 1u);
  for (const char* name : {"trainees", "sessions", "calibrations", "trials", "events"})
    EXPECT_EQ(table(name).rows.size(), 1u) << name;
  store_->addTrainee(person("C"));
  source_->who = {person("A"), person("C")};  // of several, some
  EXPECT_EQ(table("trials").rows.size(), 3u);
  EXPECT_EQ(table("events").rows.size(), 3u);
}

/// As nlohmann's own writer has it, an indent of one.
TEST_F(Export, JsonIsWrittenRowByRowAsItWouldBeWhole) {
  source_->who.push_back(person("Z"));
  const record::SqlTransaction moment(store_->connection(), record::Access::read);
  std::string text;
  link::writeJson(tables(), [&](std::string_view more) { text += more; });
  EXPECT_EQ(nlohmann::ordered_json::parse(text).dump(1) + "\n", text);
}

}  // namespace
}  // namespace palpa::link_test
