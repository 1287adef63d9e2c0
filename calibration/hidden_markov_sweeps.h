#pragma once

#include "calibration/hidden_markov.h"

/// Inside hidden_markov: the scaled sweeps (Rabiner 1989, section V.A) that fit and inference
/// share.
namespace palpa::calibration {

inline constexpr char kHmmWhere[] = "hidden Markov model";

struct ForwardSweep {
  Eigen::MatrixXd belief;  ///< P(state | steps so far), a step a column
  Eigen::MatrixXd ratio;   ///< density of the step in the state / P(step | steps before)
  double log_likelihood = 0;
};

/// x: a feature a row, a step a column.
ForwardSweep forwardSweep(const HiddenMarkov& m, const Eigen::MatrixXd& x);

struct BackwardSweep {
  Eigen::MatrixXd
      after;  ///< P(steps after t | state) / P(steps after t | steps up to t), a step a column
  Eigen::MatrixXd onward;  ///< the same from step t on: ratio times after, but in the first column
};

BackwardSweep backwardSweep(const HiddenMarkov& m, const ForwardSweep& forward);

/// Free parameters of so many states of so many features.
int hiddenMarkovParameters(Eigen::Index states, Eigen::Index features);

}  // namespace palpa::calibration
