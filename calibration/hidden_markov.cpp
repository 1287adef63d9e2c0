#include "calibration/hidden_markov.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "anatomy/geometry/error.h"
#include "calibration/hidden_markov_sweeps.h"

namespace palpa::calibration {
namespace {

constexpr double kNever = -std::numeric_limits<double>::infinity();

/// A state a row, a step a column; x: a feature a row.
Eigen::MatrixXd logDensities(const HiddenMarkov& m, const Eigen::MatrixXd& x) {
  Eigen::MatrixXd log_density(m.states(), x.cols());
  for (Eigen::Index k = 0; k < m.states(); ++k) {
    const Eigen::VectorXd mean = m.mean.row(k).transpose(),
                          variance = m.variance.row(k).transpose();
    const double constant = -0.5 * (2 * std::numbers::pi * variance.array()).log().sum();
    log_density.row(k) =
        constant -
        0.5 * ((x.colwise() - mean).array().square().colwise() / variance.array()).colwise().sum();
  }
  return log_density;
}

/// Bayes' rule. Log densities of a step become what the step multiplies the prediction by: density
/// / P(step | steps before). Returns ln of that probability. A step that no state could give, or
/// that is no number, tells nothing.
double bayes(const Eigen::VectorXd& predicted, Eigen::VectorXd* densities) {
  double top = kNever, sum = 0;
  for (Eigen::Index k = 0; k < predicted.size(); ++k)
    if (predicted[k] > 0) top = std::max(top, (*densities)[k]);
  if (!std::isfinite(top)) {
    densities->setOnes();
    return kNever;
  }
  for (Eigen::Index k = 0; k < predicted.size(); ++k) {
    (*densities)[k] = predicted[k] > 0 ? std::exp((*densities)[k] - top) : 0;
    sum += predicted[k] * (*densities)[k];
  }
  *densities /= sum;
  return std::log(sum) + top;
}

void requireTrialOf(const HiddenMarkov& m, const Eigen::MatrixXd& trial) {
  if (trial.cols() != m.mean.cols())
    throw Error("the trial has " + std::to_string(trial.cols()) + " features, the model " +
                    std::to_string(m.mean.cols()),
                kHmmWhere, "Compute the features that the model was fitted to");
  if (!trial.allFinite())
    throw Error("the trial holds a value that is no number", kHmmWhere, "Remove its step");
}

}  // namespace

ForwardSweep forwardSweep(const HiddenMarkov& m, const Eigen::MatrixXd& x) {
  ForwardSweep sweep{Eigen::MatrixXd(m.states(), x.cols()), logDensities(m, x), 0};
  const Eigen::MatrixXd back = m.transition.transpose();
  Eigen::VectorXd predicted = m.start, densities(m.states());
  for (Eigen::Index t = 0; t < x.cols(); ++t) {
    if (t > 0) predicted.noalias() = back * sweep.belief.col(t - 1);
    densities = sweep.ratio.col(t);
    sweep.log_likelihood += bayes(predicted, &densities);
    sweep.ratio.col(t) = densities;
    sweep.belief.col(t) = predicted.cwiseProduct(densities);
  }
  return sweep;
}

BackwardSweep backwardSweep(const HiddenMarkov& m, const ForwardSweep& forward) {
  BackwardSweep sweep{Eigen::MatrixXd::Ones(forward.ratio.rows(), forward.ratio.cols()),
                      forward.ratio};
  for (Eigen::Index t = sweep.after.cols() - 1; t > 0; --t) {
    sweep.onward.col(t).array() *= sweep.after.col(t).array();
    sweep.after.col(t - 1).noalias() = m.transition * sweep.onward.col(t);
  }
  return sweep;
}

int hiddenMarkovParameters(Eigen::Index states, Eigen::Index features) {
  return static_cast<int>(states - 1 + states * (states - 1) + 2 * states * features);
}

int HiddenMarkov::parameters() const { return hiddenMarkovParameters(start.size(), mean.cols()); }

std::vector<int> mostLikely(const HiddenMarkov& model, const Eigen::MatrixXd& trial) {
  requireTrialOf(model, trial);
  if (trial.rows() == 0) return {};
  const Eigen::MatrixXd log_density = logDensities(model, trial.transpose()),
                        log_move = model.transition.array().log();
  Eigen::MatrixXi from(model.states(), trial.rows());  // the best state before
  Eigen::VectorXd best = model.start.array().log() + log_density.col(0).array(),
                  next(model.states());
  for (Eigen::Index t = 1; t < trial.rows(); ++t) {
    for (Eigen::Index k = 0; k < model.states(); ++k)
      next[k] = (best + log_move.col(k)).maxCoeff(&from(k, t)) + log_density(k, t);
    best = next;
  }
  std::vector<int> path(static_cast<std::size_t>(trial.rows()));
  best.maxCoeff(&path.back());
  for (std::size_t t = path.size() - 1; t > 0; --t)
    path[t - 1] = from(path[t], static_cast<Eigen::Index>(t));
  return path;
}

double logLikelihood(const HiddenMarkov& model, const Eigen::MatrixXd& trial) {
  requireTrialOf(model, trial);
  return forwardSweep(model, trial.transpose()).log_likelihood;
}

Eigen::MatrixXd smoothed(const HiddenMarkov& model, const Eigen::MatrixXd& trial) {
  requireTrialOf(model, trial);
  const ForwardSweep forward = forwardSweep(model, trial.transpose());
  return forward.belief.cwiseProduct(backwardSweep(model, forward).after).transpose();
}

Eigen::VectorXd filtered(const HiddenMarkov& model, const Eigen::VectorXd& belief,
                         const Eigen::VectorXd& row) {
  const bool first = belief.size() == 0;
  if (row.size() != model.mean.cols() || (!first && belief.size() != model.start.size()))
    throw Error("belief or row is not of the model's size", kHmmWhere,
                "Give what the model was fitted to");
  if (!first && !(belief.minCoeff() >= 0 && belief.sum() > 0 && belief.allFinite()))
    throw Error("the belief is none", kHmmWhere,
                "Give the answer of the step before, or nothing at the first step");
  const Eigen::VectorXd predicted =
      first ? model.start : Eigen::VectorXd(model.transition.transpose() * (belief / belief.sum()));
  Eigen::VectorXd densities = logDensities(model, row);
  bayes(predicted, &densities);
  return predicted.cwiseProduct(densities);
}

double bic(const HiddenMarkov& model, std::size_t steps) {
  return model.parameters() * std::log(static_cast<double>(steps)) - 2 * model.log_likelihood;
}

}  // namespace palpa::calibration
