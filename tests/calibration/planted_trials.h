#pragma once

#include <cmath>
#include <cstdint>
#include <vector>

#include "anatomy/base/random.h"
#include "calibration/parts/hidden_markov.h"

/// Trials of which the states are known.
namespace palpa::calibration::test {

struct PlantedTrials {
  std::vector<Eigen::MatrixXd> trials;
  std::vector<std::vector<int>> paths;
  std::vector<int> path() const {
    std::vector<int> all;
    for (const std::vector<int>& one : paths) all.insert(all.end(), one.begin(), one.end());
    return all;
  }
};

/// States held for 20 steps in the mean, mostly left for the next one. Their features lie `apart`
/// standard deviations from each other, the first about 0, the second in other units about 7.
inline HiddenMarkov plantedModel(int states, double apart) {
  HiddenMarkov m;
  m.start = Eigen::VectorXd::Constant(states, states > 1 ? 0.1 / (states - 1) : 1);
  m.transition = Eigen::MatrixXd::Constant(states, states, states > 2 ? 0.01 / (states - 2) : 0);
  m.mean.resize(states, 2);
  m.variance.resize(states, 2);
  m.start[0] = states > 1 ? 0.9 : 1;
  for (Eigen::Index k = 0; k < states; ++k) {
    m.transition(k, k) = 0.95;
    m.transition(k, (k + 1) % states) = states > 2 ? 0.04 : 0.05;
    m.mean.row(k) << apart * static_cast<double>(k % 2),
        7 + 1e-3 * apart * static_cast<double>(k / 2);
    m.variance.row(k) << 1, 1e-6;
  }
  return m;
}

inline int plantedDraw(const Eigen::VectorXd& chances, RandomStream* random) {
  double left = random->openUniform();
  int k = 0;
  while (k + 1 < chances.size() && (left -= chances[k]) > 0) ++k;
  return k;
}

inline PlantedTrials simulated(const HiddenMarkov& m, std::uint64_t seed, int trials = 8,
                               int steps = 250) {
  RandomStream random = RandomStream::ofSeed(seed);
  PlantedTrials all;
  for (int i = 0; i < trials; ++i) {
    Eigen::MatrixXd x(steps, m.mean.cols());
    std::vector<int> path;
    for (int t = 0; t < steps; ++t) {
      path.push_back(plantedDraw(
          t == 0 ? m.start : Eigen::VectorXd(m.transition.row(path.back()).transpose()), &random));
      for (Eigen::Index d = 0; d < x.cols(); ++d)
        x(t, d) =
            m.mean(path.back(), d) + std::sqrt(m.variance(path.back(), d)) * random.openNormal();
    }
    all.trials.push_back(x);
    all.paths.push_back(path);
  }
  return all;
}

inline std::vector<int> mostLikelyOfAll(const HiddenMarkov& m,
                                        const std::vector<Eigen::MatrixXd>& trials) {
  std::vector<int> all;
  for (const Eigen::MatrixXd& t : trials) {
    const std::vector<int> path = mostLikely(m, t);
    all.insert(all.end(), path.begin(), path.end());
  }
  return all;
}

}  // namespace palpa::calibration::test
