#include "calibration/expert_path.h"

#include <algorithm>
#include <cmath>
#include <map>

#include "anatomy/base/error.h"
#include "anatomy/base/quantile.h"
#include "calibration/rotation.h"

namespace palpa::calibration {
namespace {

constexpr double kNeverOut_m = 0.0005, kNeverOut_rad = 0.5 * kDegree;
constexpr double kNormal = 1.4826;  // sd / median absolute deviation, normal distribution
constexpr double kLargestShareOut = 0.2;
constexpr double kDisagree_rad = 10 * kDegree, kDisagree_m = 0.010;
constexpr double kLeastAcceptable_rad = 2 * kDegree;
constexpr const char* kWhere = "experts' trials";

double angle(const Vec3& a, const Vec3& b) { return std::atan2(a.cross(b).norm(), a.dot(b)); }
double distance(const Vec3& a, const Vec3& b) { return (a - b).norm(); }

template <class Get>
Vec3 medianOf(const std::vector<ExpertTrial>& trials, Get get) {
  Vec3 centre;
  for (int axis = 0; axis < 3; ++axis) {
    std::vector<double> values;
    for (const ExpertTrial& trial : trials) values.push_back(get(trial)[axis]);
    centre[axis] = median(std::move(values));
  }
  return centre;
}

Vec3 entryOf(const ExpertTrial& t) { return t.entry_L; }
Vec3 directionOf(const ExpertTrial& t) { return t.direction_L; }
Vec3 startOf(const ExpertTrial& t) { return t.tip_L.front(); }
Vec3 endOf(const ExpertTrial& t) { return t.tip_L.back(); }

/// Marks in `out` what is beyond `factor` times the median deviation.
void markBeyond(const std::vector<double>& deviations, double factor, double never_out,
                std::vector<bool>* out) {
  const double limit = std::max(factor * median(deviations), never_out);
  for (std::size_t i = 0; i < deviations.size(); ++i)
    if (deviations[i] > limit) (*out)[i] = true;
}

template <class Get, class Measure>
void markOutliers(const std::vector<ExpertTrial>& trials, Get get, Measure measure,
                  double never_out, std::vector<bool>* out) {
  const Vec3 centre = medianOf(trials, get);
  std::vector<double> deviations;
  for (const ExpertTrial& trial : trials) deviations.push_back(measure(get(trial), centre));
  markBeyond(deviations, 3, never_out, out);
}

void markDepthOutliers(const std::vector<ExpertTrial>& trials, std::vector<bool>* out) {
  std::vector<double> values;
  for (const ExpertTrial& trial : trials) values.push_back(trial.depth);
  const double centre = median(values);
  for (double& value : values) value = std::abs(value - centre);
  markBeyond(values, 3 * kNormal, kNeverOut_m, out);
}

void checkTrial(const ExpertTrial& trial, std::size_t number) {
  const std::string where = "trial " + std::to_string(number + 1) + " of expert " + trial.expert;
  bool finite =
      trial.entry_L.allFinite() && trial.direction_L.allFinite() && std::isfinite(trial.depth);
  for (const Vec3& p_L : trial.tip_L) finite = finite && p_L.allFinite();
  if (!finite) throw Error("it holds a value that is not a number", where, "Leave the trial out");
  if (std::abs(trial.direction_L.norm() - 1) > 1e-3)
    throw Error("its direction is not a unit vector", where, "Leave the trial out");
  if (trial.tip_L.size() < 2)
    throw Error("it has no path of the tip in phase 2", where, "Leave the trial out");
}

void checkNobodyLost(const std::vector<ExpertTrial>& trials, const std::vector<bool>& out) {
  std::map<std::string, std::pair<int, int>> of_expert;  // all, left out
  int all_out = 0;
  for (std::size_t i = 0; i < trials.size(); ++i) {
    auto& [all, left_out] = of_expert[trials[i].expert];
    ++all;
    left_out += out[i];
    all_out += out[i];
  }
  for (const auto& [expert, counts] : of_expert)
    if (2 * counts.second > counts.first)
      throw Error(std::to_string(counts.second) + " of " + std::to_string(counts.first) +
                      " trials of expert " + expert + " lie far from those of the others",
                  kWhere,
                  "Agree on one technique with this expert, or calibrate without him or her");
  if (all_out > kLargestShareOut * static_cast<double>(trials.size()))
    throw Error(std::to_string(all_out) + " of " + std::to_string(trials.size()) +
                    " trials are outliers, more than a fifth",
                kWhere, "Look for a disturbed registration, then record again");
}

std::vector<ExpertTrial> withoutOutliers(const std::vector<ExpertTrial>& trials) {
  std::vector<bool> out(trials.size(), false);
  markOutliers(trials, entryOf, distance, kNeverOut_m, &out);
  markOutliers(trials, startOf, distance, kNeverOut_m, &out);
  markOutliers(trials, endOf, distance, kNeverOut_m, &out);
  markOutliers(trials, directionOf, angle, kNeverOut_rad, &out);
  markDepthOutliers(trials, &out);
  checkNobodyLost(trials, out);
  std::vector<ExpertTrial> kept;
  for (std::size_t i = 0; i < trials.size(); ++i)
    if (!out[i]) kept.push_back(trials[i]);
  return kept;
}

void checkEnough(std::size_t have, int least, const char* remedy) {
  if (have >= static_cast<std::size_t>(std::max(least, 2))) return;
  throw Error(std::to_string(have) + " usable trials, at least " +
                  std::to_string(std::max(least, 2)) + " are needed",
              kWhere, remedy);
}

template <class Get>
Vec3 meanOf(const std::vector<ExpertTrial>& trials, Get get) {
  Vec3 sum = Vec3::Zero();
  for (const ExpertTrial& trial : trials) sum += get(trial);
  return sum / static_cast<double>(trials.size());
}

/// Root mean square of the deviations over the square root of their dimensions.
template <class Deviation>
double spread(const std::vector<ExpertTrial>& trials, int dimensions, Deviation deviation) {
  double sum = 0;
  for (const ExpertTrial& trial : trials) sum += std::pow(deviation(trial), 2);
  return std::sqrt(sum / static_cast<double>(trials.size()) / dimensions);
}

std::string inUnit(double value, const char* unit) {
  return std::to_string(static_cast<int>(std::lround(value))) + unit;
}

void checkAgreement(const ExpertPath& path) {
  const char* remedy = "Agree on one technique, check the registration, then record again";
  if (path.direction_sd > kDisagree_rad)
    throw Error("the experts disagree on the direction of the needle: standard deviation " +
                    inUnit(path.direction_sd / kDegree, "°") + ", at most 10° make sense",
                kWhere, remedy);
  if (path.entry_sd > kDisagree_m)
    throw Error("the experts disagree on the entry point: standard deviation " +
                    inUnit(1000 * path.entry_sd, " mm") + ", at most 10 mm make sense",
                kWhere, remedy);
  if (path.depth_sd > kDisagree_m)
    throw Error("the experts disagree on the depth of phase 1: standard deviation " +
                    inUnit(1000 * path.depth_sd, " mm") + ", at most 10 mm make sense",
                kWhere, remedy);
  if ((path.line_to_L - path.line_from_L).norm() < 0.002)
    throw Error("the mean path of phase 2 is shorter than 2 mm", kWhere, remedy);
}

void nameExperts(const std::vector<ExpertTrial>& trials, ExpertPath* path) {
  for (const ExpertTrial& trial : trials) path->experts.push_back(trial.expert);
  std::sort(path->experts.begin(), path->experts.end());
  path->experts.erase(std::unique(path->experts.begin(), path->experts.end()), path->experts.end());
}

}  // namespace

ExpertPath fitExpertPath(const std::vector<ExpertTrial>& trials, int least) {
  checkEnough(trials.size(), least, "Let the experts repeat the procedure");
  for (std::size_t i = 0; i < trials.size(); ++i) checkTrial(trials[i], i);
  const std::vector<ExpertTrial> kept = withoutOutliers(trials);
  checkEnough(kept.size(), least, "Outliers were left out; let the experts repeat the procedure");
  ExpertPath path;
  path.trials = static_cast<int>(kept.size());
  path.left_out = static_cast<int>(trials.size() - kept.size());
  nameExperts(kept, &path);
  path.entry_L = meanOf(kept, entryOf);
  path.entry_sd = spread(kept, 2, [&](const auto& t) { return distance(t.entry_L, path.entry_L); });
  path.depth = meanOf(kept, [](const auto& t) { return Vec3(t.depth, 0, 0); }).x();
  path.depth_sd = spread(kept, 1, [&](const auto& t) { return t.depth - path.depth; });
  const Vec3 sum = meanOf(kept, directionOf);
  if (sum.norm() < 0.1)
    throw Error("the directions of the needle cancel", kWhere, "Check the registration");
  path.direction_L = sum.normalized();
  path.direction_sd =
      spread(kept, 2, [&](const auto& t) { return angle(t.direction_L, path.direction_L); });
  path.direction_acceptable = std::max(2 * path.direction_sd, kLeastAcceptable_rad);
  path.line_from_L = meanOf(kept, startOf);
  path.line_to_L = meanOf(kept, endOf);
  checkAgreement(path);
  return path;
}

}  // namespace palpa::calibration
