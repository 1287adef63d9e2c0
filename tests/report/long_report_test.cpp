#include <gtest/gtest.h>

#include <filesystem>
#include <opencv2/imgcodecs.hpp>

#include "synthetic_palpation.h"
#include "synthetic_report.h"
#include "tests/support/live_bytes.h"

/// A report of a thousand trials is written as one of one trial is.
namespace palpa::report {
namespace {

using namespace test;
namespace fs = std::filesystem;

constexpr std::int64_t kSlack = 1'000'000;  // bytes

/// Takes the samples out of the pages; what is left is the report of a session.
template <typename Sample, typename Report, typename Number>
Report fromCourses(Report report, Number number) {
  std::vector<std::pair<int, std::vector<Sample>>> all;
  for (auto& page : report.trials) all.emplace_back(number(page), std::exchange(page.samples, {}));
  report.courses = [all](const auto& draw) {
    for (const auto& [trial, samples] : all) draw(trial, samples);
  };
  return report;
}

SessionReport needleCourses(int trials) {
  return fromCourses<assess::TrialSample>(
      syntheticReport(trials), [](const TrialPage& page) { return page.assessment.trial; });
}

std::string bytesOf(const SessionReport& report, const std::string& name) {
  const fs::path file = freshFolder(name) / "report.html";
  writeReport(report, file);
  return slurp(file);
}

TEST(LongReport, IsTheSameFromPagesAndFromCourses) {
  EXPECT_EQ(bytesOf(needleCourses(4), "courses"), bytesOf(syntheticReport(4), "pages"));
  const auto written = [](const PalpationReport& report, const std::string& name) {
    const fs::path file = freshFolder(name) / "report.html";
    writePalpationReport(report, file);
    return slurp(file);
  };
  const PalpationReport pages = syntheticPalpation(3);
  const auto number = [](const PalpationPage& page) { return page.assessment.facts.trial; };
  EXPECT_EQ(written(fromCourses<assess::PalpationSample>(pages, number), "palpation_courses"),
            written(pages, "palpation_pages"));
}

/// As after a session in which trials were lost on the way to the evidence, or one was not ended.
TEST(LongReport, ATrialWithoutACourseHasNone_ACourseWithoutAPageIsLeftOut) {
  SessionReport pages = syntheticReport(4), some = needleCourses(4);
  const auto all = some.courses;
  some.courses = [all](const auto& draw) {
    all([&](int trial, const std::vector<assess::TrialSample>& samples) {
      if (trial != 1 && trial != 3) draw(trial, samples);
    });
    draw(5, {});
  };
  for (const std::size_t i : {0u, 2u}) pages.trials[i].samples.clear();
  EXPECT_EQ(bytesOf(some, "some"), bytesOf(pages, "pages"));
}

std::int64_t mostHeld(const SessionReport& report) {
  const fs::path file = freshFolder("held") / "report.html";
  const std::int64_t before = LiveBytes::now();
  LiveBytes::note();
  writeReport(report, file);
  return LiveBytes::peak() - before;
}

TEST(LongReport, IsNeverHeldWhole) {
  const SessionReport brief = needleCourses(2), wide = needleCourses(130);
  const std::int64_t of_brief = mostHeld(brief), of_wide = mostHeld(wide);
  const auto size = static_cast<std::int64_t>(bytesOf(wide, "wide").size());
  std::printf("2 trials take %.0f kB, 130 trials %.0f kB; their page has %.0f kB\n",
              1e-3 * of_brief, 1e-3 * of_wide, 1e-3 * size);
  EXPECT_GT(size, 3 * kSlack);  // else nothing is shown
  EXPECT_LT(of_wide, of_brief + kSlack);
}

/// With the grain of a camera in its pictures, five of each trial.
TEST(LongReport, OfEightTrialsCanBeMailed) {
  const fs::path folder = freshFolder("mailed");
  cv::Mat grain(720, 1280, CV_8UC3);
  cv::randn(grain, cv::Scalar(120, 140, 160), cv::Scalar(6, 6, 6));
  cv::imwrite((folder / "view.png").string(), grain);
  SessionReport report = syntheticReport(8);
  for (TrialPage& page : report.trials)
    page.pictures.assign(5, {folder / "view.png", "Vein entered", 1});
  writeReport(report, folder / "report.html");
  EXPECT_LT(fs::file_size(folder / "report.html"), 1'000'000u);
  const std::string page = slurp(folder / "report.html"), sign = "data:image/webp";
  int carried = 0;
  for (std::size_t at = page.find(sign); at != std::string::npos; at = page.find(sign, at + 1))
    ++carried;
  EXPECT_EQ(carried, 40);
}

}  // namespace
}  // namespace palpa::report
