#pragma once

#include <Eigen/Core>

/// Eigen's dense decompositions of the sizes that the program needs, behind plain functions: a
/// decomposition takes seconds to compile wherever it is called (the complete orthogonal one 14),
/// so it is compiled here, once. Each gives the bits that the decomposition named gives in place.
/// Nothing throws. What comes of numbers that are not finite has no meaning; sizes that do not fit
/// together are Eigen's assertion.
namespace palpa {

/// A x = b, A symmetric and not negative, of which the lower triangle is read: L D L' with
/// pivoting. A pivot of 0 sets its unknown to 0; one of rounding's size is divided by, so a matrix
/// that may be singular wants damping, or minimumNorm.
Eigen::VectorXd solveSymmetric(const Eigen::MatrixXd& A, const Eigen::VectorXd& b);
Eigen::Vector4d solveSymmetric(const Eigen::Matrix4d& A, const Eigen::Vector4d& b);

/// Of all x with the least |A x - b| the shortest, A square of any rank: complete orthogonal
/// decomposition. A pivot counts as 0 when it is not above rows * 2.2e-16 of the largest.
Eigen::Vector2d minimumNorm(const Eigen::Matrix2d& A, const Eigen::Vector2d& b);
Eigen::Matrix<double, 6, 1> minimumNorm(const Eigen::Matrix<double, 6, 6>& A,
                                        const Eigen::Matrix<double, 6, 1>& b);

/// A+ of Moore and Penrose, columns by rows, A of any shape and rank; decomposition and rank as
/// minimumNorm's.
Eigen::MatrixXd pseudoInverse(const Eigen::MatrixXd& A);

/// A^-1, A square: L U with partial pivoting. A singular A is not found out: entries become huge or
/// not finite.
Eigen::MatrixXd inverseOf(const Eigen::MatrixXd& A);

/// A = V diag(values) V', A symmetric, of which the lower triangle is read: values from the
/// smallest, columns of V of length 1, each of either sign. Values that are 0 may be rounded to a
/// little below.
template <int n>
struct SymmetricEigen {
  Eigen::Matrix<double, n, 1> values;
  Eigen::Matrix<double, n, n> vectors;
};
SymmetricEigen<2> symmetricEigen(const Eigen::Matrix2d& A);
SymmetricEigen<3> symmetricEigen(const Eigen::Matrix3d& A);

/// A = U diag(values) V', of any rank: values from the largest, U and V orthogonal, either may
/// mirror (Jacobi's rotations).
template <int n>
struct SingularValues {
  Eigen::Matrix<double, n, n> U, V;
  Eigen::Matrix<double, n, 1> values;
};
SingularValues<3> singularValues(const Eigen::Matrix3d& A);
SingularValues<9> singularValues(const Eigen::Matrix<double, 9, 9>& A);

}  // namespace palpa
