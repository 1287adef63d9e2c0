#include <gtest/gtest.h>

#include <cmath>

#include "calibration/parts/hidden_markov.h"
#include "tests/calibration/planted_trials.h"
#include "tests/support/complaint.h"

namespace palpa::calibration {
namespace {

using palpa::test::complaint, palpa::test::says, test::PlantedTrials, test::plantedModel,
    test::simulated;

HiddenMarkovSettings quick() {
  HiddenMarkovSettings settings;
  settings.starts = 3;
  settings.least_gain = 1e-4;
  return settings;
}

TEST(HiddenMarkovChoice, ProposesAsManyStatesAsWerePlanted) {
  for (const int states : {2, 3, 4}) {
    const PlantedTrials planted = simulated(plantedModel(states, 4), 8, 8, 150);
    const StatesProposal proposal = proposeStates(planted.trials, 5, 7, 4, quick());
    EXPECT_EQ(proposal.states, states);
    EXPECT_EQ(proposal.repeatable, states);
    ASSERT_EQ(proposal.curve.size(), 5u);
    for (const HeldOut& one : proposal.curve) {
      EXPECT_GT(one.standard_error, 0);
      EXPECT_LE(one.mean, proposal.curve[static_cast<std::size_t>(proposal.best - 1)].mean);
      EXPECT_GE(one.bic, proposal.curve[static_cast<std::size_t>(states - 1)]
                             .bic);  // these steps are what BIC asks for
    }
  }
}

/// Features that wander about their state's mean: first-order autoregressive.
PlantedTrials wandering(HiddenMarkov m, double correlation, std::uint64_t seed) {
  m.transition.diagonal().array() += 4;  // held for 100 steps
  m.transition /= 5;
  PlantedTrials planted = simulated(m, seed, 8, 1000);
  RandomStream random = RandomStream::ofSeed(seed + 1);
  for (std::size_t i = 0; i < planted.trials.size(); ++i)
    for (Eigen::Index d = 0; d < 2; ++d) {
      double e = random.openNormal();
      for (Eigen::Index t = 0; t < planted.trials[i].rows(); ++t) {
        const int k = planted.paths[i][static_cast<std::size_t>(t)];
        e = correlation * e + std::sqrt(1 - correlation * correlation) * random.openNormal();
        planted.trials[i](t, d) = m.mean(k, d) + std::sqrt(m.variance(k, d)) * e;
      }
    }
  return planted;
}

TEST(HiddenMarkovChoice, StepsThatTellEachOtherNeedThinningAndRepeating) {
  const PlantedTrials planted = wandering(plantedModel(3, 5), 0.8, 14);
  std::vector<Eigen::MatrixXd> brief, thinned;
  for (const Eigen::MatrixXd& t : planted.trials) {
    brief.push_back(t.topRows(400));
    thinned.push_back(t(Eigen::seqN(0, 100, 10), Eigen::all));
  }
  const StatesProposal steep = proposeStates(brief, 4, 7, 2, quick());
  EXPECT_EQ(steep.states, 4) << "better than the header says";
  EXPECT_EQ(steep.repeatable, 3);
  const StatesProposal honest = proposeStates(thinned, 4, 7, 2, quick());
  EXPECT_EQ(honest.states, 3);
  EXPECT_EQ(honest.repeatable, 3);
}

TEST(HiddenMarkovChoice, HalvesOfFewTrialsAreNeverEmpty) {
  const std::size_t smallest[] = {1, 1, 2, 2, 2, 3, 4, 4, 4};  // of 2, 3 ... 10 trials
  for (std::size_t trials = 2; trials <= 10; ++trials)
    EXPECT_EQ(smallestHalf(trials), smallest[trials - 2]) << trials;
  std::vector<int> begun;
  const StatesProposal two =
      proposeStates(simulated(plantedModel(2, 4), 21, 2, 300).trials, 3, 7, 0, quick(),
                    [&](int states) { begun.push_back(states); });
  EXPECT_EQ(begun, (std::vector<int>{1, 2, 3}));
  EXPECT_EQ(two.repeatable, 2);
  EXPECT_GT(two.curve[1].repeated, 0.8);
}

TEST(HiddenMarkovChoice, WhatTheTrialsCannotTellIsNamed) {
  const std::vector<Eigen::MatrixXd> good = simulated(plantedModel(2, 3), 13, 4, 50).trials;
  const auto proposalOf = [&](std::size_t trials, int most, int folds) {
    return complaint([&] {
      proposeStates({good.begin(), good.begin() + static_cast<std::ptrdiff_t>(trials)}, most, 1,
                    folds);
    });
  };
  EXPECT_EQ(proposalOf(4, 2, 0), "");
  EXPECT_EQ(proposalOf(2, 2, 0), "");
  EXPECT_TRUE(says(proposalOf(1, 2, 0), "1 trial is too few"));
  EXPECT_TRUE(says(proposalOf(0, 2, 0), "0 trials are too few"));
  EXPECT_TRUE(says(proposalOf(4, 2, 5), "5 folds"));
  EXPECT_TRUE(says(proposalOf(4, 0, 0), "no number of states"));
}

}  // namespace
}  // namespace palpa::calibration
