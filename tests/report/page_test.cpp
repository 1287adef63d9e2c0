#include <gtest/gtest.h>

#include "anatomy/base/error.h"
#include "apps/report/page/html.h"
#include "apps/report/page/style.h"
#include "synthetic_report.h"
#include "well_formed.h"

namespace palpa::report {
namespace {

using namespace test;
namespace fs = std::filesystem;

std::string written(const SessionReport& report, const std::string& name) {
  const fs::path file = freshFolder(name) / "report.html";
  writeReport(report, file);
  return slurp(file);
}

bool contains(const std::string& page, const std::string& text) {
  return page.find(text) != std::string::npos;
}

TEST(Page, IsWellFormedWithOneTrialAndWithTen) {
  EXPECT_EQ(faultOf(written(syntheticReport(1), "one")), "");
  EXPECT_EQ(faultOf(written(syntheticReport(10), "ten")), "");
}

TEST(Page, CheckerFindsFaults) {
  EXPECT_NE(faultOf("<p><b>x</p></b>"), "");
  EXPECT_NE(faultOf("<p>a & b</p>"), "");
  EXPECT_NE(faultOf("<p>"), "");
  EXPECT_EQ(faultOf("<p>a &amp; b<img src=\"x\"/></p>"), "");
}

TEST(Page, StandsWithNothingInIt) {
  EXPECT_EQ(faultOf(written(SessionReport{}, "empty")), "");
  SessionReport report;
  report.trials.emplace_back();
  const double nan = std::nan("");
  report.trials.emplace_back();
  auto& odd = report.trials.back();
  odd.assessment.values.time_ms = nan;
  odd.assessment.moments = {{nan, "lung", "never"}, {-3, "vein", "before the start"}};
  odd.assessment.spans = {{"backwards", assess::SpanKind::bad, 5, 2}};
  odd.assessment.penalties = {{"X", "t", "s", nan, nan, nan, {nan}}};
  odd.assessment.closest_pleura_mm = nan;
  odd.samples.resize(3);
  odd.samples[1].f_contact = odd.samples[2].t_s = nan;
  const std::string page = written(report, "odd");
  EXPECT_EQ(faultOf(page), "");
  EXPECT_FALSE(contains(page, "nan"));
  EXPECT_FALSE(contains(page, "inf\""));
}

TEST(Page, TellsEachPenaltyWithItsReason) {
  const SessionReport report = syntheticReport(1);
  const std::string page = written(report, "penalties");
  for (const auto& penalty : report.trials[0].assessment.penalties) {
    EXPECT_TRUE(contains(page, penalty.title)) << penalty.title;
    EXPECT_TRUE(contains(page, escaped(penalty.sentence))) << penalty.sentence;
  }
  EXPECT_TRUE(contains(page, "7 samples × 500"));
  EXPECT_TRUE(contains(page, "Most points: Lung touched (3500.0) and Time (315.2)."));
  EXPECT_TRUE(contains(page, "at 24.9 s, 25.6 s"));
  EXPECT_LT(page.find("Lung touched</strong>"), page.find("Time</strong>"));
}

TEST(Page, TheLargestPenaltyIsToldOnce) {
  SessionReport report = syntheticReport(1);
  report.trials[0].assessment.summary = "Vein reached. Largest penalty: lung (3500 points).";
  const std::string page = written(report, "once");
  EXPECT_TRUE(contains(page, "<p>Then: Time (315.2).</p>"));
  EXPECT_FALSE(contains(page, "Most points: "));
}

TEST(Page, TellsWhereTheTaskStands) {
  SessionReport report = syntheticReport(1);
  const std::string page = written(report, "stands");
  EXPECT_TRUE(contains(page, "Where this task stands"));
  EXPECT_TRUE(contains(page, report.taxonomy[0].value));
  report.taxonomy.clear();  // an older recording's
  EXPECT_FALSE(contains(written(report, "stands_not"), "Where this task stands"));
}

TEST(Page, TellsNearMissesWithTheirMoments) {
  const std::string page = written(syntheticReport(1), "near");
  EXPECT_TRUE(contains(page, "−1.3 mm"));
  EXPECT_TRUE(contains(page, "at 18.5 s"));
  EXPECT_TRUE(contains(page, "6.4 mm"));
}

std::string lower(std::string text) {
  for (char& c : text) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return text;
}

TEST(Page, SaysSimulatedIfAndOnlyIfItIs) {
  SessionReport report = syntheticReport(2);
  report.trainee = "P07";
  EXPECT_TRUE(contains(written(report, "sim"), "SIMULATED"));
  report.simulated = false;  // one simulated trial is enough
  EXPECT_TRUE(contains(written(report, "sim"), "SIMULATED"));
  for (auto& trial : report.trials) trial.assessment.simulated = false;
  EXPECT_FALSE(contains(lower(written(report, "sim")), "simulated"));
}

TEST(Page, TreatsNamesAsTextNeverAsMarkup) {
  SessionReport report = syntheticReport(2);
  const std::string evil = "<script>alert('x')</script>\"&\x01\xff";
  report.title = report.trainee = report.when = evil;
  report.station = {{evil, evil, evil}};
  report.notes = {{"Software", evil, ""}};
  report.remarks = {{1, 2, evil}};
  report.next = {evil};
  for (auto& trial : report.trials) {
    auto& a = trial.assessment;
    a.summary = evil;
    a.penalties = {{evil, evil, evil, 1, 1, 1, {}}};
    a.spans = {{evil, assess::SpanKind::phase, 0, 9}, {evil, assess::SpanKind::bad, 0, 9}};
    a.moments = {{1, evil, evil}};
    trial.pictures = {{evil, evil, 1}};
  }
  const std::string page = written(report, "evil");
  EXPECT_EQ(faultOf(page), "");
  EXPECT_FALSE(contains(page, "<script"));
  EXPECT_FALSE(contains(page, "alert('x')"));
  EXPECT_TRUE(
      contains(page, "&lt;script&gt;alert(&#39;x&#39;)&lt;/script&gt;&quot;&amp;\xef\xbf\xbd"));
}

TEST(Page, NeedsNoNetworkAndNoScript) {
  std::string page = written(syntheticReport(10), "offline");
  const std::string xmlns = "xmlns=\"http://www.w3.org/2000/svg\"";  // a name, nothing is loaded
  for (auto at = page.find(xmlns); at != std::string::npos; at = page.find(xmlns)) {
    page.erase(at, xmlns.size());
  }
  for (const char* load :
       {"http://", "https://", "<script", "<link", "@import", "url(", "<iframe"}) {
    EXPECT_FALSE(contains(page, load)) << load;
  }
}

/// What a mailed page begins with; how it was done is folded at its end.
TEST(Page, SaysWhenWhatWasNotedAndWhatToPractise) {
  SessionReport report = syntheticReport(2);
  report.when = "30 November 2026, 09:14";
  report.remarks = {{2, 14.3, "left hand not in the field"}, {0, 0, "a fire drill"}};
  report.next = {"rest the hand on the patient"};
  const std::string page = written(report, "noted");
  EXPECT_EQ(faultOf(page), "");
  for (const char* words : {"30 November 2026, 09:14", "Noted by the educator", "Trial 2, 14.3 s",
                            "left hand not in the field", "a fire drill",
                            "Practise next:", "rest the hand on the patient."})
    EXPECT_TRUE(contains(page, words)) << words;
  const std::size_t folded = page.find("<details class=\"card appendix\"");
  ASSERT_NE(folded, std::string::npos);
  EXPECT_LT(page.find("Noted by the educator"), page.find("id=\"trial-1\""));
  EXPECT_LT(folded, page.find("Where this task stands"));
  EXPECT_FALSE(contains(written(syntheticReport(1), "unnoted"), "Noted by the educator"));
}

TEST(Page, SameInputGivesTheSameBytes) {
  EXPECT_EQ(written(syntheticReport(3), "same"), written(syntheticReport(3), "same"));
}

TEST(Page, LeavesNothingHalfWritten) {
  const fs::path folder = freshFolder("unwritable");
  EXPECT_THROW(writeReport(syntheticReport(), folder / "missing" / "report.html"), Error);
  fs::create_directories(folder / "report.html");  // in the way
  EXPECT_THROW(writeReport(syntheticReport(), folder / "report.html"), Error);
  EXPECT_EQ(std::distance(fs::directory_iterator(folder), {}), 1) << "a part is left";
}

TEST(Page, HasOverviewForSeveralTrialsOnly) {
  EXPECT_FALSE(contains(written(syntheticReport(1), "overview"), "All trials"));
  EXPECT_TRUE(contains(written(syntheticReport(2), "overview"), "All trials"));
}

TEST(Page, StyleBalancesItsBraces) {
  const std::string css = styleSheet();
  EXPECT_EQ(std::count(css.begin(), css.end(), '{'), std::count(css.begin(), css.end(), '}'));
}

}  // namespace
}  // namespace palpa::report
