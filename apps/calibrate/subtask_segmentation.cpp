#include "apps/calibrate/subtask_segmentation.h"

#include <algorithm>
#include <cmath>

#include "anatomy/base/error.h"
#include "anatomy/base/quantile.h"
#include "anatomy/base/random.h"

namespace palpa::calibrate {
namespace {

using calibration::HiddenMarkov;
using Trials = std::vector<Eigen::MatrixXd>;

constexpr std::size_t kManySteps = 2500;  // thinned from the start to no more: some seconds of work
constexpr double kChanges = 1e-6;         // of a feature that changes
constexpr int kStepsOfParameter = 2;      // as fitHiddenMarkov asks for
constexpr char kSubtasksWhere[] = "palpa calibrate subtasks";

std::size_t stepsIn(const Trials& trials) {
  std::size_t steps = 0;
  for (const Eigen::MatrixXd& t : trials) steps += static_cast<std::size_t>(t.rows());
  return steps;
}

Trials thinned(const std::vector<SubtaskSequence>& sequences, int every,
               const std::vector<int>& features) {
  Trials trials;
  for (const SubtaskSequence& s : sequences)
    trials.emplace_back(
        s.features(Eigen::seqN(0, (s.features.rows() + every - 1) / every, every), features));
  return trials;
}

/// Features that change in so many sequences that they do in each half and whenever some are held
/// out.
std::vector<int> changingFeatures(const std::vector<SubtaskSequence>& sequences, int every) {
  std::vector<int> used;
  for (int d = 0; d < kSubtaskFeatures; ++d) {
    std::size_t changing = 0;
    for (const Eigen::MatrixXd& x : thinned(sequences, every, {d}))
      changing += x.maxCoeff() - x.minCoeff() > kChanges;
    if (changing + calibration::smallestHalf(sequences.size()) > sequences.size())
      used.push_back(d);
  }
  return used;
}

/// The most states that the smallest half of the trials can be fitted to; trials are taken as the
/// shortest.
int mostStatesOf(const Trials& trials) {
  std::vector<std::size_t> lengths;
  for (const Eigen::MatrixXd& t : trials) lengths.push_back(static_cast<std::size_t>(t.rows()));
  std::sort(lengths.begin(), lengths.end());
  std::size_t half = 0;
  for (std::size_t i = 0; i < calibration::smallestHalf(trials.size()); ++i) half += lengths[i];
  const auto enough = [&](int k) {
    return half >= static_cast<std::size_t>(kStepsOfParameter) *
                       static_cast<std::size_t>(k - 1 + k * (k - 1) +
                                                2 * k * static_cast<int>(trials.front().cols()));
  };
  int most = 0;
  while (most < kMostProposed && lengths.front() >= 2 && enough(most + 1)) ++most;
  return most;
}

/// Correlation of neighbours that are in one state, features together; what is no continuous figure
/// (contact) left out.
double neighboursOf(const HiddenMarkov& model, const Trials& trials,
                    const std::vector<int>& features) {
  double together = 0, alone = 0;
  for (const Eigen::MatrixXd& t : trials) {
    const std::vector<int> path = mostLikely(model, t);
    for (std::size_t i = 1; i < path.size(); ++i)
      for (std::size_t d = 0; path[i] == path[i - 1] && d < features.size(); ++d) {
        if (features[d] == kInContact) continue;
        const auto row = static_cast<Eigen::Index>(i), column = static_cast<Eigen::Index>(d);
        const double mean = model.mean(path[i], column), variance = model.variance(path[i], column);
        together += (t(row, column) - mean) * (t(row - 1, column) - mean) / variance;
        alone += std::pow(t(row, column) - mean, 2) / variance;
      }
  }
  return alone > 0 ? together / alone : 0;
}

/// The fewer of what new trials ask for and what two halves of the trials repeat.
int takenOf(const calibration::StatesProposal& proposal) {
  return std::min(proposal.states, proposal.repeatable);
}

void standardise(const Trials& trials, SubtaskSegmentation* s) {
  const auto steps = static_cast<double>(stepsIn(trials));
  s->centre = s->spread = Eigen::VectorXd::Zero(trials.front().cols());
  for (const Eigen::MatrixXd& t : trials) s->centre += t.colwise().sum().transpose() / steps;
  for (const Eigen::MatrixXd& t : trials)
    s->spread += (t.rowwise() - s->centre.transpose()).colwise().squaredNorm().transpose() / steps;
  s->spread = s->spread.cwiseSqrt();
}

/// How many states, from steps thinned more and more; the model of the last, in its own steps.
void chooseStates(const std::vector<SubtaskSequence>& sequences, const SubtaskOptions& o,
                  SubtaskSegmentation* s) {
  std::size_t all = 0;
  for (const SubtaskSequence& q : sequences) all += static_cast<std::size_t>(q.features.rows());
  for (int every = static_cast<int>(1 + (all - 1) / kManySteps);; every *= 2) {
    const std::vector<int> features = changingFeatures(sequences, every);
    const Trials trials = features.empty() ? Trials{} : thinned(sequences, every, features);
    const int most = features.empty() ? 0 : mostStatesOf(trials);
    const bool first = s->proposal.curve.empty();
    if (first && most < std::max(2, o.states))
      throw Error("the trials are too short or too much alike for " +
                      std::to_string(std::max(2, o.states)) + " states: " + std::to_string(all) +
                      " steps of 10 ms, " + std::to_string(features.size()) + " of " +
                      std::to_string(int(kSubtaskFeatures)) + " features change",
                  kSubtasksWhere, "Record more trials");
    if (!first && (most < static_cast<int>(s->proposal.curve.size()))) return;
    s->proposal = calibration::proposeStates(trials, most, o.seed, 0, {}, [&](int states) {
      if (o.progress)
        o.progress("every " + std::to_string(10 * every) + " ms (" +
                   std::to_string(stepsIn(trials)) + " steps): " + std::to_string(states) + " of " +
                   std::to_string(most) + " states");
    });
    s->states = o.states ? o.states : takenOf(s->proposal);
    s->thinned_to = every;
    s->features = features;
    s->model = calibration::fitHiddenMarkov(trials, s->states, o.seed);
    s->neighbours = neighboursOf(s->model, trials, features);
    standardise(trials, s);
    if (s->neighbours <= kIndependent) return;
  }
}

}  // namespace

SubtaskSegmentation segment(const std::vector<SubtaskSequence>& sequences,
                            const SubtaskOptions& options) {
  if (sequences.size() < 2)
    throw Error(std::to_string(sequences.size()) +
                    (sequences.size() == 1 ? " trial is" : " trials are") +
                    " too few: 2 are needed, because some must be held out to judge by",
                kSubtasksWhere, "Give a recording of more trials, or more recordings");
  for (const SubtaskSequence& q : sequences)
    if (q.features.cols() != kSubtaskFeatures ||
        static_cast<std::size_t>(q.features.rows()) != q.labels.size() || q.labels.empty())
      throw Error("its features and labels do not belong together", q.trial, "Read it again");
  SubtaskSegmentation s;
  chooseStates(sequences, options, &s);
  const Eigen::MatrixXd stay = Eigen::MatrixXd::Identity(s.states, s.states);
  s.model.transition = stay + (s.model.transition - stay) / s.thinned_to;
  std::vector<std::vector<int>> labels;
  std::vector<int> states_of_all, labels_of_all;
  for (const SubtaskSequence& q : sequences) {
    s.paths.push_back(mostLikely(s.model, q.features(Eigen::all, s.features)));
    labels.push_back(q.labels);
    states_of_all.insert(states_of_all.end(), s.paths.back().begin(), s.paths.back().end());
    labels_of_all.insert(labels_of_all.end(), q.labels.begin(), q.labels.end());
  }
  s.steps = calibration::contingencyOf(states_of_all, labels_of_all);
  s.matching = calibration::bestMatching(s.steps);
  s.agreement = agreementOf(s.paths, labels);
  s.by_chance = agreementByChance(s.paths, labels, options.seed);
  s.looks = looksOf(sequences, s);
  return s;
}

namespace {

constexpr int kShiftings = 99;
constexpr std::size_t kChance95 = 94;  // of 99 in order

std::vector<int> endToEnd(const std::vector<std::vector<int>>& parts) {
  std::vector<int> all;
  for (const std::vector<int>& part : parts) all.insert(all.end(), part.begin(), part.end());
  return all;
}

/// A feature of the steps in a state, of all sequences.
std::vector<double> valuesOf(const std::vector<SubtaskSequence>& sequences,
                             const std::vector<std::vector<int>>& paths, int state, int feature) {
  std::vector<double> values;
  for (std::size_t q = 0; q < sequences.size(); ++q)
    for (std::size_t i = 0; i < paths[q].size(); ++i)
      if (paths[q][i] == state)
        values.push_back(sequences[q].features(static_cast<Eigen::Index>(i), feature));
  return values;
}

int visitsOf(const std::vector<std::vector<int>>& paths, int state) {
  int visits = 0;
  for (const std::vector<int>& path : paths)
    for (std::size_t i = 0; i < path.size(); ++i)
      visits += path[i] == state && (i == 0 || path[i - 1] != state);
  return visits;
}

}  // namespace

SubtaskAgreement agreementOf(const std::vector<std::vector<int>>& paths,
                             const std::vector<std::vector<int>>& labels) {
  const calibration::Contingency table =
      calibration::contingencyOf(endToEnd(paths), endToEnd(labels));
  SubtaskAgreement agreement{
      calibration::cohensKappa(table), calibration::adjustedRandIndex(table), {}};
  for (std::size_t q = 0; q < paths.size(); ++q)
    agreement.boundaries += calibration::boundaryAgreement(paths[q], labels[q], kBoundaryTolerance);
  return agreement;
}

/// Labels turned round within each trial by a tenth to nine tenths of it: as long as they were, at
/// another time.
ChanceAgreement agreementByChance(const std::vector<std::vector<int>>& paths,
                                  const std::vector<std::vector<int>>& labels, std::uint64_t seed) {
  RandomStream random = RandomStream::ofSeed(seed);
  std::vector<double> kappa, rand, f;
  for (int i = 0; i < kShiftings; ++i) {
    std::vector<std::vector<int>> shifted = labels;
    for (std::vector<int>& one : shifted)
      std::rotate(one.begin(),
                  one.begin() + static_cast<std::ptrdiff_t>((0.1 + 0.8 * random.openUniform()) *
                                                            static_cast<double>(one.size())),
                  one.end());
    const SubtaskAgreement agreement = agreementOf(paths, shifted);
    kappa.push_back(agreement.kappa);
    rand.push_back(agreement.rand);
    f.push_back(agreement.boundaries.f());
  }
  for (std::vector<double>* figures : {&kappa, &rand, &f})
    std::sort(figures->begin(), figures->end());
  return {kappa[kChance95], rand[kChance95], f[kChance95]};
}

std::vector<StateLook> looksOf(const std::vector<SubtaskSequence>& sequences,
                               const SubtaskSegmentation& s) {
  std::vector<StateLook> looks;
  for (std::size_t row = 0; row < s.steps.one.size(); ++row) {
    const int state = s.steps.one[row];
    const auto median = [&](int feature) {
      return std::exp(upperMedian(valuesOf(sequences, s.paths, state, feature)));
    };
    const Eigen::VectorXi counts = s.steps.counts.row(static_cast<Eigen::Index>(row)).transpose();
    const double steps = counts.sum();
    StateLook look;
    look.share = steps / s.steps.counts.sum();
    look.speed = median(kLogSpeed);
    look.force = median(kLogForce);
    look.shaking = median(kLogShaking);
    for (const double contact : valuesOf(sequences, s.paths, state, kInContact))
      look.contact += contact / steps;
    look.held_s = 1e-9 * static_cast<double>(kSubtaskStep_ns) * steps / visitsOf(s.paths, state);
    Eigen::Index most = 0;
    look.mostly_share = counts.maxCoeff(&most) / steps;
    look.mostly = s.steps.other[static_cast<std::size_t>(most)];
    looks.push_back(look);
  }
  return looks;
}

}  // namespace palpa::calibrate
