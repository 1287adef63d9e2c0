#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

namespace palpa::statistics {

/// One question put to all trials, as part of a mixed model.
struct FixedEffect {
  std::string name;
  double estimate = 0, error = 0;    ///< in the values' unit, and its standard error
  double low = 0, high = 0;          ///< 95 % interval
  double t = 0, degrees = 0, p = 1;  ///< two-sided
  bool within = false;  ///< differs between trials of one subject; otherwise only between subjects
};

/// Trials of subjects: y = X b + u(subject) + e with u ~ N(0, sd_subject^2), e ~ N(0,
/// sd_residual^2), so that trials of one subject are alike.
struct MixedModel {
  std::vector<FixedEffect> effects;
  double sd_subject = 0, sd_residual = 0;
  double log_likelihood = 0;  ///< restricted
  /// Share of the spread that is the subjects' own: sd_subject^2 / (sd_subject^2 + sd_residual^2)
  double alike = 0;
  std::size_t subjects = 0, trials = 0;
};

/// By restricted maximum likelihood (Patterson and Thompson 1971), the spread's one free ratio
/// found on a line. With r = sd_subject^2 / sd_residual^2 and n_i trials of subject i,
///   V_i^-1 = I - r / (1 + n_i r) 11',   log det V_i = log(1 + n_i r)
/// Degrees of freedom between and within subjects (Pinheiro and Bates 2000, section 2.4.2): for
/// what differs between subjects only, subjects less such columns (the mean among them); for the
/// rest, trials less subjects less columns of that kind. `x`: a row a trial, the first column ones;
/// `subject`: any number a subject. Throws Error for tables of unlike length, a value that is not
/// finite, columns that say the same, too few subjects or trials, and where nothing varies.
MixedModel fitMixedModel(const Eigen::VectorXd& y, const Eigen::MatrixXd& x,
                         const std::vector<std::string>& names, const std::vector<int>& subject);

}  // namespace palpa::statistics
