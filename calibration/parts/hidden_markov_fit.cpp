#include <algorithm>
#include <cmath>
#include <numeric>
#include <string>

#include "anatomy/base/error.h"
#include "anatomy/base/random.h"
#include "calibration/parts/hidden_markov.h"

namespace palpa::calibration {
namespace {

constexpr double kLeastChance = 1e-6;   // of a start or a move
constexpr double kNoWeight = 1e-9;      // steps: what is held for less stays as it was
constexpr double kNeverChanges = 1e-9;  // spread of a feature, relative to its largest value
constexpr int kLloydRounds = 5, kStepsPerParameter = 2;

using Sequences = std::vector<Eigen::MatrixXd>;

/// SplitMix64 (Steele, Lea, Flood 2014): the same on every machine.
class SeedStream {
 public:
  explicit SeedStream(std::uint64_t seed) : state_(seed) {}
  double uniform() { return static_cast<double>(next() >> 11) * 0x1.0p-53; }  // in [0, 1)

 private:
  std::uint64_t next() {
    const std::uint64_t bits = splitMix64(state_);
    state_ += kSplitMixStep;
    return bits;
  }
  std::uint64_t state_;
};

Eigen::Index stepsOf(const Sequences& trials) {
  return std::accumulate(trials.begin(), trials.end(), Eigen::Index{0},
                         [](Eigen::Index sum, const Eigen::MatrixXd& t) { return sum + t.rows(); });
}

void requireSequences(const Sequences& trials) {
  if (trials.empty() || trials.front().cols() < 1)
    throw Error("there is no trial, or it has no feature", kHmmWhere, "Record trials");
  for (std::size_t i = 0; i < trials.size(); ++i) {
    const std::string trial = "trial " + std::to_string(i + 1);
    if (trials[i].rows() < 2)
      throw Error(trial + " has fewer than two steps", kHmmWhere, "Leave it out");
    if (trials[i].cols() != trials.front().cols())
      throw Error(trial + " has " + std::to_string(trials[i].cols()) + " features, trial 1 has " +
                      std::to_string(trials.front().cols()),
                  kHmmWhere, "Compute the same features for each");
    if (!trials[i].allFinite())
      throw Error(trial + " holds a value that is not a number", kHmmWhere,
                  "Remove its step or the trial");
  }
}

void requireStates(const Sequences& trials, int states, const HiddenMarkovSettings& s) {
  if (states < 1 || s.starts < 1 || s.most_iterations < 1 || !(s.least_gain >= 0) ||
      !(s.least_variance > 0))
    throw Error(
        "states, starts and iterations must be 1 at least, the gain 0 at least, the variance above "
        "0",
        kHmmWhere, "Correct the settings");
  const Eigen::Index needed = kStepsPerParameter * static_cast<Eigen::Index>(hiddenMarkovParameters(
                                                       states, trials.front().cols()));
  if (stepsOf(trials) < needed)
    throw Error(std::to_string(stepsOf(trials)) + " steps are too few for " +
                    std::to_string(states) + " states, " + std::to_string(needed) + " are needed",
                kHmmWhere, "Record more trials, or ask for fewer states");
}

/// Centre and spread of each feature over all trials.
struct FeatureScale {
  Eigen::VectorXd centre, spread;
};

FeatureScale scaleOf(const Sequences& trials) {
  const auto steps = static_cast<double>(stepsOf(trials));
  FeatureScale scale{Eigen::VectorXd::Zero(trials.front().cols()),
                     Eigen::VectorXd::Zero(trials.front().cols())};
  Eigen::VectorXd largest = scale.centre;
  for (const Eigen::MatrixXd& t : trials) {
    scale.centre += t.colwise().sum().transpose() / steps;
    largest = largest.cwiseMax(t.cwiseAbs().colwise().maxCoeff().transpose());
  }
  for (const Eigen::MatrixXd& t : trials)
    scale.spread +=
        (t.rowwise() - scale.centre.transpose()).colwise().squaredNorm().transpose() / steps;
  scale.spread = scale.spread.cwiseSqrt();
  for (Eigen::Index d = 0; d < largest.size(); ++d) {
    const std::string feature = "feature " + std::to_string(d + 1);
    if (!std::isfinite(scale.spread[d]))
      throw Error(feature + " is too large", kHmmWhere, "Use another unit");
    if (!(scale.spread[d] > kNeverChanges * largest[d]))
      throw Error(feature + " never changes", kHmmWhere, "Leave it out");
  }
  return scale;
}

/// Standardised, a feature a row, a step a column.
Sequences standardised(const Sequences& trials, const FeatureScale& scale) {
  Sequences xs;
  for (const Eigen::MatrixXd& t : trials)
    xs.emplace_back(
        ((t.transpose().colwise() - scale.centre).array().colwise() / scale.spread.array())
            .matrix());
  return xs;
}

/// What is expected of the hidden states, given model and trials: sums over steps.
struct Expected {
  Expected(Eigen::Index states, Eigen::Index features)
      : start(Eigen::VectorXd::Zero(states)),
        steps(start),
        when(start),
        moves(Eigen::MatrixXd::Zero(states, states)),
        sum(Eigen::MatrixXd::Zero(states, features)),
        squares(sum) {}
  /// `held`: P(state), a step a column.
  void add(const Eigen::MatrixXd& x, const Eigen::MatrixXd& held) {
    start += held.col(0);
    steps += held.rowwise().sum();
    when += held * Eigen::VectorXd::LinSpaced(held.cols(), 0, 1);
    sum.noalias() += held * x.transpose();
    squares.noalias() += held * x.cwiseAbs2().transpose();
  }
  Eigen::VectorXd start, steps, when;  // when: steps times share of the trial gone
  Eigen::MatrixXd moves, sum, squares;
  double log_likelihood = 0;
};

Expected expectation(const HiddenMarkov& m, const Sequences& xs) {
  Expected e(m.states(), m.mean.cols());
  for (const Eigen::MatrixXd& x : xs) {
    const ForwardSweep forward = forwardSweep(m, x);
    const BackwardSweep backward = backwardSweep(m, forward);
    e.moves += (forward.belief.leftCols(x.cols() - 1) *
                backward.onward.rightCols(x.cols() - 1).transpose())
                   .cwiseProduct(m.transition);
    e.add(x, forward.belief.cwiseProduct(backward.after));
    e.log_likelihood += forward.log_likelihood;
  }
  return e;
}

/// The p with the greatest sum of counts ln p among those that sum to 1 and are kLeastChance at
/// least: what would fall below is held there.
Eigen::VectorXd chancesOf(const Eigen::VectorXd& counts) {
  const Eigen::Index n = counts.size();
  Eigen::VectorXd p = Eigen::VectorXd::Zero(n),
                  shared = counts;  // shared: counts of those that are not held
  for (bool changed = true; changed;) {
    changed = false;
    const double left = 1 - p.sum(), sum = shared.sum();
    for (Eigen::Index k = 0; k < n; ++k) {
      if (p[k] > 0 || shared[k] * left >= kLeastChance * sum) continue;
      p[k] = kLeastChance;
      shared[k] = 0;
      changed = true;
    }
  }
  return p + shared * ((1 - p.sum()) / shared.sum());
}

HiddenMarkov maximised(const Expected& e, HiddenMarkov m, double least_variance) {
  m.start = chancesOf(e.start);
  for (Eigen::Index k = 0; k < m.states(); ++k) {
    if (e.moves.row(k).sum() > kNoWeight)
      m.transition.row(k) = chancesOf(e.moves.row(k).transpose()).transpose();
    if (e.steps[k] < kNoWeight) continue;
    m.mean.row(k) = e.sum.row(k) / e.steps[k];
    m.variance.row(k) =
        (e.squares.row(k) / e.steps[k] - m.mean.row(k).cwiseAbs2()).cwiseMax(least_variance);
  }
  return m;
}

Eigen::RowVectorXd squaredDistances(const Eigen::MatrixXd& x, const Eigen::VectorXd& from) {
  return (x.colwise() - from).colwise().squaredNorm();
}

/// k-means++: each further mean is a step drawn by its squared distance from the nearest so far. A
/// mean a column.
Eigen::MatrixXd seededMeans(const Eigen::MatrixXd& x, int states, SeedStream* random) {
  Eigen::MatrixXd means(x.rows(), states);
  Eigen::RowVectorXd nearest = Eigen::RowVectorXd::Ones(x.cols());
  for (Eigen::Index k = 0; k < states; ++k) {
    double left = random->uniform() * nearest.sum();
    Eigen::Index at = 0;
    while (at + 1 < x.cols() && (left -= nearest[at]) >= 0) ++at;
    means.col(k) = x.col(at);
    const Eigen::RowVectorXd distances = squaredDistances(x, means.col(k));
    nearest = k == 0 ? distances : Eigen::RowVectorXd(nearest.cwiseMin(distances));
  }
  return means;
}

/// 1 where a step belongs to a mean, a mean a row, a step a column.
Eigen::MatrixXd belonging(const Eigen::MatrixXd& x, const Eigen::MatrixXd& means) {
  Eigen::MatrixXd distances(means.cols(), x.cols()),
      one = Eigen::MatrixXd::Zero(means.cols(), x.cols());
  for (Eigen::Index k = 0; k < means.cols(); ++k)
    distances.row(k) = squaredDistances(x, means.col(k));
  for (Eigen::Index t = 0; t < x.cols(); ++t) {
    Eigen::Index nearest = 0;
    distances.col(t).minCoeff(&nearest);
    one(nearest, t) = 1;
  }
  return one;
}

Eigen::MatrixXd joined(const Sequences& xs) {
  Eigen::Index steps = 0, at = 0;
  for (const Eigen::MatrixXd& x : xs) steps += x.cols();
  Eigen::MatrixXd all(xs.front().rows(), steps);
  for (const Eigen::MatrixXd& x : xs) {
    all.middleCols(at, x.cols()) = x;
    at += x.cols();
  }
  return all;
}

HiddenMarkov firstGuess(const Sequences& xs, int states, SeedStream* random,
                        double least_variance) {
  const Eigen::Index features = xs.front().rows();
  const Eigen::MatrixXd all = joined(xs);
  Eigen::MatrixXd means = seededMeans(all, states, random);
  for (int round = 0; round < kLloydRounds; ++round) {
    const Eigen::MatrixXd one = belonging(all, means), sums = all * one.transpose();
    for (Eigen::Index k = 0; k < states; ++k)
      if (one.row(k).sum() > 0) means.col(k) = sums.col(k) / one.row(k).sum();
  }
  Expected e(states, features);
  e.start.setOnes();
  e.moves.setOnes();
  for (const Eigen::MatrixXd& x : xs) {
    const Eigen::MatrixXd one = belonging(x, means);
    e.moves += one.leftCols(x.cols() - 1) * one.rightCols(x.cols() - 1).transpose();
    e.add(x, one);
  }
  const HiddenMarkov m{
      e.start, e.moves, means.transpose(), Eigen::MatrixXd::Ones(states, features), 0, {}, false};
  return maximised(e, m, least_variance);
}

/// States by when in a trial they are held.
HiddenMarkov inOrder(const HiddenMarkov& m, const Eigen::VectorXd& when) {
  std::vector<Eigen::Index> order(static_cast<std::size_t>(when.size()));
  std::iota(order.begin(), order.end(), 0);
  std::stable_sort(order.begin(), order.end(),
                   [&](Eigen::Index a, Eigen::Index b) { return when[a] < when[b]; });
  HiddenMarkov ordered = m;
  ordered.start = m.start(order);
  ordered.transition = m.transition(order, order);
  ordered.mean = m.mean(order, Eigen::all);
  ordered.variance = m.variance(order, Eigen::all);
  return ordered;
}

HiddenMarkov climbed(HiddenMarkov m, const Sequences& xs, double steps,
                     const HiddenMarkovSettings& s) {
  Expected e = expectation(m, xs);
  m.climb = {e.log_likelihood};
  for (int i = 0; i < s.most_iterations && !m.converged; ++i) {
    m = maximised(e, std::move(m), s.least_variance);
    e = expectation(m, xs);
    m.converged = e.log_likelihood - m.climb.back() <= s.least_gain * steps;
    m.climb.push_back(e.log_likelihood);
  }
  m.log_likelihood = m.climb.back();
  return inOrder(m, e.when.cwiseQuotient(e.steps.cwiseMax(kNoWeight)));
}

/// From standard units to the features' own.
void putInUnits(const FeatureScale& scale, double steps, HiddenMarkov* m) {
  m->mean = ((m->mean.array().rowwise() * scale.spread.transpose().array()).rowwise() +
             scale.centre.transpose().array())
                .matrix();
  m->variance =
      (m->variance.array().rowwise() * scale.spread.transpose().array().square()).matrix();
  const double denser = steps * scale.spread.array().log().sum();
  m->log_likelihood -= denser;
  for (double& reached : m->climb) reached -= denser;
}

}  // namespace

HiddenMarkov fitHiddenMarkov(const std::vector<Eigen::MatrixXd>& trials, int states,
                             std::uint64_t seed, const HiddenMarkovSettings& settings) {
  requireSequences(trials);
  requireStates(trials, states, settings);
  const FeatureScale scale = scaleOf(trials);
  const Sequences xs = standardised(trials, scale);
  const auto steps = static_cast<double>(stepsOf(trials));
  SeedStream random(seed);
  HiddenMarkov best;
  for (int start = 0; start < settings.starts; ++start) {
    HiddenMarkov m =
        climbed(firstGuess(xs, states, &random, settings.least_variance), xs, steps, settings);
    if (start == 0 || m.log_likelihood > best.log_likelihood) best = std::move(m);
  }
  putInUnits(scale, steps, &best);
  return best;
}

}  // namespace palpa::calibration
