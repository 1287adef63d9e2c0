#include "calibration/expert_path.h"

#include <algorithm>
#include <cmath>
#include <map>

#include "anatomy/base/error.h"
#include "anatomy/base/pinned_math.h"
#include "anatomy/base/quantile.h"
#include "calibration/rotation.h"

namespace palpa::calibration {
namespace {

constexpr double kNeverOut_m = 0.0005, kNeverOut_rad = 0.5 * kDegree;
constexpr double kNormal = 1.4826;  // sd / median absolute deviation, normal distribution
constexpr double kLargestShareOut = 0.2;
constexpr double kDisagree_rad = 10 * kDegree, kDisagree_m = 0.010;
constexpr double kLeastAcceptable_rad = 2 * kDegree, kLeastAcceptable_m = 0.001;
constexpr double kShortestLine = 0.002;  // m
constexpr const char* kWhere = "experts' trials";

double angle(const Vec3& a, const Vec3& b) { return pinned::atan2(a.cross(b).norm(), a.dot(b)); }
double distance(const Vec3& a, const Vec3& b) { return (a - b).norm(); }

/// A trial in the axes of its own body's teaching line.
struct OwnTrial {
  Vec3 entry, start, end, direction;
  double depth;
};

/// `turned`: how deep the needle is turned, m; the direction's axes begin there.
std::vector<OwnTrial> aboutOwnLines(const std::vector<ExpertTrial>& trials, double turned) {
  std::vector<OwnTrial> own;
  for (const ExpertTrial& t : trials) {
    const Mat3 to_own = axesOf(t.line).transpose();
    own.push_back({to_own * (t.entry_L - t.line.entry_L), to_own * (t.start_L - t.line.entry_L),
                   to_own * (t.end_L - t.line.target_L),
                   axesOf(t.line, turned).transpose() * t.direction_L, t.depth});
  }
  return own;
}

using Trials = std::vector<OwnTrial>;

template <class Get>
Vec3 medianOf(const Trials& trials, Get get) {
  Vec3 centre;
  for (int axis = 0; axis < 3; ++axis) {
    std::vector<double> values;
    for (const OwnTrial& trial : trials) values.push_back(get(trial)[axis]);
    centre[axis] = median(std::move(values));
  }
  return centre;
}

Vec3 entryOf(const OwnTrial& t) { return t.entry; }
Vec3 directionOf(const OwnTrial& t) { return t.direction; }
Vec3 startOf(const OwnTrial& t) { return t.start; }
Vec3 endOf(const OwnTrial& t) { return t.end; }
double depthOf(const OwnTrial& t) { return t.depth; }

template <class Each>
std::vector<double> valuesOf(const Trials& trials, Each each) {
  std::vector<double> values;
  for (const OwnTrial& trial : trials) values.push_back(each(trial));
  return values;
}

/// Marks in `out` what is beyond `factor` times the median deviation.
void markBeyond(const std::vector<double>& deviations, double factor, double never_out,
                std::vector<bool>* out) {
  const double limit = std::max(factor * median(deviations), never_out);
  for (std::size_t i = 0; i < deviations.size(); ++i)
    if (deviations[i] > limit) (*out)[i] = true;
}

template <class Get, class Measure>
void markOutliers(const Trials& trials, Get get, Measure measure, double never_out,
                  std::vector<bool>* out) {
  const Vec3 centre = medianOf(trials, get);
  markBeyond(valuesOf(trials, [&](const OwnTrial& t) { return measure(get(t), centre); }), 3,
             never_out, out);
}

void markDepthOutliers(const Trials& trials, std::vector<bool>* out) {
  std::vector<double> values = valuesOf(trials, depthOf);
  const double centre = median(values);
  for (double& value : values) value = std::abs(value - centre);
  markBeyond(values, 3 * kNormal, kNeverOut_m, out);
}

void checkTrial(const ExpertTrial& trial, std::size_t number) {
  const std::string where = "trial " + std::to_string(number + 1) + " of expert " + trial.expert;
  const bool finite = trial.entry_L.allFinite() && trial.direction_L.allFinite() &&
                      trial.start_L.allFinite() && trial.end_L.allFinite() &&
                      std::isfinite(trial.depth);
  if (!finite) throw Error("it holds a value that is not a number", where, "Leave the trial out");
  if (std::abs(trial.direction_L.norm() - 1) > 1e-3)
    throw Error("its direction is not a unit vector", where, "Leave the trial out");
  if ((trial.end_L - trial.start_L).norm() < kShortestLine)
    throw Error("its path of phase 2 is shorter than 2 mm", where, "Leave the trial out");
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
  std::vector<double> depths;
  for (const ExpertTrial& trial : trials) depths.push_back(trial.depth);
  const Trials own = aboutOwnLines(trials, median(std::move(depths)));
  std::vector<bool> out(trials.size(), false);
  markOutliers(own, entryOf, distance, kNeverOut_m, &out);
  markOutliers(own, startOf, distance, kNeverOut_m, &out);
  markOutliers(own, endOf, distance, kNeverOut_m, &out);
  markOutliers(own, directionOf, angle, kNeverOut_rad, &out);
  markDepthOutliers(own, &out);
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

double meanDepth(const std::vector<ExpertTrial>& trials) {
  double sum = 0;
  for (const ExpertTrial& trial : trials) sum += trial.depth;
  return sum / static_cast<double>(trials.size());
}

template <class Get>
Vec3 meanOf(const Trials& trials, Get get) {
  Vec3 sum = Vec3::Zero();
  for (const OwnTrial& trial : trials) sum += get(trial);
  return sum / static_cast<double>(trials.size());
}

/// Root mean square of the deviations over the square root of their dimensions.
template <class Deviation>
double spread(const Trials& trials, int dimensions, Deviation deviation) {
  double sum = 0;
  for (const OwnTrial& trial : trials) sum += pinned::pow(deviation(trial), 2);
  return std::sqrt(sum / static_cast<double>(trials.size()) / dimensions);
}

/// From the infinite line in the direction `along`.
double fromLine(const Vec3& offset, const Vec3& along) { return offset.cross(along).norm(); }

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
}

void nameExperts(const std::vector<ExpertTrial>& trials, ExpertPath* path) {
  for (const ExpertTrial& trial : trials) path->experts.push_back(trial.expert);
  std::sort(path->experts.begin(), path->experts.end());
  path->experts.erase(std::unique(path->experts.begin(), path->experts.end()), path->experts.end());
}

void fitMeans(const Trials& own, ExpertPath* path) {
  path->entry = meanOf(own, entryOf);
  const Vec3 sum = meanOf(own, directionOf);
  if (sum.norm() < 0.1)
    throw Error("the directions of the needle cancel", kWhere, "Check the registration");
  path->direction = sum.normalized();
  path->line_from = meanOf(own, startOf);
  path->line_to = meanOf(own, endOf);
}

/// About the means. Start and end are measured across the way to the vein: how far along it the
/// needle was turned or stopped is no deviation from the line.
void fitSpreads(const Trials& own, ExpertPath* path) {
  path->entry_sd =
      spread(own, 2, [&](const OwnTrial& t) { return distance(t.entry, path->entry); });
  path->depth_sd = spread(own, 1, [&](const OwnTrial& t) { return t.depth - path->depth; });
  path->direction_sd =
      spread(own, 2, [&](const OwnTrial& t) { return angle(t.direction, path->direction); });
  path->line_sd = spread(own, 4, [&](const OwnTrial& t) {
    return pinned::hypot(fromLine(t.start - path->line_from, Vec3::UnitX()),
                         fromLine(t.end - path->line_to, Vec3::UnitX()));
  });
  path->entry_acceptable = std::max(2 * path->entry_sd, kLeastAcceptable_m);
  path->depth_acceptable = std::max(2 * path->depth_sd, kLeastAcceptable_m);
  path->direction_acceptable = std::max(2 * path->direction_sd, kLeastAcceptable_rad);
  path->line_acceptable = std::max(2 * path->line_sd, kLeastAcceptable_m);
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
  path.depth = meanDepth(kept);
  const Trials own = aboutOwnLines(kept, path.depth);
  fitMeans(own, &path);
  fitSpreads(own, &path);
  checkAgreement(path);
  return path;
}

TaughtPath ExpertPath::onBody(const TeachingLine& line) const {
  TaughtPath taught;
  taught.entry_sd = entry_sd;
  taught.entry_acceptable = entry_acceptable;
  taught.depth = depth;
  taught.depth_acceptable = depth_acceptable;
  taught.direction_sd = direction_sd;
  taught.direction_acceptable = direction_acceptable;
  taught.line_acceptable = line_acceptable;
  const bool own = axes == PathAxes::own_line;
  const Mat3 places = own ? axesOf(line) : Mat3(Mat3::Identity()),
             directions = own ? axesOf(line, depth) : Mat3(Mat3::Identity());
  const Vec3 from_L = own ? line.entry_L : Vec3(Vec3::Zero()),
             to_L = own ? line.target_L : Vec3(Vec3::Zero());
  taught.entry_L = from_L + places * entry;
  taught.direction_L = directions * direction;
  taught.line_from_L = from_L + places * line_from;
  taught.line_to_L = to_L + places * line_to;
  return taught;
}

namespace {

constexpr double kShortest = 0.005;  // m
const double kParallel = pinned::sin(2 * kDegree);

}  // namespace

Mat3 axesOf(const TeachingLine& line, double depth) {
  const Vec3 way_L = line.target_L - line.entry_L - depth * line.inward_L;
  const Vec3 along_L = way_L.normalized();
  const Vec3 across_L = line.inward_L - line.inward_L.dot(along_L) * along_L;
  if (!(way_L.norm() >= kShortest) || !(across_L.norm() >= kParallel))
    throw Error("the way from the entry to the vein is too short or runs along the skin's normal",
                "teaching line", "Check the landmarks entry_point and vein_target");
  Mat3 axes;
  axes << along_L, across_L.normalized(), along_L.cross(across_L.normalized());
  return axes;
}

}  // namespace palpa::calibration
