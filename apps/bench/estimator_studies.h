#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "anatomy/geometry/pose.h"
#include "anatomy/geometry/random_vector.h"
#include "calibration/robust_fit.h"

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

/// One synthetic data set, drawn, estimated, compared with the truth that the estimator does not
/// see.
struct EstimateCheck {
  VectorX error;   ///< estimate less truth, parameter by parameter
  VectorX half95;  ///< half of the stated 95 % intervals
  VectorX bound;   ///< standard deviations of the Cramer-Rao bound without outliers
};

/// `outliers`: share of the measurements that are gross errors.
struct EstimatorStudy {
  std::string name;
  std::function<EstimateCheck(std::uint64_t seed, double outliers)> run;
};

struct StudyFigures {
  double ratio = 0;        ///< root mean square error over the bound, median of the parameters
  double worst_ratio = 0;  ///< of the parameter for which it is largest
  double coverage = 0;     ///< share of the truths inside the stated 95 % intervals, all parameters
  int refused = 0;         ///< sets for which the estimator gave no answer; said on standard error
};
/// Sets of seeds 1 to `sets`.
StudyFigures figuresOf(const EstimatorStudy& study, int sets, double outliers);

}  // namespace palpa::bench

/// What the studies of estimators draw, and how they read a fit.
namespace palpa::bench::study {

using Random = RandomStream;
Vec3 inBall(Random& random);  ///< of radius 1, evenly
Vec3 direction(Random& random);
Mat3 anyRotation(Random& random);

/// Which of n measurements are gross errors: that share of them, drawn.
std::vector<bool> grossErrors(Random& random, std::size_t n, double share);

/// Half of the 95 % intervals of all parameters.
VectorX halves(const calibration::Fit& fit);
VectorX sds(const MatrixX& covariance);

}  // namespace palpa::bench::study

namespace palpa::bench {

/// Twelve views of a board of 8 by 6 corners, held to every side and turned by up to 45 degrees,
/// corners found to 0.2 px; gross errors are corners 10 to 40 px off. Judged are the nine numbers
/// of the lens; the views' poses are unknown too, to the estimator and in the bound.
EstimateCheck cameraStudy(std::uint64_t seed, double outliers);

/// Realistic noise: an encoder-read device of 0.1 mm and 0.05 degrees, a tag seen at 0.6 m, a hand
/// that touches to 0.5 mm, a force sensor of 0.02 N, corners found to 0.2 px.
std::vector<EstimatorStudy> estimatorStudies();

}  // namespace palpa::bench
