#include "ar/pose_refinement.h"

#include <cmath>

namespace palpa::ar {
namespace {

using calibration::CameraModel;
using Vec6 = Eigen::Matrix<double, 6, 1>;
using Mat6 = Eigen::Matrix<double, 6, 6>;

struct Normal {
  Mat6 A = Mat6::Zero();  ///< J^T J
  Vec6 b = Vec6::Zero();  ///< J^T residual
  double cost = 0;        ///< sum of squares; not a number when a point is behind the camera
};

Normal linearise(const Pose& X_CW, const std::vector<BoardPoint>& points,
                 const CameraModel& camera) {
  Normal normal;
  for (const BoardPoint& point : points) {
    const Vec3 turned = X_CW.linear() * point.p_W;
    Eigen::Matrix<double, 2, 3> d_pixel;
    const Eigen::Vector2d pixel = camera.project(turned + X_CW.translation(), &d_pixel);
    Eigen::Matrix<double, 2, 6> J;  // d (w x Rp) = -[Rp] dw
    for (int row = 0; row < 2; ++row)
      J.row(row).head<3>() = turned.cross(d_pixel.row(row).transpose()).transpose();
    J.rightCols<3>() = d_pixel;
    const Eigen::Vector2d residual = point.pixel - pixel;
    normal.A += J.transpose() * J;
    normal.b += J.transpose() * residual;
    normal.cost += residual.squaredNorm();
  }
  return normal;
}

Pose moved(const Pose& X, const Vec6& step) {
  const Vec3 w = step.head<3>();
  const double angle = w.norm();
  const Mat3 turn =
      angle > 0 ? Eigen::AngleAxisd(angle, w / angle).toRotationMatrix() : Mat3(Mat3::Identity());
  const Mat3 R = Quat(turn * X.linear()).normalized().toRotationMatrix();
  return makePose(R, X.translation() + step.tail<3>());
}

}  // namespace

RefinedPose refinePose(const Pose& start, const std::vector<BoardPoint>& points,
                       const CameraModel& camera) {
  Pose X = start;
  Normal normal = linearise(X, points, camera);
  double damping = 1e-4;
  int iterations = 0;
  for (; iterations < 50 && damping < 1e12; ++iterations) {
    Mat6 A = normal.A;
    A.diagonal() *= 1 + damping;
    const Vec6 step = A.ldlt().solve(normal.b);
    const Pose next = moved(X, step);
    const Normal there = linearise(next, points, camera);
    const bool better = there.cost <= normal.cost;  // false when not a number
    damping *= better ? 0.1 : 10;
    if (!better) continue;
    X = next;
    normal = there;
    if (step.norm() < 1e-12) break;
  }
  return {X, normal.A, std::sqrt(normal.cost / double(points.size())), iterations};
}

}  // namespace palpa::ar
