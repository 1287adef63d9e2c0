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

Eigen::Vector2d minimumNorm(const Eigen::Matrix2d& A, const Eigen::Vector2d& b) {
  return A.completeOrthogonalDecomposition().solve(b);
}
Eigen::Matrix<double, 6, 1> minimumNorm(const Eigen::Matrix<double, 6, 6>& A,
                                        const Eigen::Matrix<double, 6, 1>& b) {
  return A.completeOrthogonalDecomposition().solve(b);
}

}  // namespace palpa
