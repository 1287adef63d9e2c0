#include <algorithm>
#include <cmath>
#include <string>

#include "anatomy/geometry/error.h"
#include "calibration/agreement.h"
#include "calibration/hidden_markov.h"
#include "calibration/hidden_markov_sweeps.h"

namespace palpa::calibration {
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
