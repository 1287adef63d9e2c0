#include <gtest/gtest.h>

#include "synthetic_verdict.h"
#include "well_formed.h"

namespace palpa::report {
namespace {

using namespace test;

std::string pageOf(const SessionReport& report, const std::string& name) {
  const auto file = freshFolder(name) / "report.html";
  writeReport(report, file);
  return slurp(file);
}

void expectOn(const std::string& page, std::initializer_list<const char*> words) {
  for (const char* one : words) EXPECT_NE(page.find(one), std::string::npos) << one;
}

TEST(CompetencePage, TellsErrorsVerdictAndChecklistAfterTheSummary) {
  const std::string page = pageOf(judgedReport(), "competence");
  EXPECT_EQ(faultOf(page), "");
  expectOn(page, {"toward the head &lt;there&gt;.", "Fail (simulated)",
                  "Critical error: the pleura was punctured.", "1 trial cannot certify anybody",
                  "Advanced under suction: 20 % (at least 50 %)", "✗ not done", "□ not judged",
                  "– did not arise", "The dash-dotted line is an expert"});
  EXPECT_LT(page.find("Errors of technique"), page.find("Pass or fail"));
  EXPECT_LT(page.find("Pass or fail"), page.find("<h3>Score"));
}

TEST(CompetencePage, PracticeHasErrorsAndNoVerdict) {
  const std::string page = pageOf(syntheticReport(1), "competence_practice");
  expectOn(page, {"None of the six common errors of this procedure was made."});
  EXPECT_EQ(page.find("Pass or fail"), std::string::npos);
}

TEST(RatingForms, StandForThemselvesOnPaper) {
  for (const bool blank : {true, false}) {
    const auto file = freshFolder("form") / "form.html";
    writeRatingForm(madeUpForm(blank), file);
    const std::string page = slurp(file);
    EXPECT_EQ(faultOf(page), "");
    EXPECT_EQ(page.find("<script"), std::string::npos);
    expectOn(page, {"Infraclavicular access", "Global rating of a needle procedure", "size:A4"});
    EXPECT_EQ(page.find("T&lt;1&gt; (simulated)") == std::string::npos, blank);
    EXPECT_EQ(page.find("simulator: not done, Advanced under suction") == std::string::npos, blank);
  }
}

TEST(RatingForms, TheSheetNamesEveryItemOnce) {
  const std::string sheet = answerSheet(shippedChecklist(), &shippedGlobal());
  EXPECT_TRUE(competence::parseAnswers(sheet, "form.csv", shippedChecklist(), &shippedGlobal())
                  .checklist.empty());
  for (const competence::ChecklistItem& item : shippedChecklist().items)
    EXPECT_NE(sheet.find("\n" + item.id + ",\n"), std::string::npos) << item.id;
  for (const competence::RatingItem& item : shippedGlobal().items)
    EXPECT_NE(sheet.find("\n" + item.id + ",\n"), std::string::npos) << item.id;
}

}  // namespace
}  // namespace palpa::report
