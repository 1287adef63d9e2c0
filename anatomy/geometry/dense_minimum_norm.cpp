#include <Eigen/QR>

#include "anatomy/geometry/dense_solvers.h"

namespace palpa {

Eigen::Vector2d minimumNorm(const Eigen::Matrix2d& A, const Eigen::Vector2d& b) {
  return A.completeOrthogonalDecomposition().solve(b);
}
Eigen::Matrix<double, 6, 1> minimumNorm(const Eigen::Matrix<double, 6, 6>& A,
                                        const Eigen::Matrix<double, 6, 1>& b) {
  return A.completeOrthogonalDecomposition().solve(b);
}

}  // namespace palpa
