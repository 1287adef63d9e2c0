#include "calibration/rotation.h"

#include <Eigen/Eigenvalues>
#include <Eigen/SVD>
#include <algorithm>

namespace palpa::calibration {

Mat3 nearestRotation(const Mat3& m) {
  const Eigen::JacobiSVD<Mat3> svd(m, Eigen::ComputeFullU | Eigen::ComputeFullV);
  const double mirror = (svd.matrixU() * svd.matrixV().transpose()).determinant();
  return svd.matrixU() * Vec3(1, 1, mirror).asDiagonal() * svd.matrixV().transpose();
}

LeastTilted leastTilted(const std::vector<Pose>& poses) {
  Mat3 mean = Mat3::Zero();
  for (const Pose& X : poses) mean += X.linear() / static_cast<double>(poses.size());
  const Eigen::SelfAdjointEigenSolver<Mat3> solver(Mat3::Identity() - mean.transpose() * mean);
  return {solver.eigenvectors().col(0), std::sqrt(std::max(solver.eigenvalues()[0], 0.0))};
}

}  // namespace palpa::calibration
