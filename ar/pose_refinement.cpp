#include "ar/pose_refinement.h"

#include <cmath>

#include "ar/pose_motion.h"

namespace palpa::ar {
namespace {

using calibration::CameraModel;

struct Normal {
  Matrix6 A = Matrix6::Zero();  ///< J^T J
  Vector6 b = Vector6::Zero();  ///< J^T residual
  double cost = 0;              ///< sum of squares; not a number when a point is behind the camera
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

}  // namespace

RefinedPose refinePose(const Pose& start, const std::vector<BoardPoint>& points,
                       const CameraModel& camera) {
  Pose X = start;
  Normal normal = linearise(X, points, camera);
  double damping = 1e-4;
  int iterations = 0;
  for (; iterations < 50 && damping < 1e12; ++iterations) {
    Matrix6 A = normal.A;
    A.diagonal() *= 1 + damping;
    const Vector6 step = A.ldlt().solve(normal.b);
    const Pose next = stepped(X, step);
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
