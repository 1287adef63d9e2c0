#include <gtest/gtest.h>

#include <algorithm>
#include <sstream>

#include "anatomy/base/error.h"
#include "apps/assess/statistics/sample.h"
#include "apps/report/page/html.h"
#include "apps/report/palpation/palpation_sections.h"
#include "synthetic_palpation.h"
#include "well_formed.h"

namespace palpa::report {
namespace {

using namespace test;
namespace fs = std::filesystem;

std::string palpationPage(const PalpationReport& report, const std::string& name) {
  const fs::path file = freshFolder("palpation_" + name) / "report.html";
  writePalpationReport(report, file);
  return slurp(file);
}

bool says(const std::string& page, const std::string& text) {
  return page.find(text) != std::string::npos;
}

TEST(PalpationPage, IsWellFormedWithNoneOneAndThreeTrials) {
  EXPECT_EQ(faultOf(palpationPage(PalpationReport{}, "none")), "");
  EXPECT_EQ(faultOf(palpationPage(syntheticPalpation(1), "one")), "");
  EXPECT_EQ(faultOf(palpationPage(syntheticPalpation(3), "three")), "");
}

/// Where a trial left nothing, or nonsense, there is still a page.
TEST(PalpationPage, StandsWithNothingInIt) {
  const double nan = std::nan("");
  PalpationReport report;
  report.trials.resize(2);
  PalpationPage& odd = report.trials[1];
  odd.assessment.lumps = {{Vec3(nan, 0, 0), nan, 7, -1}, {Vec3(0.5, 0.5, 0), -1, 0, 0}};
  odd.assessment.marks = {{nan, Vec3(nan, nan, nan), nan, 9, 9}, {-5, Vec3(1, -1, 0), 0, 0, 0}};
  odd.assessment.score.lumps = {{5, nan, nan, true, true}};
  odd.assessment.score.peak = odd.assessment.score.twice = odd.assessment.score.closer_force = nan;
  odd.samples.resize(3);
  odd.samples[1].f_n = odd.samples[2].t_s = nan;
  odd.samples[0].p_P.x() = nan;
  odd.rules.area = {0, 0};
  const std::string page = palpationPage(report, "odd");
  EXPECT_EQ(faultOf(page), "");
  EXPECT_FALSE(says(page, "nan"));
  EXPECT_FALSE(says(page, "inf\""));
}

TEST(PalpationPage, TellsWhatWasFoundAndWhatWasNot) {
  const PalpationReport report = syntheticPalpation(1);
  const assess::PalpationAssessment& trial = report.trials[0].assessment;
  ASSERT_EQ(trial.score.found, 1);
  ASSERT_EQ(trial.score.missed, 1);
  ASSERT_EQ(trial.score.false_alarms, 1);
  const std::string page = palpationPage(report, "words");
  EXPECT_TRUE(says(page, escaped(trial.summary)));
  ASSERT_FALSE(trial.advice.empty());
  for (const std::string& sentence : trial.advice)
    EXPECT_TRUE(says(page, "<li>" + escaped(sentence) + "</li>")) << sentence;
  EXPECT_TRUE(says(page, "found by mark 1"));
  EXPECT_TRUE(says(page, "3.2 mm"));  // hypot(2.5, 2) of the first mark
  EXPECT_TRUE(says(page, "4.0 mm too large"));
  EXPECT_TRUE(says(page, "right: hard"));
  EXPECT_TRUE(says(page, "wrong: said mobile, is fixed"));
  EXPECT_TRUE(says(page, ">missed</td>"));
  EXPECT_TRUE(says(page, "1 mark is a false alarm."));
  EXPECT_TRUE(says(page, "1 mark repeats a lump"));
  EXPECT_TRUE(says(page, "Below the standard"));
  EXPECT_TRUE(says(page, "that takes 8 cases or more"));
  EXPECT_TRUE(says(page, escaped(report.force_note)));
  EXPECT_TRUE(says(page, "Where this task stands"));
  EXPECT_TRUE(says(page, "Made by Palpa 0.1.0."));
}

std::size_t times(const std::string& page, const std::string& text) {
  std::size_t count = 0;
  for (auto at = page.find(text); at != std::string::npos; at = page.find(text, at + 1)) ++count;
  return count;
}

/// Each sign stands in the legend once, and in the map as often as there is something; all that
/// twice, wide and narrow.
TEST(PalpationPage, DrawsLumpsAndMarksByShape) {
  const std::string page = palpationPage(syntheticPalpation(1), "signs");
  EXPECT_EQ(times(page, "class=\"ring found\""), 2 * (1 + 1u));
  EXPECT_EQ(times(page, "class=\"ring missed\""), 2 * (1 + 1u));
  EXPECT_EQ(times(page, "class=\"cross\""), 2 * (1 + 2u));
  EXPECT_EQ(times(page, "class=\"cross alarm\""), 2 * (1 + 1u));
  EXPECT_EQ(times(page, ">away from you<"), 2u);
  EXPECT_EQ(times(page, ">10 mm</text>"), 2u);
  EXPECT_TRUE(
      says(std::string(palpationStyle()), ".ring.missed{stroke:var(--bad-ink);stroke-dasharray"));
}

/// A lump of 16 mm is drawn 16 mm wide by the page's own scale bar; one to the right and away
/// stands right and above the middle.
TEST(PalpationPage, DrawsLumpsInTheirPlaceAndSize) {
  const std::string page = palpationPage(syntheticPalpation(1), "scale");
  const auto bar = page.find("v10m0-5h");
  ASSERT_NE(bar, std::string::npos);
  const double px_per_mm = std::stod(page.substr(bar + 8)) / 10;
  const auto ring = page.find("class=\"ring found\"");
  const auto attribute = [&](const std::string& name) {
    return std::stod(page.substr(page.find(' ' + name + "=\"", ring) + name.size() + 3));
  };
  EXPECT_NEAR(2 * attribute("r") / px_per_mm, 16, 0.05);  // both are rounded to 0.1 px
  const auto edge = page.find("class=\"edge\"");
  const auto of_edge = [&](const std::string& name) {
    return std::stod(page.substr(page.find(' ' + name + "=\"", edge) + name.size() + 3));
  };
  EXPECT_NEAR((attribute("cx") - of_edge("x") - of_edge("width") / 2) / px_per_mm, 20, 0.05);
  EXPECT_NEAR((of_edge("y") + of_edge("height") / 2 - attribute("cy")) / px_per_mm, 18, 0.05);
}

TEST(PalpationPage, AddsUpWhatCounts) {
  const std::string page = palpationPage(syntheticPalpation(3), "totals");  // the third is void
  EXPECT_TRUE(says(page, "Found 2 of 4 lumps in 2 scored trials; 2 false alarms."));
  EXPECT_TRUE(says(page, "95 % interval 15 % to 85 %"));  // Wilson for 2 of 4
  EXPECT_TRUE(says(page, "1 trial is not counted here"));
  EXPECT_TRUE(says(page, "Not judged: void"));
}

TEST(PalpationPage, SaysSimulatedIfAndOnlyIfItIs) {
  PalpationReport report = syntheticPalpation(2);
  report.trainee = "P07";
  report.simulated = false;  // one simulated trial is enough
  report.trials[0].assessment.facts.simulated = false;
  const std::string page = palpationPage(report, "simulated");
  EXPECT_TRUE(says(page, "SIMULATED"));
  EXPECT_LT(page.find("SIMULATED"), page.find("<main>"));
  report.trials[1].assessment.facts.simulated = false;
  std::string real = palpationPage(report, "real");
  std::transform(real.begin(), real.end(), real.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  EXPECT_FALSE(says(real, "simulated"));
  report.simulated = true;
  EXPECT_TRUE(says(palpationPage(report, "simulated"), "SIMULATED"));
}

TEST(PalpationPage, TreatsNamesAsTextNeverAsMarkup) {
  PalpationReport report = syntheticPalpation(2);
  const std::string evil = "<script>alert('x')</script>\"&\x01\xff";
  report.title = report.trainee = report.when = report.force_note = evil;
  report.taxonomy = report.station = report.notes = {{evil, evil, evil}, {"Software", evil, ""}};
  for (PalpationPage& page : report.trials) {
    page.assessment.summary = evil;
    page.assessment.advice = {evil};
    page.pictures = {{evil, evil, 3}};
  }
  const std::string page = palpationPage(report, "evil");
  EXPECT_EQ(faultOf(page), "");
  EXPECT_FALSE(says(page, "<script"));
  EXPECT_TRUE(says(page, escaped(evil)));
}

TEST(PalpationPage, LoadsNothing) {
  std::string page = palpationPage(syntheticPalpation(1), "loads");
  const std::string xmlns = "xmlns=\"http://www.w3.org/2000/svg\"";  // a name, nothing is loaded
  for (auto at = page.find(xmlns); at != std::string::npos; at = page.find(xmlns))
    page.erase(at, xmlns.size());
  for (const char* load : {"http://", "https://", "<script", "<link", "@import", "url(", "<iframe"})
    EXPECT_FALSE(says(page, load)) << load;
}

TEST(PalpationPage, IsAllOrNothingAndTheSameEachTime) {
  EXPECT_EQ(palpationPage(syntheticPalpation(2), "same"),
            palpationPage(syntheticPalpation(2), "same"));
  const fs::path folder = freshFolder("palpation_unwritable");
  EXPECT_THROW(writePalpationReport(syntheticPalpation(), folder / "missing" / "report.html"),
               Error);
  const std::string css(palpationStyle());
  EXPECT_EQ(std::count(css.begin(), css.end(), '{'), std::count(css.begin(), css.end(), '}'));
}

TEST(PalpationPage, LeavesOneToLookAt) {
  const fs::path file = freshFolder("palpation_example") / "three.html";
  writePalpationReport(syntheticPalpation(3), file);
  EXPECT_LT(fs::file_size(file), 500'000u);
}

/// The closed form at the ends, and the figures for 81 of 263 in R. G. Newcombe, Statistics in
/// Medicine 17, 1998, table I.
TEST(Wilson, IsTheScoreInterval) {
  const statistics::ShareInterval all = statistics::wilson(10, 10),
                                  some = statistics::wilson(81, 263),
                                  none = statistics::wilson(0, 0);
  EXPECT_NEAR(all.low, 10 / (10 + 1.959963984540054 * 1.959963984540054), 1e-12);
  EXPECT_NEAR(all.high, 1, 1e-12);
  EXPECT_NEAR(some.low, 0.2553, 5e-5);
  EXPECT_NEAR(some.high, 0.3662, 5e-5);
  EXPECT_TRUE(std::isnan(none.share));
  EXPECT_NEAR(statistics::wilson(3, 10).low, 1 - statistics::wilson(7, 10).high, 1e-12);
}

using Columns = std::vector<std::string>;

Columns split(const std::string& line) {
  Columns columns;
  std::istringstream text(line);
  for (std::string column; std::getline(text, column, ',');) columns.push_back(column);
  return columns;
}

TEST(PalpationCsv, HasAColumnForEachFigure) {
  const fs::path file = freshFolder("palpation_csv") / "trials.csv";
  const assess::PalpationAssessment trial = searchedPage(1).assessment;
  writePalpationCsv("P07", {trial}, file);
  std::istringstream lines(slurp(file));
  std::string header, row, rest;
  std::getline(lines, header);
  std::getline(lines, row);
  EXPECT_FALSE(std::getline(lines, rest));
  EXPECT_EQ(header,
            "USER_ID,TRIAL,SEED,SIMULATED,FF,OUTCOME,LUMPS,FOUND,MISSED,FALSE_ALARMS,REPEATED,"
            "CLEAR_QUADRANTS,WRONG_QUADRANTS,ILL_QUADRANTS,HIT_QUADRANTS,COVERAGE_LIGHT,COVERAGE_"
            "MEDIUM,COVERAGE_DEEP,TWICE,"
            "PATTERN,PATTERN_KEPT,PEAK_N,MEAN_N,TOO_LIGHT,TOO_HARD,CLOSER_FORCE,PRESSES,TIME_S,"
            "GUIDED,ERROR_MEAN_MM,SIZE_ERROR_MEAN_MM,AT_STANDARD,AUGMENTED");
  const Columns names = split(header), values = split(row);
  ASSERT_EQ(values.size(), names.size());
  const auto value = [&](const std::string& name) {
    return values[static_cast<std::size_t>(std::find(names.begin(), names.end(), name) -
                                           names.begin())];
  };
  EXPECT_EQ(row.find("P07,1,20240517,1,1,done,2,1,1,1,1,"), 0u) << row;
  EXPECT_EQ(std::stod(value("COVERAGE_DEEP")), trial.score.coverage[2]);
  EXPECT_EQ(std::stod(value("PEAK_N")), trial.score.peak);
  EXPECT_EQ(std::stod(value("CLOSER_FORCE")), trial.score.closer_force);
  EXPECT_EQ(value("PATTERN"), "vertical strips");
  EXPECT_EQ(value("GUIDED"), "0.25");
  EXPECT_NEAR(std::stod(value("ERROR_MEAN_MM")), std::hypot(2.5, 2), 1e-9);
  EXPECT_NEAR(std::stod(value("SIZE_ERROR_MEAN_MM")), 4, 1e-9);
  EXPECT_EQ(value("AT_STANDARD"), "0");
}

TEST(PalpationCsv, QuotesNamesAndLeavesEmptyWhatWasNotMeasured) {
  const fs::path folder = freshFolder("palpation_csv_quotes");
  assess::PalpationAssessment nothing;
  nothing.passed = true;
  writePalpationCsv("a,\"b\"", {nothing}, folder / "trials.csv");
  const std::string csv = slurp(folder / "trials.csv"), row = csv.substr(csv.find('\n') + 1);
  EXPECT_EQ(
      row,
      "\"a,\"\"b\"\"\",0,1,0,1,,0,0,0,0,0,0,0,0,0,0,0,0,0,no pattern,0,0,0,0,0,,0,0,0,,,1,0\n");
  EXPECT_THROW(writePalpationCsv("P", {}, folder / "missing" / "trials.csv"), Error);
}

}  // namespace
}  // namespace palpa::report
