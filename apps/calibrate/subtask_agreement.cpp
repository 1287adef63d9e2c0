#include <algorithm>
#include <cmath>

#include "anatomy/random_stream.h"
#include "apps/calibrate/subtask_segmentation.h"

namespace palpa::calibrate {
namespace {

constexpr int kShiftings = 99;
constexpr std::size_t kChance95 = 94;  // of 99 in order

std::vector<int> endToEnd(const std::vector<std::vector<int>>& parts) {
  std::vector<int> all;
  for (const std::vector<int>& part : parts) all.insert(all.end(), part.begin(), part.end());
  return all;
}

double medianOf(std::vector<double> values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
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
  anatomy::RandomStream random(seed);
  std::vector<double> kappa, rand, f;
  for (int i = 0; i < kShiftings; ++i) {
    std::vector<std::vector<int>> shifted = labels;
    for (std::vector<int>& one : shifted)
      std::rotate(one.begin(),
                  one.begin() + static_cast<std::ptrdiff_t>((0.1 + 0.8 * random.uniform()) *
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
      return std::exp(medianOf(valuesOf(sequences, s.paths, state, feature)));
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
