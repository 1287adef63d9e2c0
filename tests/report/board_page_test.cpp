#include "apps/report/paper/board_page.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <opencv2/imgcodecs.hpp>

#include "anatomy/base/error.h"
#include "ar/boards/board.h"
#include "tests/support/scratch_folder.h"

/// Printed boards, measured: what the camera will rely on.
namespace palpa::report {
namespace {

constexpr int kDpi = 300;
constexpr double kPxPerM = kDpi / 0.0254;

/// The page as the printer gets it.
cv::Mat printed(const std::string& spec, const std::string& paper, const std::string& ending,
                const test::ScratchFolder& folder) {
  const std::filesystem::path file = folder / ("board." + ending);
  writeBoardPage(ar::sheetOf(spec), {paper, spec, kDpi}, file);
  if (ending == "png") return cv::imread(file.string(), cv::IMREAD_GRAYSCALE);
  const std::string command = "pdftoppm -r " + std::to_string(kDpi) + " -gray -png -singlefile '" +
                              file.string() + "' '" + (folder / "page").string() + "'";
  EXPECT_EQ(std::system(command.c_str()), 0) << "poppler-utils";
  return cv::imread((folder / "page.png").string(), cv::IMREAD_GRAYSCALE);
}

/// Every two points as far apart on paper as on the board.
void expectTrue(const cv::Mat& page, const std::string& spec, std::size_t points,
                double tolerance_px) {
  const auto found = ar::makeBoard(spec, 1.0)->detect(page);
  ASSERT_EQ(found.size(), points) << spec;
  for (std::size_t i = 0; i < found.size(); i += 3) {
    const ar::BoardPoint &a = found[i], &b = found[(i + found.size() / 2) % found.size()];
    const Eigen::Vector2d on_board = kPxPerM * (b.p_W - a.p_W).head<2>(),
                          on_paper = b.pixel - a.pixel;
    EXPECT_NEAR(on_paper.x(), on_board.x(), tolerance_px) << spec;
    EXPECT_NEAR(on_paper.y(), -on_board.y(), tolerance_px) << spec;
  }
}

int longestRun(const cv::Mat& page, bool across) {
  int longest = 0;
  for (int i = 0; i < (across ? page.rows : page.cols); ++i) {
    int run = 0;
    for (int j = 0; j < (across ? page.cols : page.rows); ++j) {
      run = page.at<unsigned char>(across ? i : j, across ? j : i) < 128 ? run + 1 : 0;
      longest = std::max(longest, run);
    }
  }
  return longest;
}

class Printed : public testing::TestWithParam<const char*> {};

TEST_P(Printed, BoardsAreTrueToSizeAndSoAreTheBars) {
  const test::ScratchFolder folder("board_page");
  const std::string ending = GetParam();
  const cv::Mat tags = printed("tags:6x4:0.030:0.0075", "a4", ending, folder);
  EXPECT_NEAR(tags.cols, 297 / 25.4 * kDpi, 1);
  EXPECT_NEAR(tags.rows, 210 / 25.4 * kDpi, 1);
  expectTrue(tags, "tags:6x4:0.030:0.0075", 96, 0.7);
  EXPECT_NEAR(longestRun(tags, true), 0.1 * kPxPerM, 2);
  EXPECT_NEAR(longestRun(tags, false), 0.1 * kPxPerM, 2);
  expectTrue(printed("chessboard:9x6:0.025", "a3", ending, folder), "chessboard:9x6:0.025", 54,
             0.7);
  expectTrue(printed("charuco:7x5:0.030:0.022", "fit", ending, folder), "charuco:7x5:0.030:0.022",
             24, 0.7);
}

INSTANTIATE_TEST_SUITE_P(As, Printed, testing::Values("png", "pdf"),
                         [](const auto& one) { return std::string(one.param); });

TEST(BoardPage, WhatDoesNotFitIsRefused) {
  const test::ScratchFolder folder("board_page");
  const ar::Sheet large = ar::sheetOf("aprilgrid:6x6:0.088:0.3");
  EXPECT_THROW(writeBoardPage(large, {"a4", "", kDpi}, folder / "a.pdf"), UsageError);
  EXPECT_NO_THROW(writeBoardPage(large, {"fit", "", kDpi}, folder / "a.pdf"));
  EXPECT_THROW(writeBoardPage(large, {"fit", "", kDpi}, folder / "a.jpg"), UsageError);
  EXPECT_THROW(writeBoardPage(large, {"papyrus", "", kDpi}, folder / "a.pdf"), UsageError);
  EXPECT_THROW(
      writeBoardPage(ar::sheetOf("tags:6x4:0.010:0.0025"), {"fit", "", 30}, folder / "a.png"),
      UsageError);
  EXPECT_THROW(writeBoardPage(large, {"fit", "", kDpi}, folder / "nowhere/else/a.pdf"), Error);
}

}  // namespace
}  // namespace palpa::report
