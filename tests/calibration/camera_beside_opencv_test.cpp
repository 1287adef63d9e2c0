#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <functional>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>

#include "board_views.h"
#include "calibration/camera_calibration.h"
#include "tests/support/test_data.h"

/// Our camera calibration beside cv::calibrateCamera on the same corners.
namespace palpa::calibration {
namespace {

using test::boardViews;
using test::calibratedByOpenCv;
using Estimator = std::function<CameraModel(const std::vector<BoardView>&)>;

CameraModel byUs(const std::vector<BoardView>& views) {
  return calibrateCamera(views, 640, 480).model;
}
CameraModel byOpenCv(const std::vector<BoardView>& views) {
  return calibratedByOpenCv(views, 640, 480);
}

/// Rms error of fx fy cx cy over ten sets, px.
double cameraError(const Estimator& estimate,
                   const std::function<void(std::vector<BoardView>*, unsigned seed)>& spoil) {
  constexpr unsigned kSets = 10;
  const CameraModel truth = test::webcam();
  double squares = 0;
  for (unsigned seed = 1; seed <= kSets; ++seed) {
    std::vector<BoardView> views = boardViews({.noise = 0.2, .seed = seed});
    spoil(&views, seed);
    const CameraModel m = estimate(views);
    squares += Eigen::Vector4d(m.fx - truth.fx, m.fy - truth.fy, m.cx - truth.cx, m.cy - truth.cy)
                   .squaredNorm() /
               4;
  }
  return std::sqrt(squares / kSets);
}

// Simulated corners, truth known. Clean ones: both alike (ours leaves out a thousandth of the
// corners). With 5 % gross errors or one bad view: ours is better, OpenCV's has no defence.
TEST(CameraBesideOpenCv, OfSimulatedCornersIsAsGoodAndWithGrossErrorsBetter) {
  const auto clean = [](std::vector<BoardView>*, unsigned) {};
  const auto gross = [](std::vector<BoardView>* views, unsigned seed) {
    test::spoilCorners(views, 0.05, seed);
  };
  const auto bad_view = [](std::vector<BoardView>* views, unsigned seed) {
    test::spoilView(&(*views)[seed % views->size()]);
  };
  const double ours[] = {cameraError(byUs, clean), cameraError(byUs, gross),
                         cameraError(byUs, bad_view)};
  const double theirs[] = {cameraError(byOpenCv, clean), cameraError(byOpenCv, gross),
                           cameraError(byOpenCv, bad_view)};
  std::printf(
      "simulated, rms error of fx fy cx cy: clean ours %.3f OpenCV %.3f px; 5 %% gross errors "
      "%.3f, %.3f px; a bad view %.3f, %.3f px\n",
      ours[0], theirs[0], ours[1], theirs[1], ours[2], theirs[2]);
  EXPECT_LT(ours[0], 1.05 * theirs[0]);
  EXPECT_LT(ours[1], 0.5 * theirs[1]);
  EXPECT_LT(ours[2], 0.5 * theirs[2]);
  EXPECT_LT(ours[1], 1.5 * ours[0]);
  EXPECT_LT(ours[2], 1.5 * ours[0]);
}

/// OpenCV's sample pictures; corners located in squares of 2 `half_window` + 1 px.
std::vector<BoardView> pictures(int half_window) {
  std::vector<BoardView> views;
  for (int i = 1; i <= 14; ++i) {
    char name[32];
    std::snprintf(name, sizeof name, "left%02d.jpg", i);
    const std::filesystem::path file = testData("chessboard") / name;
    if (!std::filesystem::exists(file)) continue;
    const cv::Mat picture = cv::imread(file.string(), cv::IMREAD_GRAYSCALE);
    std::vector<cv::Point2f> corners;
    if (!cv::findChessboardCorners(picture, {9, 6}, corners)) continue;
    cv::cornerSubPix(picture, corners, {half_window, half_window}, {-1, -1},
                     {cv::TermCriteria::EPS | cv::TermCriteria::COUNT, 30, 0.01});
    BoardView view{name, test::chessboardCorners(), {}};
    for (const cv::Point2f& p : corners) view.pixels.emplace_back(p.x, p.y);
    views.push_back(view);
  }
  return views;
}

/// Rms distance of a view's corners from where the camera predicts them for the pose that suits it
/// best, px.
double rmsOfUnseen(const BoardView& view, const CameraModel& m) {
  std::vector<cv::Point3d> board;
  std::vector<cv::Point2d> seen, predicted;
  for (const Vec3& p : view.p_W) board.emplace_back(p.x(), p.y(), p.z());
  for (const auto& p : view.pixels) seen.emplace_back(p.x(), p.y());
  const cv::Matx33d K(m.fx, 0, m.cx, 0, m.fy, m.cy, 0, 0, 1);
  const cv::Mat k(1, 5, CV_64F, const_cast<double*>(m.distortion.data()));
  cv::Mat turn, shift;
  cv::solvePnP(board, seen, K, k, turn, shift);
  cv::projectPoints(board, turn, shift, K, k, predicted);
  double squares = 0;
  for (std::size_t i = 0; i < seen.size(); ++i)
    squares += (seen[i] - predicted[i]).dot(seen[i] - predicted[i]);
  return std::sqrt(squares / static_cast<double>(seen.size()));
}

/// For each view the camera of the others.
std::vector<CameraModel> camerasOfOthers(const Estimator& estimate,
                                         const std::vector<BoardView>& views) {
  std::vector<CameraModel> cameras;
  for (std::size_t v = 0; v < views.size(); ++v) {
    std::vector<BoardView> others = views;
    others.erase(others.begin() + static_cast<std::ptrdiff_t>(v));
    cameras.push_back(estimate(others));
  }
  return cameras;
}

double leftOutRms(const std::vector<CameraModel>& cameras, const std::vector<BoardView>& views) {
  double squares = 0;
  for (std::size_t v = 0; v < views.size(); ++v)
    squares += std::pow(rmsOfUnseen(views[v], cameras[v]), 2) / static_cast<double>(views.size());
  return std::sqrt(squares);
}

void say(const char* what, const CameraModel& m) {
  std::printf("%s: f %.2f %.2f, centre %.2f %.2f, rms %.3f px\n", what, m.fx, m.fy, m.cx, m.cy,
              m.rms_px);
}

// The figures that come with OpenCV's pictures: f 535.916, centre 342.283 235.571, rms 0.393 px.
// They count every corner, as we do when told so.
TEST(CameraBesideOpenCv, OfRealPicturesWithEveryCornerMeetsThePublishedFigures) {
  PALPA_NEED_DATA(testData("chessboard/left01.jpg"));
  const std::vector<BoardView> views = pictures(11);
  ASSERT_EQ(views.size(), 13u);
  const CameraCalibration found = calibrateCamera(views, 640, 480, {.keep_all = true});
  say("real pictures, every corner, ours", found.model);
  EXPECT_NEAR(found.model.fx, 535.916, 0.003 * 535.916);
  EXPECT_NEAR(found.model.fy, 535.916, 0.003 * 535.916);
  EXPECT_NEAR(found.model.cx, 342.283, 2);
  EXPECT_NEAR(found.model.cy, 235.571, 2);
  EXPECT_LE(found.rms_all_px, 0.42);
  const CameraModel theirs = byOpenCv(views);
  say("real pictures, every corner, OpenCV", theirs);
  EXPECT_NEAR(found.model.fx, theirs.fx, 0.05);
  EXPECT_NEAR(found.rms_all_px, theirs.rms_px, 1e-3);
}

// Those published figures come from some corners that were not found well: among the narrow squares
// of left02.jpg a window of 23 px reaches past the neighbours. With windows of 11 px OpenCV itself
// says f 532.8 and rms 0.196 px. Ours leaves such corners out and is within a pixel of that from
// either corners. Which is better, by rms of views left out: from badly found corners ours (0.205
// px against 0.213 px; on the bad corners themselves both alike); from well found ones OpenCV's by
// 2 %, nearly all of it in left06.jpg, without which ours leaves out one more corner.
TEST(CameraBesideOpenCv, OfRealPicturesIsNotMisledByBadlyFoundCorners) {
  PALPA_NEED_DATA(testData("chessboard/left01.jpg"));
  const std::vector<BoardView> wide = pictures(11), narrow = pictures(5);
  ASSERT_EQ(wide.size(), 13u);
  ASSERT_EQ(narrow.size(), 13u);
  const CameraCalibration found = calibrateCamera(wide, 640, 480);
  say("real pictures, wide windows, ours", found.model);
  say("real pictures, narrow windows, ours", byUs(narrow));
  say("real pictures, narrow windows, OpenCV", byOpenCv(narrow));
  EXPECT_LE(found.model.rms_px, 0.42);
  EXPECT_LT(std::abs(found.model.fx - byOpenCv(narrow).fx), 1);
  EXPECT_GT(std::abs(byOpenCv(wide).fx - byOpenCv(narrow).fx), 2);
  EXPECT_NEAR(byUs(narrow).fx, byOpenCv(narrow).fx, 0.3);
  const auto ours_wide = camerasOfOthers(byUs, wide), theirs_wide = camerasOfOthers(byOpenCv, wide);
  const auto ours_narrow = camerasOfOthers(byUs, narrow),
             theirs_narrow = camerasOfOthers(byOpenCv, narrow);
  std::printf(
      "rms of left-out views, ours and OpenCV's: wide windows %.4f %.4f px on well found corners, "
      "%.4f %.4f px on their own; narrow windows %.4f %.4f px\n",
      leftOutRms(ours_wide, narrow), leftOutRms(theirs_wide, narrow), leftOutRms(ours_wide, wide),
      leftOutRms(theirs_wide, wide), leftOutRms(ours_narrow, narrow),
      leftOutRms(theirs_narrow, narrow));
  EXPECT_LT(leftOutRms(ours_wide, narrow), leftOutRms(theirs_wide, narrow));
  EXPECT_NEAR(leftOutRms(ours_narrow, narrow), leftOutRms(theirs_narrow, narrow), 0.01);
}

}  // namespace
}  // namespace palpa::calibration
