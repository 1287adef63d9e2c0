#include "ar/tracking/board_pose.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include <opencv2/calib3d.hpp>

#include "anatomy/base/error.h"
#include "anatomy/geometry/dense_solvers.h"
#include "ar/tracking/pose_filter.h"

namespace palpa::ar {

SeenPoint seenPoint(const Pose& X_CW, const Vec3& p_W, const calibration::CameraModel& camera) {
  const Vec3 turned = X_CW.linear() * p_W;
  Eigen::Matrix<double, 2, 3> d_pixel;
  SeenPoint seen;
  seen.pixel = camera.project(turned + X_CW.translation(), &d_pixel);
  for (int row = 0; row < 2; ++row)  // d (w x Rp) = -[Rp] dw
    seen.by_pose.row(row).head<3>() = turned.cross(d_pixel.row(row).transpose()).transpose();
  seen.by_pose.rightCols<3>() = d_pixel;
  return seen;
}

namespace {

using calibration::CameraModel;

struct NormalEquations {
  Matrix6 A = Matrix6::Zero();  ///< J^T J
  Vector6 b = Vector6::Zero();  ///< J^T residual
  double cost = 0;              ///< sum of squares; not a number when a point is behind the camera
};

NormalEquations linearise(const Pose& X_CW, const std::vector<BoardPoint>& points,
                          const CameraModel& camera) {
  NormalEquations normal;
  for (const BoardPoint& point : points) {
    const SeenPoint seen = seenPoint(X_CW, point.p_W, camera);
    const Eigen::Vector2d residual = point.pixel - seen.pixel;
    normal.A += seen.by_pose.transpose() * seen.by_pose;
    normal.b += seen.by_pose.transpose() * residual;
    normal.cost += residual.squaredNorm();
  }
  return normal;
}

/// `hopeless`: a cost that the solution must come near to be of use; where it cannot, it is left as
/// soon as that is clear.
RefinedPose refined(const Pose& start, const std::vector<BoardPoint>& points,
                    const CameraModel& camera,
                    double hopeless = std::numeric_limits<double>::infinity()) {
  // A step that is not damped promises b' step. Once the first ones are done, steps of a solution
  // with large residuals shrink slowly, but not so slowly that all later ones bring a hundred times
  // as much.
  constexpr int kFirstSteps = 4;
  constexpr double kAllLaterSteps = 100, kHardlyDamped = 1e-3;
  Pose X = start;
  NormalEquations normal = linearise(X, points, camera);
  double damping = 1e-4;
  int iterations = 0;
  for (; iterations < 50 && damping < 1e12; ++iterations) {
    Matrix6 A = normal.A;
    A.diagonal() *= 1 + damping;
    const Vector6 step = A.ldlt().solve(normal.b);
    if (iterations >= kFirstSteps && damping < kHardlyDamped &&
        normal.cost - kAllLaterSteps * normal.b.dot(step) > hopeless)
      break;
    const Pose next = stepped(X, step);
    const NormalEquations there = linearise(next, points, camera);
    const bool better = there.cost <= normal.cost;  // false when not a number
    damping *= better ? 0.1 : 10;
    if (!better) continue;
    X = next;
    normal = there;
    if (step.norm() < 1e-12) break;
  }
  return {X, normal.A, std::sqrt(normal.cost / double(points.size())), iterations};
}

}  // namespace

RefinedPose refinePose(const Pose& start, const std::vector<BoardPoint>& points,
                       const CameraModel& camera) {
  return refined(start, points, camera);
}

namespace {

using calibration::CameraModel;

constexpr double kGrossError_px = 5;  // far beyond corner noise and imperfect intrinsics
constexpr double kThinnest = 1e-3;    // narrow side to long side; below it points are a line
constexpr double kSameSolution =
    1e-4;  // relative; refinement repeats to 1e-9, two solutions differ by degrees
// Beyond this a second solution is no rival of the first, by whatever noise of its pixels: it is
// not refined to its end. Chi-squared of 100 for corners of 1 px.
constexpr double kFarWorse = 4, kFarAbove_px2 = 100;
constexpr std::size_t kMany = 32;  // fewer points may pass through long valleys, and cost little

/// Points on the board and on the picture's plane at unit depth, lens distortion taken out.
struct PlanarPairs {
  std::vector<cv::Point2d> board, ray;
};

PlanarPairs planarPairs(const std::vector<BoardPoint>& points, const CameraModel& camera) {
  PlanarPairs pairs;
  for (const BoardPoint& point : points) {
    const Vec3 ray = camera.unproject(point.pixel);
    pairs.board.emplace_back(point.p_W.x(), point.p_W.y());
    pairs.ray.emplace_back(ray.x(), ray.y());
  }
  return pairs;
}

/// Finite ones only; throws when one is off the plane, which no picture can cause.
std::vector<BoardPoint> usable(const std::vector<BoardPoint>& points) {
  std::vector<BoardPoint> good;
  for (const BoardPoint& point : points) {
    if (std::abs(point.p_W.z()) > 1e-9)
      throw Error("a board point is not on the plane z = 0", "board pose", "Use a flat board.");
    if (point.pixel.allFinite() && point.p_W.allFinite()) good.push_back(point);
  }
  return good;
}

bool onALine(const std::vector<BoardPoint>& points) {
  Eigen::Vector2d mean = Eigen::Vector2d::Zero();
  for (const BoardPoint& point : points) mean += point.p_W.head<2>() / double(points.size());
  Eigen::Matrix2d scatter = Eigen::Matrix2d::Zero();
  for (const BoardPoint& point : points) {
    const Eigen::Vector2d d = point.p_W.head<2>() - mean;
    scatter += d * d.transpose();
  }
  const Eigen::Vector2d spread = symmetricEigen(scatter).values;
  return !(spread[0] > kThinnest * kThinnest * spread[1]);
}

/// Without those that no homography shared by most of the points explains. OpenCV's RANSAC starts
/// from a fixed seed, so the choice repeats. When most points disagree, all are kept: the
/// reprojection error then tells.
std::vector<BoardPoint> consistent(const std::vector<BoardPoint>& points,
                                   const CameraModel& camera) {
  if (points.size() < 6) return points;
  const PlanarPairs pairs = planarPairs(points, camera);
  cv::Mat inlier;
  cv::findHomography(pairs.board, pairs.ray, cv::RANSAC, kGrossError_px / camera.fx, inlier, 500);
  std::vector<BoardPoint> kept;
  for (std::size_t i = 0; i < points.size(); ++i)
    if (!inlier.empty() && inlier.at<unsigned char>(int(i))) kept.push_back(points[i]);
  return kept.size() * 2 > points.size() ? kept : points;
}

Pose fromOpenCv(const cv::Mat& rotation_vector, const cv::Mat& translation) {
  const Vec3 w(rotation_vector.at<double>(0), rotation_vector.at<double>(1),
               rotation_vector.at<double>(2));
  const Vec3 t(translation.at<double>(0), translation.at<double>(1), translation.at<double>(2));
  const double angle = w.norm();
  const Mat3 R =
      angle > 0 ? Eigen::AngleAxisd(angle, w / angle).toRotationMatrix() : Mat3(Mat3::Identity());
  return makePose(R, t);
}

std::vector<Pose> planarSolutions(const std::vector<BoardPoint>& points,
                                  const CameraModel& camera) {
  const PlanarPairs pairs = planarPairs(points, camera);
  std::vector<cv::Point3d> board;
  for (const cv::Point2d& p : pairs.board) board.emplace_back(p.x, p.y, 0.0);
  std::vector<cv::Mat> rotations, translations;
  cv::solvePnPGeneric(board, pairs.ray, cv::Mat::eye(3, 3, CV_64F), cv::noArray(), rotations,
                      translations, false, cv::SOLVEPNP_IPPE);
  std::vector<Pose> solutions;
  for (std::size_t i = 0; i < rotations.size(); ++i)
    solutions.push_back(fromOpenCv(rotations[i], translations[i]));
  return solutions;
}

/// All points before the camera, and the camera on the printed side.
bool seesFront(const Pose& X_CW, const std::vector<BoardPoint>& points) {
  if (!X_CW.matrix().allFinite() || X_CW.inverse().translation().z() <= 0) return false;
  return std::all_of(points.begin(), points.end(),
                     [&](const BoardPoint& point) { return (X_CW * point.p_W).z() > 0; });
}

std::vector<RefinedPose> refinedSolutions(const std::vector<BoardPoint>& points,
                                          const CameraModel& camera) {
  std::vector<RefinedPose> solutions;
  double hopeless = std::numeric_limits<double>::infinity();
  for (const Pose& start : planarSolutions(points, camera)) {
    if (!seesFront(start, points)) continue;
    const RefinedPose one = refined(start, points, camera, hopeless);
    if (!seesFront(one.X_CW, points)) continue;
    solutions.push_back(one);
    const double cost = one.rms_px * one.rms_px * double(points.size());
    if (points.size() >= kMany) hopeless = std::min(hopeless, kFarWorse * cost + kFarAbove_px2);
  }
  std::sort(solutions.begin(), solutions.end(),
            [](const RefinedPose& a, const RefinedPose& b) { return a.rms_px < b.rms_px; });
  return solutions;
}

/// Without what is the first one over again: both starts often lead to one minimum.
std::vector<RefinedPose> differentOnes(const std::vector<RefinedPose>& solutions) {
  std::vector<RefinedPose> different;
  for (const RefinedPose& one : solutions)
    if (different.empty() ||
        (different.size() == 1 && !one.X_CW.isApprox(different[0].X_CW, kSameSolution)))
      different.push_back(one);
  return different;
}

}  // namespace

std::vector<BoardPose> estimateBoardPoses(const std::vector<BoardPoint>& points,
                                          const calibration::CameraModel& camera,
                                          double pixel_sigma) try {
  const std::vector<BoardPoint> given = usable(points);
  if (given.size() < 4 || onALine(given)) return {};
  const std::vector<BoardPoint> used = consistent(given, camera);
  const std::vector<RefinedPose> solutions = differentOnes(refinedSolutions(used, camera));
  std::vector<BoardPose> poses;
  for (std::size_t i = 0; i < solutions.size(); ++i) {
    BoardPose pose;
    pose.X_CW = solutions[i].X_CW;
    pose.covariance = pixel_sigma * pixel_sigma * solutions[i].information.inverse();
    pose.rms_px = solutions[i].rms_px;
    pose.rms_other_px =
        solutions.size() > 1 ? solutions[1 - i].rms_px : std::numeric_limits<double>::infinity();
    pose.points = int(used.size());
    pose.rejected = int(points.size() - used.size());
    poses.push_back(pose);
  }
  return poses;
} catch (const cv::Exception&) {  // the closed form refuses a degenerate set
  return {};
}

std::optional<BoardPose> estimateBoardPose(const std::vector<BoardPoint>& points,
                                           const calibration::CameraModel& camera,
                                           double pixel_sigma) {
  const std::vector<BoardPose> poses = estimateBoardPoses(points, camera, pixel_sigma);
  return poses.empty() ? std::nullopt : std::optional(poses.front());
}

}  // namespace palpa::ar
