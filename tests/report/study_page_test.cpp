#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "apps/report/study/study_exhibits.h"
#include "apps/report/study/study_report.h"
#include "synthetic_study.h"
#include "tests/support/files.h"
#include "well_formed.h"

namespace palpa::report {
namespace {

using study_analysis::StudyResult;
using test::pilotResult;
using test::searchResult;

std::string studyPage(const StudyResult& result, const std::string& name) {
  const std::filesystem::path file =
      palpa::test::freshFolder("report", "study_" + name) / "report.html";
  writeStudyReport({result, {{"Protocol", name + ".json", ""}}}, file);
  std::string page = palpa::test::slurp(file);
  EXPECT_EQ(test::faultOf(page), "");
  return page;
}

bool studySays(const std::string& page, const std::string& words) {
  return page.find(words) != std::string::npos;
}

TEST(StudyPage, ExamplesToLookAt) {
  const std::string pilot = studyPage(pilotResult(), "example_pilot"),
                    search = studyPage(searchResult(), "example_search");
  for (const char* id : {"table_3", "table_4", "table_5", "table_6", "figure_4", "figure_5",
                         "figure_6", "mixed_model_total", "table_6_as_published"})
    EXPECT_TRUE(studySays(pilot, std::string("id=\"") + id + '"')) << id;
  for (const char* id : {"figure_6", "figure_7", "figure_8", "figure_9", "figure_10", "anova"})
    EXPECT_TRUE(studySays(search, std::string("id=\"") + id + '"')) << id;
  EXPECT_LT(pilot.size() + search.size(), 1'000'000u);
}

TEST(StudyPage, SentencesComeFirstAndSimulatedIsSaid) {
  const std::string page = studyPage(pilotResult(), "sentences");
  EXPECT_LT(page.find("Novice, with force feedback: "), page.find("<svg"));
  EXPECT_TRUE(studySays(page, "SIMULATED"));
  EXPECT_TRUE(studySays(page, "What was found (simulated)"));
  EXPECT_TRUE(studySays(page, "too many degrees of freedom"));
  EXPECT_TRUE(studySays(page, "too timid"));
  StudyResult people = pilotResult();
  people.simulated_trials = 0;
  people.published_words.clear();
  std::erase_if(people.exhibits, [](const study_analysis::Exhibit& e) {
    return e.part == study_analysis::ExhibitPart::published;
  });
  const std::string real = studyPage(people, "people");
  for (const char* words : {"SIMULATED", "simulated", "As published", "<script", "<link", "src="})
    EXPECT_FALSE(studySays(real, words)) << words;
}

TEST(StudyPage, NoTextIsMarkup) {
  StudyResult result = pilotResult();
  const std::string hostile = "<script>\"x\" & 'y'</script>";
  result.title = result.kind = hostile;
  result.findings = result.cautions = result.software = {hostile};
  for (study_analysis::Exhibit& e : result.exhibits) {
    e.title = e.caption = hostile;
    e.notes = {hostile};
    for (study_analysis::Plot& p : e.plots) p.families.assign(p.families.size(), hostile);
  }
  EXPECT_FALSE(studySays(studyPage(result, "hostile"), "<script"));
}

/// Values far apart, below zero, alike, or none: drawn within the picture, and nothing that is no
/// number in a path.
TEST(StudyPage, DrawsWhateverComes) {
  StudyResult result = pilotResult();
  for (const double value : {-5.0, 0.0, 1e9, 1e-9, std::nan("")}) {
    StudyResult odd = result;
    for (study_analysis::Exhibit& e : odd.exhibits)
      for (study_analysis::Plot& p : e.plots)
        for (study_analysis::PlotSeries& s : p.series)
          for (study_analysis::PlotPoint& point : s.points)
            point.y = point.low = point.high = value;
    const std::string page = studyPage(odd, "odd");
    EXPECT_FALSE(studySays(page, "nan") || studySays(page, "inf\"")) << value;
  }
  for (study_analysis::Exhibit& e : result.exhibits) {
    e.table.rows.clear();
    for (study_analysis::Plot& p : e.plots) p.series.clear();
  }
  studyPage(result, "empty");
}

TEST(StudyTables, ACsvAndAJsonForEachWithTheSameNumbers) {
  const std::filesystem::path folder = palpa::test::freshFolder("report", "study_tables");
  const StudyResult result = pilotResult();
  const auto files = writeStudyTables(result, folder);
  EXPECT_EQ(files.size(), 2 * result.exhibits.size());
  for (const study_analysis::Exhibit& e : result.exhibits) {
    const std::string csv = palpa::test::slurp(folder / (e.id + ".csv"));
    EXPECT_EQ(static_cast<std::size_t>(std::count(csv.begin(), csv.end(), '\n')),
              1 + e.table.rows.size())
        << e.id;
    const auto json = nlohmann::json::parse(palpa::test::slurp(folder / (e.id + ".json")));
    EXPECT_EQ(json.at("simulated"), true);
    ASSERT_EQ(json.at("rows").size(), e.table.rows.size());
    for (std::size_t r = 0; r < e.table.rows.size(); ++r)
      for (std::size_t c = 0; c < e.table.columns.size(); ++c)
        if (const double* value = std::get_if<double>(&e.table.rows[r][c]);
            value && std::isfinite(*value)) {
          EXPECT_EQ(json["rows"][r][c].get<double>(), *value);
        }
  }
}

TEST(StudyTables, CellsAreQuotedNumberedAndMarked) {
  const study_analysis::Table table{
      {{"who", "Who", 0}, {"p", "p", 3, study_analysis::Format::p_value}, {"p", "p", 3}},
      {{std::string("a,\"b\""), 0.00021, std::nan("")}}};
  EXPECT_EQ(studyCsv(table, true), "who,p,p_2,SIMULATED\n\"a,\"\"b\"\"\",0.00021,,1\n");
  EXPECT_EQ(studyCell(table.rows[0][1], table.columns[1]), "< 0.001");
  EXPECT_EQ(studyCell(table.rows[0][2], table.columns[2]), "–");
  const auto json = nlohmann::json::parse(
      studyJson({"id", "t", "c", study_analysis::ExhibitPart::table, table, {}, {"n"}}, false));
  EXPECT_TRUE(json["rows"][0][2].is_null());
  EXPECT_EQ(json["columns"][2]["name"], "p_2");
}

}  // namespace
}  // namespace palpa::report
