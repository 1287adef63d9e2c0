#include "calibration/parts/hidden_markov.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <string>

#include "anatomy/base/error.h"
#include "calibration/parts/agreement.h"

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
    throw Error("the trial holds a value that is not a number", kHmmWhere, "Remove its step");
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
    throw Error("the belief is not a distribution", kHmmWhere,
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

namespace {

constexpr int kLeastHeldOut = 2, kMostFolds = 10;  // trials; folds when none are asked for
constexpr int kHalvings = 3;
constexpr double kAsWell = 0.05;  // of the adjusted Rand index

int foldsFor(std::size_t trials, int most, int folds) {
  const int count = static_cast<int>(trials);
  if (count < kLeastHeldOut)
    throw Error(std::to_string(count) + (count == 1 ? " trial is" : " trials are") +
                    " too few to hold some out, " + std::to_string(kLeastHeldOut) + " are needed",
                kHmmWhere, "Record more trials");
  if (most < 1) throw Error("no number of states is offered", kHmmWhere, "Offer 1 at least");
  if (folds == 0) return std::min(count, kMostFolds);
  if (folds < 2 || folds > count)
    throw Error(
        std::to_string(folds) + " folds cannot be made of " + std::to_string(count) + " trials",
        kHmmWhere, "Take 2 at least, and no more than trials");
  return folds;
}

/// Log likelihood for each step, by trial, each from a fit to the other folds.
Eigen::VectorXd heldOutLikelihoods(const std::vector<Eigen::MatrixXd>& trials, int states,
                                   std::uint64_t seed, std::size_t folds,
                                   const HiddenMarkovSettings& settings) {
  Eigen::VectorXd by_trial(static_cast<Eigen::Index>(trials.size()));
  for (std::size_t fold = 0; fold < folds; ++fold) {
    std::vector<Eigen::MatrixXd> others;
    for (std::size_t i = 0; i < trials.size(); ++i)
      if (i % folds != fold) others.push_back(trials[i]);
    const HiddenMarkov model = fitHiddenMarkov(others, states, seed, settings);
    for (std::size_t i = fold; i < trials.size(); i += folds)
      by_trial[static_cast<Eigen::Index>(i)] =
          logLikelihood(model, trials[i]) / static_cast<double>(trials[i].rows());
  }
  return by_trial;
}

/// Even and odd trials, first and last ones, and what is left: three halvings that have nothing in
/// common. Of two trials they are one.
bool inFirstHalf(std::size_t trial, std::size_t trials, int halving) {
  const bool odd = trial % 2 == 1, early = trial < trials / 2;
  return halving == 0 ? odd : halving == 1 ? early : odd != early;
}

double repeatedBy(const std::vector<Eigen::MatrixXd>& trials, int states, std::uint64_t seed,
                  const HiddenMarkovSettings& settings) {
  std::vector<double> repeated;
  for (int halving = 0; halving < (trials.size() < 3 ? 1 : kHalvings); ++halving) {
    std::vector<Eigen::MatrixXd> halves[2];
    for (std::size_t i = 0; i < trials.size(); ++i)
      halves[inFirstHalf(i, trials.size(), halving) ? 0 : 1].push_back(trials[i]);
    std::vector<int> paths[2];
    for (int half = 0; half < 2; ++half) {
      const HiddenMarkov model = fitHiddenMarkov(halves[half], states, seed, settings);
      for (const Eigen::MatrixXd& t : trials) {
        const std::vector<int> path = mostLikely(model, t);
        paths[half].insert(paths[half].end(), path.begin(), path.end());
      }
    }
    repeated.push_back(adjustedRandIndex(contingencyOf(paths[0], paths[1])));
  }
  std::sort(repeated.begin(), repeated.end());
  return repeated[repeated.size() /
                  2];  // one fit caught below the greatest likelihood does not matter
}

}  // namespace

std::size_t smallestHalf(std::size_t trials) {
  std::size_t smallest = trials;
  for (int halving = 0; halving < (trials < 3 ? 1 : kHalvings); ++halving) {
    std::size_t first = 0;
    for (std::size_t i = 0; i < trials; ++i) first += inFirstHalf(i, trials, halving);
    smallest = std::min({smallest, first, trials - first});
  }
  return smallest;
}

StatesProposal proposeStates(const std::vector<Eigen::MatrixXd>& trials, int most,
                             std::uint64_t seed, int folds, const HiddenMarkovSettings& settings,
                             const std::function<void(int states)>& begins) {
  const auto parts = static_cast<std::size_t>(foldsFor(trials.size(), most, folds));
  const auto count = static_cast<double>(trials.size());
  std::size_t steps = 0;
  for (const Eigen::MatrixXd& t : trials) steps += static_cast<std::size_t>(t.rows());
  StatesProposal proposal;
  for (int states = 1; states <= most; ++states) {
    if (begins) begins(states);
    const double criterion =
        bic(fitHiddenMarkov(trials, states, seed, settings),
            steps);  // first: it names what is wrong with a trial by its number
    const Eigen::VectorXd by_trial = heldOutLikelihoods(trials, states, seed, parts, settings);
    const double mean = by_trial.mean(), squares = (by_trial.array() - mean).square().sum();
    proposal.curve.push_back({states, mean, std::sqrt(squares / (count - 1) / count), criterion,
                              states > 1 ? repeatedBy(trials, states, seed, settings) : 1});
  }
  const auto best =
      std::max_element(proposal.curve.begin(), proposal.curve.end(),
                       [](const HeldOut& a, const HeldOut& b) { return a.mean < b.mean; });
  const auto fewest = std::find_if(proposal.curve.begin(), best, [&](const HeldOut& one) {
    return one.mean >= best->mean - best->standard_error;
  });
  proposal.best = best->states;
  proposal.states = fewest->states;
  double most_repeated = 0;
  for (const HeldOut& one : proposal.curve)
    if (one.states > 1) most_repeated = std::max(most_repeated, one.repeated);
  for (const HeldOut& one : proposal.curve)
    if (one.states > 1 && one.repeated >= most_repeated - kAsWell) proposal.repeatable = one.states;
  return proposal;
}

}  // namespace palpa::calibration
