#include <gtest/gtest.h>

#include <cstdlib>
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

/// Of a sheet at 10 dots an inch: how far down there is something on it, a share of its height.
double usedOf(const std::filesystem::path& pgm) {
  std::ifstream file(pgm, std::ios::binary);
  std::string magic;
  int width = 0, height = 0, white = 0;
  file >> magic >> width >> height >> white;
  file.get();
  const std::string gray((std::istreambuf_iterator<char>(file)), std::istreambuf_iterator<char>());
  int last = 0;
  for (int i = 0; i < width * height; ++i)
    if (static_cast<unsigned char>(gray.at(static_cast<std::size_t>(i))) < 240) last = i / width;
  return static_cast<double>(last) / height;
}

/// No sheet is empty, or holds what is left of the one before.
TEST_F(Pages, OnPaperNoSheetIsNearlyEmpty) {
  const auto folder = test::freshFolder("browser_paper");
  writeReport(test::syntheticReport(1), folder / "needle.html");
  writeReport(test::judgedReport(), folder / "judged.html");
  writePalpationReport(test::syntheticPalpation(2), folder / "palpation.html");
  writeSearchReport(test::searchedSession(), folder / "search.html");
  for (const std::string page : {"needle", "judged", "palpation", "search"}) {
    browser_->show(1100);
    browser_->open(folder / (page + ".html"));
    browser_->print(folder / (page + ".pdf"));
    const std::string sheets = (folder / page).string();
    ASSERT_EQ(std::system(("pdftoppm -r 10 -gray '" + sheets + ".pdf' '" + sheets + "'").c_str()),
              0);
    int count = 0;
    for (const auto& one : std::filesystem::directory_iterator(folder)) {
      const std::string name = one.path().filename().string();
      if (one.path().extension() != ".pgm" || name.rfind(page + '-', 0) != 0) continue;
      EXPECT_GT(usedOf(one.path()), 0.2) << name;
      ++count;
    }
    EXPECT_GT(count, 0) << page;
  }
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
