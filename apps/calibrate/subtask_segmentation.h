#pragma once

#include <functional>
#include <string>
#include <vector>

#include "apps/calibrate/subtask_features.h"
#include "calibration/parts/agreement.h"
#include "calibration/parts/hidden_markov.h"

/// A segmentation of recorded trials by a hidden Markov model, beside the hand-written one. Pure:
/// sequences in, states and agreement out.
namespace palpa::calibrate {

inline constexpr int kMostProposed = 8;        ///< states offered
inline constexpr int kBoundaryTolerance = 10;  ///< steps: 100 ms
/// correlation of neighbours within a state up to which steps count as independent
inline constexpr double kIndependent = 0.1;

struct SubtaskOptions {
  std::uint64_t seed = 1;
  int states = 0;  ///< 0: as many as are proposed
  std::function<void(const std::string& stage)> progress = {};
};

/// How far two segmentations agree: of all steps together, boundaries within each sequence.
struct SubtaskAgreement {
  double kappa = 0, rand = 0;
  calibration::BoundaryAgreement boundaries;  ///< found: proposed; expected: hand-written
};
SubtaskAgreement agreementOf(const std::vector<std::vector<int>>& paths,
                             const std::vector<std::vector<int>>& labels);

/// What labels reach that are as long but at another time: 95 % of 99 shiftings within their trials
/// agree by less. Each figure by itself.
struct ChanceAgreement {
  double kappa = 0, rand = 0, boundary_f = 0;
};
ChanceAgreement agreementByChance(const std::vector<std::vector<int>>& paths,
                                  const std::vector<std::vector<int>>& labels, std::uint64_t seed);

/// What a state is like, in raw units: medians over its steps.
struct StateLook {
  double share = 0;                          ///< of all steps
  double speed = 0, force = 0, shaking = 0;  ///< m/s, N, N; the least that is told where it is less
  double contact = 0;                        ///< share of its time in contact, 0 to 1; a mean
  double held_s = 0;                         ///< mean length of a visit
  int mostly = 0;  ///< label that most of its steps have; of equals the lower
  double mostly_share = 0;
};

struct SubtaskSegmentation {
  calibration::StatesProposal proposal;  ///< of the thinned steps
  /// taken: as asked, else the fewer of what new trials ask for and what two halves repeat
  int states = 0;
  int thinned_to = 1;         ///< steps of 10 ms between those that the model was fitted to
  double neighbours = 0;      ///< their correlation within a state
  std::vector<int> features;  ///< used; the others do not change in enough of the trials
  Eigen::VectorXd centre,
      spread;  ///< of the features used, over all steps fitted to: what the fit is standardised by
  /// of steps of 10 ms: a move is as much rarer as the steps are closer
  calibration::HiddenMarkov model;
  std::vector<std::vector<int>> paths;  ///< a state a step, by sequence
  calibration::Contingency steps;       ///< states (rows), labels (columns)
  std::vector<int> matching;            ///< the column that goes with each row, -1: none
  SubtaskAgreement agreement;
  ChanceAgreement by_chance;
  std::vector<StateLook> looks;  ///< of steps.one
  double repeated() const { return proposal.curve[static_cast<std::size_t>(states - 1)].repeated; }
};

/// Of each state that occurs, as s.steps lists them.
std::vector<StateLook> looksOf(const std::vector<SubtaskSequence>& sequences,
                               const SubtaskSegmentation& s);

/// Steps are thinned until neighbours tell each other by kIndependent at most, or the trials are
/// too short for more. Same seed, same answer. Throws Error for fewer than two sequences, sequences
/// of unlike width, too few steps.
SubtaskSegmentation segment(const std::vector<SubtaskSequence>& sequences,
                            const SubtaskOptions& options = {});

}  // namespace palpa::calibrate
