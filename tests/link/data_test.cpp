#include "apps/link/data_tables.h"

#include <gtest/gtest.h>

#include <algorithm>
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
    record::RecordStore store((folder_ / "records.sqlite").string());
    for (const char* id : {"A", "B"}) store.addTrainee(person(id));
    for (int i = 1; i <= 3; ++i) store.addTrial(sessionOf("A", 1), trialOf(i, 0.1 * i));
    record::StoredTrial foreign = trialOf(1);
    foreign.metrics.push_back({"of_the_future", 7});
    store.addTrial(sessionOf("B", 2, true), foreign);
    data_ = link::datasetOf(store, store.trainees());
  }

  const link::ExportTable& table(const std::string& name) {
    tables_ = link::tablesOf(data_, false);
    return *std::find_if(tables_.begin(), tables_.end(),
                         [&](const auto& t) { return t.name == name; });
  }

  static json cell(const link::ExportTable& table, std::size_t row, const std::string& column) {
    for (std::size_t i = 0; i < table.columns.size(); ++i)
      if (table.columns[i].name == column) return table.rows.at(row).at(i);
    ADD_FAILURE() << "no column " << column;
    return {};
  }

  std::filesystem::path folder_;
  link::Dataset data_;
  std::vector<link::ExportTable> tables_;
};

TEST_F(Export, EveryTrialWithEveryFigure) {
  const link::ExportTable& trials = table("trials");
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
  const link::ExportTable sessions = table("sessions");
  EXPECT_EQ(cell(sessions, 0, "study_condition"), "with");
  EXPECT_EQ(cell(sessions, 0, "operator"), "person");
  EXPECT_EQ(table("calibrations").rows.size(), 2u);
  EXPECT_EQ(cell(table("events"), 0, "text"), "The skin was punctured, at 5 s");
}

TEST_F(Export, FilesReadBack) {
  link::writeTables(link::tablesOf(data_, false), link::DataFormat::both, folder_ / "");
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
  const auto written = [&](bool with_paths) {
    std::string text = link::asJson(link::tablesOf(data_, with_paths));
    for (const link::ExportTable& t : link::tablesOf(data_, with_paths)) text += link::asCsv(t);
    return text;
  };
  EXPECT_EQ(written(false).find("/home/"), std::string::npos);
  EXPECT_NE(written(true).find("/home/somebody/out/session.palpa"), std::string::npos);
}

TEST_F(Export, TheDictionaryHasEveryColumnOfEveryFile) {
  const auto tables = link::tablesOf(data_, true);
  const link::ExportTable dictionary = link::dictionaryOf(tables);
  const std::string markdown = link::dictionaryAsMarkdown(tables);
  std::size_t row = 0;
  for (const link::ExportTable& t : tables) {
    std::istringstream csv(link::asCsv(t));
    std::string header;
    std::getline(csv, header);
    std::istringstream names(header);
    for (std::string name; std::getline(names, name, ','); ++row) {
      EXPECT_EQ(dictionary.rows.at(row).at(0), t.name);
      EXPECT_EQ(dictionary.rows.at(row).at(1), name);
      for (std::size_t i : {2u, 3u})
        EXPECT_FALSE(dictionary.rows[row][i].get<std::string>().empty()) << name;
      EXPECT_NE(markdown.find("| " + name + " |"), std::string::npos) << name;
    }
  }
  EXPECT_EQ(row, dictionary.rows.size());
  EXPECT_NE(markdown.find("| total | 1 | Total penalty: sum of weight x value"), std::string::npos);
}

/// A person's export is everything: also what the store learns to keep later.
TEST_F(Export, HasEveryTableThatNamesATrainee) {
  std::set<std::string> exported;
  for (const link::ExportTable& t : link::tablesOf(data_, false)) exported.insert(t.name);
  for (const std::string& name : record::tableNames()) {
    const bool names_one =
        ("," + record::columnsOf(name) + ",").find(",trainee,") != std::string::npos;
    EXPECT_TRUE(!names_one || exported.contains(name)) << name;
  }
  const link::ExportTable answers =
      link::asTable({"answers",
                     {"trainee", "answer", "later"},
                     {{std::string("A"), std::int64_t{5}, std::monostate{}}}});
  EXPECT_EQ(link::asCsv(answers), "trainee,answer,later\nA,5,\n");
  for (const link::TableColumn& c : answers.columns) EXPECT_FALSE(c.meaning.empty());
}

TEST_F(Export, WhatIsNoTextLosesNoFile) {
  data_.trials[0].trial.reason = "broken \xff\xfe text";
  data_.sessions[0].facts_json = "{damaged";
  const std::string text = link::asJson(link::tablesOf(data_, false));
  EXPECT_FALSE(json::parse(text, nullptr, false).is_discarded());
}

}  // namespace
}  // namespace palpa::link_test
