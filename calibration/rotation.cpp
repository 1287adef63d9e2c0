#include "calibration/rotation.h"

#include <Eigen/LU>
#include <algorithm>

#include "anatomy/base/error.h"
#include "anatomy/geometry/dense_solvers.h"

namespace palpa::calibration {

Mat3 rotationOf(const Vec3& w) {
  const double angle = w.norm();
  return angle > 0 ? Eigen::AngleAxisd(angle, w / angle).toRotationMatrix()
                   : Mat3(Mat3::Identity());
}

Vec3 rotationVector(const Mat3& R) {
  const Eigen::AngleAxisd turn(R);
  return turn.angle() * turn.axis();
}

Mat3 nearestRotation(const Mat3& m) {
  const SingularValues<3> svd = singularValues(m);
  const double mirror = (svd.U * svd.V.transpose()).determinant();
  return svd.U * Vec3(1, 1, mirror).asDiagonal() * svd.V.transpose();
}

void requirePose(const Pose& X, const std::string& where) {
  if (!X.matrix().allFinite()) throw Error("a pose is not a number", where, "Record again");
  const Mat3 R = X.linear();
  if ((R.transpose() * R - Mat3::Identity()).norm() > 1e-3 || R.determinant() < 0)
    throw Error("a pose's rotation is not one (its columns are not right-handed unit vectors)",
                where,
                "Look whether the file holds quaternions, angles or another order of its numbers");
}

LeastTilted leastTilted(const std::vector<Pose>& poses) {
  Mat3 mean = Mat3::Zero();
  for (const Pose& X : poses) mean += X.linear() / static_cast<double>(poses.size());
  const SymmetricEigen<3> tilt = symmetricEigen(Mat3(Mat3::Identity() - mean.transpose() * mean));
  return {tilt.vectors.col(0), std::sqrt(std::max(tilt.values[0], 0.0)),
          std::sqrt(std::max(tilt.values[2], 0.0))};
}

Mat3 pointCovariance(const Pose& X, const Eigen::Matrix<double, 6, 6>& covariance, const Vec3& p) {
  Eigen::Matrix<double, 3, 6> J;
  J << -X.linear() * crossMatrix(p), Mat3::Identity();
  return J * covariance * J.transpose();
}

Eigen::Matrix<double, 6, 6> inverseCovariance(const Pose& X,
                                              const Eigen::Matrix<double, 6, 6>& covariance) {
  Eigen::Matrix<double, 6, 6> J = Eigen::Matrix<double, 6, 6>::Zero();
  J.topLeftCorner<3, 3>() = -X.linear();
  J.bottomLeftCorner<3, 3>() = crossMatrix(X.inverse().translation());
  J.bottomRightCorner<3, 3>() = -X.linear().transpose();
  return J * covariance * J.transpose();
}

}  // namespace palpa::calibration
