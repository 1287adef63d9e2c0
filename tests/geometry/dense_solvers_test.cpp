#include "anatomy/geometry/dense_solvers.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace palpa {
namespace {

using Mat6 = Eigen::Matrix<double, 6, 6>;
using Vec6 = Eigen::Matrix<double, 6, 1>;
using Mat9 = Eigen::Matrix<double, 9, 9>;

Eigen::MatrixXd random(int rows, int cols) {
  static std::mt19937_64 bits(3);
  std::uniform_real_distribution<double> between(-1, 1);
  Eigen::MatrixXd m(rows, cols);
  for (int i = 0; i < m.size(); ++i) m.data()[i] = between(bits);
  return m;
}

/// Symmetric, of this rank, its eigenvalues not negative.
Eigen::MatrixXd symmetric(int size, int rank) {
  const Eigen::MatrixXd J = random(rank, size);
  return J.transpose() * J;
}

/// Moore's and Penrose's four laws.
void expectPseudoInverse(const Eigen::MatrixXd& A) {
  const Eigen::MatrixXd P = pseudoInverse(A);
  const double size = 1e-9 * (1 + P.norm());
  ASSERT_EQ(P.rows(), A.cols());
  ASSERT_EQ(P.cols(), A.rows());
  EXPECT_LT((A * P * A - A).norm(), size);
  EXPECT_LT((P * A * P - P).norm(), size * (1 + P.norm()));
  EXPECT_LT((A * P - (A * P).transpose()).norm(), size);
  EXPECT_LT((P * A - (P * A).transpose()).norm(), size);
}

TEST(DenseSolvers, SymmetricSystemsAreSolved) {
  for (const int size : {1, 5, 30, 80}) {
    const Eigen::MatrixXd A = symmetric(size, size + 5), b = random(size, 1);
    EXPECT_LT((A * solveSymmetric(A, b.col(0)) - b).norm(), 1e-9) << size;
  }
  const Eigen::Matrix4d A = symmetric(4, 9);
  const Eigen::Vector4d b = random(4, 1);
  EXPECT_LT((A * solveSymmetric(A, b) - b).norm(), 1e-12);
}

TEST(DenseSolvers, OfASymmetricMatrixTheLowerTriangleIsRead) {
  const Eigen::MatrixXd A = symmetric(7, 12);
  const Eigen::VectorXd b = random(7, 1);
  Eigen::MatrixXd lower = A.triangularView<Eigen::Lower>();
  lower(1, 4) = 100;
  EXPECT_EQ(solveSymmetric(lower, b), solveSymmetric(A, b));
  Eigen::Matrix3d S = symmetric(3, 5), changed = S;
  changed(0, 2) = 100;
  EXPECT_EQ(symmetricEigen(changed).values, symmetricEigen(S).values);
}

TEST(DenseSolvers, APivotOfZeroSetsItsUnknownToZero) {
  const Eigen::Matrix4d A = Eigen::Vector4d(2, 0, 4, 0).asDiagonal();
  EXPECT_EQ(solveSymmetric(A, Eigen::Vector4d(2, 3, 4, 5)), Eigen::Vector4d(1, 0, 1, 0));
}

TEST(DenseSolvers, TheShortestOfManySolutionsIsTaken) {
  // x + y = 2, said twice.
  const Eigen::Vector2d x = minimumNorm(Eigen::Matrix2d::Ones(), Eigen::Vector2d(2, 2));
  EXPECT_LT((x - Eigen::Vector2d(1, 1)).norm(), 1e-14);
  // Contradicting each other: the least squares of both.
  const Eigen::Vector2d y = minimumNorm(Eigen::Matrix2d::Ones(), Eigen::Vector2d(1, 3));
  EXPECT_LT((y - Eigen::Vector2d(1, 1)).norm(), 1e-14);
  EXPECT_EQ(minimumNorm(Eigen::Matrix2d::Zero(), Eigen::Vector2d(1, 3)), Eigen::Vector2d(0, 0));
  for (const int rank : {1, 3, 5, 6}) {
    const Mat6 A = symmetric(6, rank);
    const Vec6 within = A * Vec6(random(6, 1)), found = minimumNorm(A, within);
    EXPECT_LT((A * found - within).norm(), 1e-9) << rank;
    EXPECT_LT((found - pseudoInverse(A) * within).norm(), 1e-9) << rank;
    const Mat6 onto = pseudoInverse(A) * A;  // the row space
    EXPECT_LT((onto * found - found).norm(), 1e-9) << rank;
  }
}

TEST(DenseSolvers, PseudoInverseKeepsItsLawsInAnyShapeAndRank) {
  expectPseudoInverse(symmetric(12, 20));
  expectPseudoInverse(symmetric(12, 5));
  expectPseudoInverse(random(9, 4));
  expectPseudoInverse(random(4, 9));
  expectPseudoInverse(random(8, 2) * random(2, 11));
  EXPECT_TRUE(pseudoInverse(Eigen::MatrixXd::Zero(3, 3)).isZero(0));
}

TEST(DenseSolvers, InverseUndoes) {
  for (const int size : {1, 2, 12, 40}) {
    const Eigen::MatrixXd A = random(size, size) + size * Eigen::MatrixXd::Identity(size, size);
    EXPECT_LT((inverseOf(A) * A - Eigen::MatrixXd::Identity(size, size)).norm(), 1e-12) << size;
  }
}

TEST(DenseSolvers, EigenvaluesOfTwoByTwoAreTheRootsOfTheirPolynomial) {
  for (int i = 0; i < 50; ++i) {
    const Eigen::Matrix2d A = symmetric(2, 3);
    const double middle = (A(0, 0) + A(1, 1)) / 2,
                 half = std::hypot((A(0, 0) - A(1, 1)) / 2, A(0, 1));
    const SymmetricEigen<2> eigen = symmetricEigen(A);
    EXPECT_NEAR(eigen.values[0], middle - half, 1e-13);
    EXPECT_NEAR(eigen.values[1], middle + half, 1e-13);
  }
}

TEST(DenseSolvers, EigenvectorsAreOnlyStretched) {
  for (int rank = 0; rank <= 4; ++rank) {
    const Eigen::Matrix3d A = symmetric(3, rank);
    const SymmetricEigen<3> eigen = symmetricEigen(A);
    EXPECT_LE(eigen.values[0], eigen.values[1]);
    EXPECT_LE(eigen.values[1], eigen.values[2]);
    EXPECT_LT((A * eigen.vectors - eigen.vectors * eigen.values.asDiagonal()).norm(), 1e-13);
    EXPECT_LT((eigen.vectors.transpose() * eigen.vectors - Eigen::Matrix3d::Identity()).norm(),
              1e-13);
  }
}

template <int n>
void expectSingularValues(const Eigen::Matrix<double, n, n>& A) {
  const SingularValues<n> s = singularValues(A);
  const auto one = Eigen::Matrix<double, n, n>::Identity();
  EXPECT_LT((s.U * s.values.asDiagonal() * s.V.transpose() - A).norm(), 1e-12);
  EXPECT_LT((s.U.transpose() * s.U - one).norm(), 1e-12);
  EXPECT_LT((s.V.transpose() * s.V - one).norm(), 1e-12);
  for (int i = 1; i < n; ++i) EXPECT_LE(s.values[i], s.values[i - 1]);
  EXPECT_GE(s.values[n - 1], 0);
}

TEST(DenseSolvers, SingularVectorsAndValuesMakeUpTheMatrix) {
  for (const int rank : {0, 1, 2, 3})
    expectSingularValues<3>(Eigen::Matrix3d(random(3, rank) * random(rank, 3)));
  for (const int rank : {1, 4, 9}) expectSingularValues<9>(Mat9(random(9, rank) * random(rank, 9)));
}

}  // namespace
}  // namespace palpa
