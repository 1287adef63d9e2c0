#include "calibration/camera_calibration.h"

#include <array>
#include <cmath>

#include "board_views.h"
#include "tests/support/complaint.h"

namespace palpa::calibration {
namespace {

using palpa::test::complaint;
using palpa::test::says;
using test::boardViews;
using test::webcam;

CameraCalibration calibrated(const std::vector<BoardView>& views) {
  return calibrateCamera(views, 640, 480);
}

std::string complaintOf(const std::vector<BoardView>& views) {
  return complaint([&] { calibrated(views); });
}

std::array<double, kLensNumbers> numbersOf(const CameraModel& m) {
  return {m.fx,
          m.fy,
          m.cx,
          m.cy,
          m.distortion[0],
          m.distortion[1],
          m.distortion[2],
          m.distortion[3],
          m.distortion[4]};
}

TEST(CameraCalibration, OfPerfectCornersIsExact) {
  const CameraCalibration found = calibrated(boardViews({}));
  for (std::size_t k = 0; k < kLensNumbers; ++k)
    EXPECT_NEAR(numbersOf(found.model)[k], numbersOf(webcam())[k], 1e-6) << k;
  EXPECT_LT(found.model.rms_px, 1e-8);
  EXPECT_EQ(found.fit.outliers(), 0);
  EXPECT_TRUE(found.leftOut().empty());
}

TEST(CameraCalibration, StatesItsErrorRightly) {
  int inside = 0, all = 0;
  for (unsigned seed = 1; seed <= 20; ++seed) {
    const CameraCalibration found = calibrated(boardViews({.noise = 0.1, .seed = seed}));
    EXPECT_EQ(found.determined, kLensNumbers);
    for (std::size_t k = 0; k < kLensNumbers; ++k, ++all) {
      inside += std::abs(numbersOf(found.model)[k] - numbersOf(webcam())[k]) <= found.half95[k];
      EXPECT_DOUBLE_EQ(found.sd[k] * found.sd[k],
                       found.covariance(static_cast<int>(k), static_cast<int>(k)));
    }
    EXPECT_NEAR(found.model.rms_px, 0.1 * std::sqrt(2), 0.015);
  }
  // The nine are correlated: about as many as 80 free ones, so three standard errors less than 95 %
  EXPECT_GE(inside, 0.86 * all);
}

TEST(CameraCalibration, ABadViewIsLeftOutAndNamed) {
  auto views = boardViews({.noise = 0.1});
  test::spoilView(&views[4]);
  const CameraCalibration found = calibrated(views);
  EXPECT_EQ(found.leftOut(), std::vector<std::string>{"view 5"});
  EXPECT_FALSE(found.views[4].used);
  EXPECT_GT(found.views[4].rms_px, 1);
  ASSERT_FALSE(found.warnings.empty());
  EXPECT_TRUE(says(found.warnings.front(), "view 5")) << found.warnings.front();
  EXPECT_NEAR(found.model.fx, 540, 2);
}

TEST(CameraCalibration, SingleWrongCornersAreLeftOutAndTheirViewsKept) {
  auto views = boardViews({.noise = 0.1});
  for (const std::size_t v : {0u, 3u, 7u})
    for (const std::size_t i : {5u, 20u, 41u}) views[v].pixels[i].x() += 12;
  const CameraCalibration found = calibrated(views);
  EXPECT_TRUE(found.leftOut().empty());
  for (const std::size_t v : {0u, 3u, 7u}) {
    for (const std::size_t i : {5u, 20u, 41u})
      EXPECT_FALSE(found.fit.good[54 * v + i]) << v << ' ' << i;
    EXPECT_GE(found.views[v].outliers, 3);
    EXPECT_LT(found.views[v].rms_px, 0.2);
  }
  EXPECT_LE(found.fit.outliers(), 9 + 5);  // of 639 good ones a thousandth lies beyond the cut
  EXPECT_GT(found.rms_all_px, 3 * found.model.rms_px);
  EXPECT_NEAR(found.model.fx, 540, 2);
}

TEST(CameraCalibration, KeepsEveryCornerWhenToldSo) {
  auto views = boardViews({.noise = 0.1});
  views[3].pixels[20].x() += 12;
  const CameraCalibration found = calibrateCamera(views, 640, 480, {.keep_all = true});
  EXPECT_EQ(found.fit.outliers(), 0);
  EXPECT_NEAR(found.rms_all_px, found.model.rms_px, 1e-12);
  EXPECT_GT(found.model.rms_px, 0.4);
}

TEST(CameraCalibration, TellsWhereCornersWereSeenAndHowTheBoardWasTilted) {
  const auto views = boardViews({.noise = 0.1});
  const CameraCalibration found = calibrated(views);
  int counted = 0, cells = 0;
  for (const auto& row : found.coverage)
    for (const int n : row) counted += n, cells += n > 0;
  int inside = 0;
  for (std::size_t v = 0, corner = 0; v < views.size(); ++v)
    for (const auto& p : views[v].pixels)
      inside += found.fit.good[corner++] && p.x() >= -0.5 && p.y() >= -0.5 && p.x() < 639.5 &&
                p.y() < 479.5;
  EXPECT_EQ(counted, inside);
  EXPECT_DOUBLE_EQ(found.covered, cells / 48.0);
  EXPECT_TRUE(found.warnings.empty()) << found.warnings.front();
  for (std::size_t v = 0; v < views.size(); ++v)
    EXPECT_NEAR(found.views[v].tilt, 0.3 * (1 + 0.7 * std::sin(1.0 * static_cast<double>(v))), 0.01)
        << v;
  EXPECT_GT(found.tilt_spread, 0.2);
}

TEST(CameraCalibration, CornersInTheMiddleOnlyAreNoErrorButAWarning) {
  const CameraCalibration found = calibrated(
      boardViews({.noise = 0.1, .tilt = 0.4, .distance = 0.8, .wander = 0.05, .count = 20}));
  ASSERT_FALSE(found.warnings.empty());
  EXPECT_TRUE(says(found.warnings.front(), "of the picture only")) << found.warnings.front();
  EXPECT_EQ(found.coverage[0][0], 0);
  EXPECT_NEAR(found.model.fx, 540, 4 * found.sd[0]);
  // Where not all of the distortion could be told, that is said, and the rest is known to be held.
  if (found.determined < kLensNumbers) {
    EXPECT_TRUE(says(found.warnings.back(), "held at 0"));
    EXPECT_EQ(found.model.distortion[4], 0);
    EXPECT_EQ(found.sd[8], 0);
  }
}

TEST(CameraCalibration, TooFewParallelAndDifferingViewsAreNamed) {
  EXPECT_TRUE(says(complaintOf({}), "0 views are too few"));
  EXPECT_TRUE(says(complaintOf(boardViews({.noise = 0.1, .count = 3})), "3 views are too few"));
  const std::string parallel = complaintOf(boardViews({.noise = 0.1, .tilt = 0}));
  EXPECT_TRUE(says(parallel, "from the same side")) << parallel;
  auto differing = boardViews({.noise = 0.1});
  differing[6].p_W = test::chessboardCorners(0.03);
  const std::string boards = complaintOf(differing);
  EXPECT_TRUE(says(boards, "boards that differ") && says(boards, "view 7")) << boards;
}

TEST(CameraCalibration, ViewsThatCannotBeAreNamed) {
  const auto good = boardViews({.noise = 0.1});
  auto views = good;
  views[2].pixels[7].x() = std::nan("");
  EXPECT_TRUE(says(complaintOf(views), "view 3 is not a number"));
  views = good;
  views[2].pixels.pop_back();
  EXPECT_TRUE(says(complaintOf(views), "53 corners in the picture and 54 on the board"));
  views = good;
  views[2].pixels.resize(6);
  views[2].p_W.resize(6);
  EXPECT_TRUE(says(complaintOf(views), "too few"));
  views[2].pixels = {good[2].pixels.begin(), good[2].pixels.begin() + 9};
  views[2].p_W = {good[2].p_W.begin(), good[2].p_W.begin() + 9};
  EXPECT_TRUE(says(complaintOf(views), "on one line"));
  views = good;
  views[2].p_W[3].z() = 0.01;
  EXPECT_TRUE(says(complaintOf(views), "not flat"));
}

TEST(CameraCalibration, FourOfTenGrossErrorsAreNamed) {
  for (unsigned seed = 1; seed <= 3; ++seed) {
    auto views = boardViews({.noise = 0.2, .seed = seed});
    test::spoilCorners(&views, 0.4, seed);
    const std::string words = complaintOf(views);
    EXPECT_TRUE(says(words, "of the corners do not fit the others")) << words;
  }
}

}  // namespace
}  // namespace palpa::calibration
