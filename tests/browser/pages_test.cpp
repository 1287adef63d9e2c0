#include <gtest/gtest.h>

#include <fstream>

#include "tests/browser/page_faults.h"
#include "tests/report/synthetic_palpation.h"
#include "tests/report/synthetic_practice.h"
#include "tests/report/synthetic_search_report.h"
#include "tests/report/synthetic_verdict.h"

namespace palpa::report {
namespace {

/// One browser for all tests of this process.
class Pages : public testing::Test {
 protected:
  static void SetUpTestSuite() {
    if (palpa::test::Browser::whyNot().empty()) browser_ = std::make_unique<palpa::test::Browser>();
  }
  static void TearDownTestSuite() { browser_.reset(); }
  void SetUp() override {
    if (!browser_) GTEST_SKIP() << palpa::test::Browser::whyNot();
  }
  static void expectNoFaults(const std::filesystem::path& page) {
    for (const std::string& fault : palpa::test::faultsOf(*browser_, page)) ADD_FAILURE() << fault;
  }
  static inline std::unique_ptr<palpa::test::Browser> browser_;
};

TEST_F(Pages, OfNeedleSessions) {
  const auto folder = test::freshFolder("browser");
  writeReport(test::syntheticReport(1), folder / "one.html");
  writeReport(test::syntheticReport(10), folder / "ten.html");
  expectNoFaults(folder / "one.html");
  expectNoFaults(folder / "ten.html");
}

TEST_F(Pages, OfVerdictsAndForms) {
  const auto folder = test::freshFolder("browser_verdict");
  writeReport(test::judgedReport(), folder / "judged.html");
  writeRatingForm(test::madeUpForm(true), folder / "blank.html");
  writeRatingForm(test::madeUpForm(false), folder / "form.html");
  for (const char* page : {"judged.html", "blank.html", "form.html"}) expectNoFaults(folder / page);
}

TEST_F(Pages, OfPractice) {
  const auto folder = test::freshFolder("browser_practice");
  writeTraineeReport(test::madeUpTrainee(5), folder / "few.html");
  writeTraineeReport(test::madeUpTrainee(30), folder / "trainee.html");
  writeCohortReport(test::madeUpCohort(8, 20), folder / "cohort.html");
  for (const char* page : {"few.html", "trainee.html", "cohort.html"})
    expectNoFaults(folder / page);
}

TEST_F(Pages, OfPalpationAndSearch) {
  const auto folder = test::freshFolder("browser_touch");
  writePalpationReport(test::syntheticPalpation(3), folder / "palpation.html");
  writeSearchReport(test::searchedSession(), folder / "search.html");
  for (const char* page : {"palpation.html", "search.html"}) expectNoFaults(folder / page);
}

/// The judge itself: it finds each of these.
TEST_F(Pages, FaultsAreFound) {
  const auto file = test::freshFolder("browser_faults") / "bad.html";
  std::ofstream(file)
      << R"(<!doctype html><meta charset="utf-8"><title>x</title><body style="margin:0">
<div style="width:3000px">broad</div><p style="font-size:6px">tiny</p><p style="color:#eee">pale</p>
<svg width="300" height="50" viewBox="0 0 300 50"><text x="10" y="20">one</text><text x="14" y="20">two</text><text x="290" y="40">outside</text></svg>
<script>console.error('broken')</script></body>)";
  std::string all;
  for (const std::string& fault : palpa::test::faultsOf(*browser_, file)) all += fault + "\n";
  for (const char* expected :
       {"wider than the screen", "type of 6.0 px: tiny", "hardly legible: pale",
        "run into each other: \"one\" and \"two\"", "runs out of its drawing: outside", "broken"})
    EXPECT_NE(all.find(expected), std::string::npos) << expected << " in\n" << all;
}

}  // namespace
}  // namespace palpa::report
