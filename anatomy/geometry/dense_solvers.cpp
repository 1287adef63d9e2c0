#include "anatomy/geometry/dense_solvers.h"

#include <Eigen/Cholesky>
#include <Eigen/LU>
#include <Eigen/QR>

namespace palpa {

Eigen::VectorXd solveSymmetric(const Eigen::MatrixXd& A, const Eigen::VectorXd& b) {
  return A.ldlt().solve(b);
}
Eigen::Vector4d solveSymmetric(const Eigen::Matrix4d& A, const Eigen::Vector4d& b) {
  return A.ldlt().solve(b);
}

Eigen::MatrixXd pseudoInverse(const Eigen::MatrixXd& A) {
  return A.completeOrthogonalDecomposition().pseudoInverse();
}

Eigen::MatrixXd inverseOf(const Eigen::MatrixXd& A) { return A.inverse(); }

}  // namespace palpa
