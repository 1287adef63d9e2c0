#include <Eigen/Eigenvalues>
#include <Eigen/SVD>

#include "anatomy/geometry/dense_solvers.h"

namespace palpa {
namespace {

template <int n>
SymmetricEigen<n> eigenOf(const Eigen::Matrix<double, n, n>& A) {
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix<double, n, n>> solver(A);
  return {solver.eigenvalues(), solver.eigenvectors()};
}

template <int n>
SingularValues<n> singularValuesOf(const Eigen::Matrix<double, n, n>& A) {
  const Eigen::JacobiSVD<Eigen::Matrix<double, n, n>> svd(
      A, Eigen::ComputeFullU | Eigen::ComputeFullV);
  return {svd.matrixU(), svd.matrixV(), svd.singularValues()};
}

}  // namespace

SymmetricEigen<2> symmetricEigen(const Eigen::Matrix2d& A) { return eigenOf<2>(A); }
SymmetricEigen<3> symmetricEigen(const Eigen::Matrix3d& A) { return eigenOf<3>(A); }

SingularValues<3> singularValues(const Eigen::Matrix3d& A) { return singularValuesOf<3>(A); }
SingularValues<9> singularValues(const Eigen::Matrix<double, 9, 9>& A) {
  return singularValuesOf<9>(A);
}

}  // namespace palpa
