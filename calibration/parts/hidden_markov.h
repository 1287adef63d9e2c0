#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include <Eigen/Core>

/// Subtasks proposed from recorded trials: a hidden Markov model whose states give Gaussian
/// features.
///
///   P(s_0 = i) = start_i
///   P(s_t = j | s_{t-1} = i) = transition_ij
///   x_td | s_t = i ~ N(mean_id, variance_id)
///
/// A trial is a matrix: a row a step (even in time), a column a feature (log speed, force, contact
/// ...), in any unit: columns are standardised inside and the answer is given in the units that
/// came. Features are independent given the state, and a state knows nothing of how long it has
/// lasted: real hands are smoother, so that likelihoods of densely sampled trials are too steep.
/// Sample at some tens of hertz. Work grows as steps * states^2 for each iteration, start and fold.
/// Source: Rabiner 1989, Proc. IEEE 77(2), 257-286; fit: Baum, Petrie, Soules, Weiss 1970 (Baum and
/// Welch); path: Viterbi 1967.
namespace palpa::calibration {

struct HiddenMarkov {
  Eigen::VectorXd start;           ///< K, sums to 1
  Eigen::MatrixXd transition;      ///< K x K, from row to column, rows sum to 1
  Eigen::MatrixXd mean, variance;  ///< K x D, in the features' units and their squares
  /// of the trials it was fitted to, nats, densities in the features' units
  double log_likelihood = 0;
  /// log likelihood after 0, 1, 2 ... iterations of the start that won; never falls
  std::vector<double> climb;
  bool converged = false;  ///< false: iterations ran out before the gain was small
  int states() const { return static_cast<int>(start.size()); }
  int parameters() const;  ///< free ones: K - 1 + K (K - 1) + 2 K D
};

struct HiddenMarkovSettings {
  int starts = 5;             ///< the best likelihood of so many
  int most_iterations = 200;  ///< of each start
  /// a start has ended when an iteration gains less, nats for each step of the data
  double least_gain = 1e-6;
  double least_variance = 1e-3;  ///< of a state, relative to the feature's variance over all trials
};

/// Greatest likelihood by expectation and maximisation, with scaled forward and backward sweeps.
/// Each start: means by k-means++ (Arthur, Vassilvitskii 2007) and a few of Lloyd's rounds, the
/// rest from that labelling. Maximisation is exact under two limits, so that the likelihood cannot
/// fall: variances as set, no probability below 1e-6 (a move never seen stays possible). States
/// come in the order in which they are held on average within a trial, 0 first. Same seed, same
/// bits. Throws Error for: no trial, a trial of fewer than two steps, differing columns, values
/// that are no number, a feature that never changes, fewer than two steps for each free parameter,
/// settings that make no sense.
HiddenMarkov fitHiddenMarkov(const std::vector<Eigen::MatrixXd>& trials, int states,
                             std::uint64_t seed, const HiddenMarkovSettings& settings = {});

/// The likeliest path of states as a whole (Viterbi); of equals the lower state. Empty for no
/// steps. Throws Error for columns that the model does not have and for values that are no number.
std::vector<int> mostLikely(const HiddenMarkov& model, const Eigen::MatrixXd& trial);

/// ln p(trial), nats. Throws as mostLikely.
double logLikelihood(const HiddenMarkov& model, const Eigen::MatrixXd& trial);

/// P(state | all steps), a row a step, a column a state: what is known afterwards. Throws as
/// mostLikely.
Eigen::MatrixXd smoothed(const HiddenMarkov& model, const Eigen::MatrixXd& trial);

/// P(state | steps so far): what can be known now. `belief` is the answer of the step before, empty
/// at a trial's first step. A row with a value that is no number tells nothing: the belief only
/// moves on. Throws Error for wrong sizes and a belief that is none. Allocates: not for the haptic
/// tick.
Eigen::VectorXd filtered(const HiddenMarkov& model, const Eigen::VectorXd& belief,
                         const Eigen::VectorXd& row);

/// Schwarz 1978: parameters ln(steps) - 2 ln L; less is better. It counts successive steps as
/// independent, which they are not: on recorded motion it takes as many states as it is offered.
/// For charts; proposeStates does not use it.
double bic(const HiddenMarkov& model, std::size_t steps);

/// What a number of states predicts of trials it has not seen, and whether others would find the
/// same.
struct HeldOut {
  int states = 0;
  double mean = 0;  ///< log likelihood for each step, nats, mean over trials, each held out once
  double standard_error = 0;  ///< of that mean: standard deviation over trials / sqrt(trials)
  double bic = 0;             ///< of the fit to all trials
  /// adjusted Rand index of the paths that fits to two halves of the trials find in all of them,
  /// median of three halvings; of two trials the only one
  double repeated = 1;
};

struct StatesProposal {
  int states = 0;  ///< by the one-standard-error rule
  /// of the greatest mean; when it is the most offered, offer more before you believe it
  int best = 0;
  /// Of two and more, the most whose `repeated` is within 0.05 of the greatest; whether there are
  /// two it cannot tell
  int repeatable = 1;
  std::vector<HeldOut> curve;  ///< 1, 2 ... most states
};

/// How many states: the fewest whose held-out log likelihood is within one standard error of the
/// best (Breiman, Friedman, Olshen, Stone 1984, section 3.4.3). Whole trials are held out, because
/// steps of one trial tell each other. Trial i is in fold i mod `folds`; 0 folds: each trial on its
/// own, at most ten. Trials count alike, however long, and as independent.
///
/// Holding out does not make successive steps independent. Where a feature wanders slowly within a
/// state, states that only cut it into levels predict new trials better too, and this rule takes as
/// many as it is offered, like BIC. So thin the trials first, until neighbours within a state
/// correlate by 0.1 or less, and compare with `repeatable`, which does not count steps: where
/// levels are cut, two halves of the trials cut them differently (stability, Lange, Roth, Braun,
/// Buhmann 2004, Neural Computation 16(6)). Simulated, three states held for 100 steps, features
/// first-order autoregressive with correlation 0.8 and 0.95, 6 states offered: as they are, the
/// rule takes 5 or 6, BIC 6, repeatable is 3; thinned to 0.1 all say 3.
///
/// Throws Error as fitHiddenMarkov does for folds and halves, and for fewer than two trials or
/// folds that cannot be. `begins`: called with each number of states before it is tried.
StatesProposal proposeStates(const std::vector<Eigen::MatrixXd>& trials, int most,
                             std::uint64_t seed, int folds = 0,
                             const HiddenMarkovSettings& settings = {},
                             const std::function<void(int states)>& begins = {});
/// How many trials the smaller half of so many may hold: what each number of states must be fitted
/// to.
std::size_t smallestHalf(std::size_t trials);

}  // namespace palpa::calibration

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
  /// P(steps after t | state) / P(steps after t | steps up to t), a step a column
  Eigen::MatrixXd after;
  Eigen::MatrixXd onward;  ///< the same from step t on: ratio times after, but in the first column
};

BackwardSweep backwardSweep(const HiddenMarkov& m, const ForwardSweep& forward);

/// Free parameters of so many states of so many features.
int hiddenMarkovParameters(Eigen::Index states, Eigen::Index features);

}  // namespace palpa::calibration
