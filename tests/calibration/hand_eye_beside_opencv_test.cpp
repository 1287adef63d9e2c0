#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <nlohmann/json.hpp>
#include <opencv2/calib3d.hpp>
#include <random>

#include "calibration/hand_eye.h"
#include "calibration/rotation.h"
#include "tests/support/test_data.h"

/// Ours beside OpenCV's closed form (cv::calibrateRobotWorldHandEye, Shah 2013): on drawn data with
/// a known truth, and on a real robot by samples left out.
namespace palpa::calibration {
namespace {

cv::Mat rotationMat(const Mat3& R) {
  cv::Mat m(3, 3, CV_64F);
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) m.at<double>(i, j) = R(i, j);
  return m;
}
cv::Mat shiftMat(const Vec3& p) { return (cv::Mat_<double>(3, 1) << p.x(), p.y(), p.z()); }

Pose poseFrom(const cv::Mat& R, const cv::Mat& t) {
  Mat3 m;
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) m(i, j) = R.at<double>(i, j);
  return makePose(nearestRotation(m), Vec3(t.at<double>(0), t.at<double>(1), t.at<double>(2)));
}

struct HandEyeAnswer {
  Pose X_EM, X_DC;
};

/// X_CM X_ME = X_CD X_DE.
HandEyeAnswer handEyeByOpenCv(const std::vector<HandEyeSample>& samples) {
  std::vector<cv::Mat> R_CM, t_CM, R_DE, t_DE;
  for (const HandEyeSample& s : samples) {
    R_CM.push_back(rotationMat(s.X_CM.rotation()));
    t_CM.push_back(shiftMat(s.X_CM.translation()));
    R_DE.push_back(rotationMat(s.X_DE.rotation()));
    t_DE.push_back(shiftMat(s.X_DE.translation()));
  }
  cv::Mat R_ME, t_ME, R_CD, t_CD;
  cv::calibrateRobotWorldHandEye(R_CM, t_CM, R_DE, t_DE, R_ME, t_ME, R_CD, t_CD,
                                 cv::CALIB_ROBOT_WORLD_HAND_EYE_SHAH);
  return {poseFrom(R_ME, t_ME).inverse(), poseFrom(R_CD, t_CD).inverse()};
}

HandEyeAnswer handEyeByOurs(const std::vector<HandEyeSample>& samples) {
  const HandEye found = calibrateHandEye(samples);
  return {found.X_EM, found.X_DC};
}

const Pose kTag = makePose(rotationOf(Vec3(0.2, 1.0, -0.4)), Vec3(0.02, 0.01, 0.05));
const Pose kCamera = makePose(rotationOf(Vec3(-2.0, 0.3, 0.8)), Vec3(0.4, -0.2, 0.6));

/// A device of 0.1 mm and 0.05 degrees, a tag at 0.6 m: 0.5 mm along the view, 0.1 mm across, 0.2
/// degrees. `gross`: of them one in ten off by centimetres.
std::vector<HandEyeSample> drawn(std::uint64_t seed, bool gross) {
  std::mt19937_64 bits(seed);
  const auto normal =
      [&bits] {  // sum of twelve uniform numbers: near enough, and the same on every machine
        double sum = -6;
        for (int i = 0; i < 12; ++i) sum += static_cast<double>(bits() >> 11) * 0x1p-53;
        return sum;
      };
  const auto normal3 = [&] {
    const double x = normal(), y = normal(), z = normal();
    return Vec3(x, y, z);
  };
  std::vector<HandEyeSample> samples;
  for (int i = 0; i < 30; ++i) {
    const Pose X_DE = makePose(rotationOf(0.4 * normal3()), 0.06 * normal3());
    Pose X_CM = kCamera.inverse() * X_DE * kTag;
    X_CM.linear() = X_CM.linear() * rotationOf(0.2 * kDegree * normal3());
    X_CM.translation() += 1e-4 * normal3() + 5e-4 * normal() * X_CM.translation().normalized();
    if (gross && i % 10 == 3) X_CM.translation() += 0.03 * normal3();
    samples.push_back({makePose(X_DE.linear() * rotationOf(0.05 * kDegree * normal3()),
                                X_DE.translation() + 1e-4 * normal3()),
                       X_CM});
  }
  return samples;
}

/// rms error of where the camera's working point lies in the base, m.
template <class Solver>
double rmsOfPlace(const Solver& solve, bool gross) {
  const Vec3 at_C(0, 0, 0.6);
  double squares = 0;
  constexpr int kSets = 20;
  for (int seed = 1; seed <= kSets; ++seed)
    squares += (solve(drawn(static_cast<std::uint64_t>(seed), gross)).X_DC * at_C - kCamera * at_C)
                   .squaredNorm() /
               kSets;
  return std::sqrt(squares);
}

/// Ours is better: with clean data because turn and shift, along and across the view, are weighted
/// by what they are worth; with gross errors by far.
TEST(HandEyeBesideOpenCv, OnDrawnData) {
  const double ours = rmsOfPlace(handEyeByOurs, false), theirs = rmsOfPlace(handEyeByOpenCv, false);
  const double ours_gross = rmsOfPlace(handEyeByOurs, true),
               theirs_gross = rmsOfPlace(handEyeByOpenCv, true);
  std::printf(
      "camera's place, mm rms: ours %.3f, OpenCV %.3f; with 10 %% gross errors ours %.3f, OpenCV "
      "%.3f\n",
      1e3 * ours, 1e3 * theirs, 1e3 * ours_gross, 1e3 * theirs_gross);
  EXPECT_LT(ours, theirs);
  EXPECT_LT(ours_gross, 0.2 * theirs_gross);
  EXPECT_LT(ours_gross, 1.5 * ours);
}

/// rms of where the tag is in samples that the solver has not seen, m.
template <class Solver>
double leftOutSamples(const std::vector<HandEyeSample>& all, const Solver& solve) {
  double squares = 0;
  for (std::size_t part = 0; part < 5; ++part) {
    std::vector<HandEyeSample> others;
    for (std::size_t i = 0; i < all.size(); ++i)
      if (i % 5 != part) others.push_back(all[i]);
    const HandEyeAnswer answer = solve(others);
    for (std::size_t i = part; i < all.size(); i += 5)
      squares += (answer.X_DC.inverse() * (all[i].X_DE * answer.X_EM.translation()) -
                  all[i].X_CM.translation())
                     .squaredNorm() /
                 static_cast<double>(all.size());
  }
  return std::sqrt(squares);
}

TEST(HandEyeBesideOpenCv, OnARealRobot) {
  const std::filesystem::path file = testData("handeye/pose_samples.json");
  PALPA_NEED_DATA(file);
  std::ifstream in(file);
  std::vector<HandEyeSample> all;
  const auto pose = [](const nlohmann::json& rows) {
    Pose X = Pose::Identity();
    for (std::size_t r = 0; r < 3; ++r)
      for (std::size_t c = 0; c < 4; ++c)
        X.matrix()(static_cast<Eigen::Index>(r), static_cast<Eigen::Index>(c)) =
            rows.at(r).at(c).get<double>();
    X.linear() = nearestRotation(X.linear());
    return X;
  };
  for (const nlohmann::json& pair : nlohmann::json::parse(in))
    all.push_back({pose(pair.at(0)), pose(pair.at(1))});
  const double ours = leftOutSamples(all, handEyeByOurs),
               theirs = leftOutSamples(all, handEyeByOpenCv);
  std::printf("real robot, left-out samples, mm rms: ours %.3f, OpenCV %.3f\n", 1e3 * ours,
              1e3 * theirs);
  EXPECT_LT(ours, theirs);
}

}  // namespace
}  // namespace palpa::calibration
