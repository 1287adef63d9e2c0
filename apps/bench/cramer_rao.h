#pragma once

#include <Eigen/Core>
#include <functional>

namespace palpa::bench {

using VectorX = Eigen::VectorXd;
using MatrixX = Eigen::MatrixXd;

/// What is measured, at parameters dx beside the truth and with the noise e that is left when all
/// is known: block i of the constraints that noiseless data fulfil. Gaussian noise of covariance
/// `noise` enters by e.
struct Measurement {
  int blocks = 0, parameters = 0;
  /// Residuals of block i for parameters and measured quantities moved by dx and e from the truth:
  /// 0 at (0, 0).
  std::function<VectorX(int i, const VectorX& dx, const VectorX& e)> constraint;
  VectorX noise_sd;  ///< of the entries of e, a block's
};

/// The Cramer-Rao bound on the covariance of an unbiased estimate: (sum over i of J_i' (N_i S
/// N_i')^-1 J_i)^-1, where J_i and N_i are the constraint's derivatives by dx and e at the truth
/// (first order in the noise; what was truly measured is a nuisance). Directions of a constraint
/// that no noise moves are left out. Knows nothing of any estimator.
MatrixX cramerRaoBound(const Measurement& measurement);

}  // namespace palpa::bench
