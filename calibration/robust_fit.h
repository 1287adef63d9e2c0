#pragma once

#include <Eigen/Core>
#include <functional>
#include <string>
#include <vector>

namespace palpa::calibration {

using VectorX = Eigen::VectorXd;
using MatrixX = Eigen::MatrixXd;

/// Measurements in blocks of `size` residuals, of which a block as a whole is good or an outlier.
/// The estimator keeps the state x itself; here it is seen only through steps dx of its
/// `parameters` local coordinates.
struct FitProblem {
  int blocks = 0, size = 0, parameters = 0;
  /// All residuals at x moved by dx, block after block, scaled so that the noise of each is equally
  /// large.
  std::function<VectorX(const VectorX& dx)> residuals;
  std::function<void(const VectorX& dx)> move;  ///< x becomes x moved by dx
  /// Derivatives of the residuals by dx at x, for problems of many parameters; where there is none,
  /// differences are taken.
  std::function<MatrixX()> jacobian = nullptr;
  bool keep_all = false;  ///< plain least squares: no block is taken for an outlier
  /// Independent errors of a block, where its residuals share causes (one pose seen in many
  /// corners); 0: all are independent
  int freedom = 0;
};

struct Fit {
  VectorX r;               ///< residuals at the end, all blocks
  MatrixX covariance;      ///< of dx at the end: sigma^2 (J' J)^-1 over the good blocks
  double sigma = 0;        ///< standard deviation of one residual, from the good blocks
  double rms = 0;          ///< of the norms of the good blocks
  int dof = 0;             ///< residuals of the good blocks less parameters
  std::vector<bool> good;  ///< by block
  int outliers() const;
  /// Half of the two-sided 95 % interval of parameter i: Student's t at `dof` times its standard
  /// deviation.
  double halfWidth95(int i) const;
};

/// Fits from where the state is, in three stages that share one damped Gauss-Newton step (Levenberg
/// 1944, Marquardt 1963; derivatives by central differences of `step` unless given): least sum of
/// norms, whose minimum a few gross errors do not move; then least squares of the blocks whose norm
/// is below the 99.9 % quantile of the chi distribution at the scale that the median norm tells,
/// decided anew until nothing changes. Sigma is corrected for what that cut takes off. Efficiency
/// without outliers: 99 % and more. Throws Error (in `where`) when residuals are not finite, there
/// are too few blocks, or more than `most_outliers` of the blocks do not fit the rest.
Fit robustFit(const FitProblem& problem, const std::string& where, double most_outliers = 0.3,
              double step = 1e-6);

/// For laws that are true only nearly (real friction is nearly Dahl's): what is left then is the
/// law's fault, not a sample's. Plain least squares of everything where that leaves less than a
/// tenth of the signal's rms in each residual; robustFit from there where it leaves more.
Fit nearFit(FitProblem problem, double signal_rms, const std::string& where);

}  // namespace palpa::calibration
