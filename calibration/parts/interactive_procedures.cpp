#include "calibration/parts/interactive_procedures.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "anatomy/base/error.h"

namespace palpa::calibration {
namespace {

constexpr char kProceduresWhere[] = "library of interactive procedures";
constexpr double kAnything = 0.02;  // e: share of a feature that says nothing
constexpr double kNoWay = -std::numeric_limits<double>::infinity();

double density(double x, const FeatureRange& range) {
  const double z = (x - range.centre) / range.spread;
  return std::exp(-0.5 * z * z) / (range.spread * std::sqrt(2 * std::numbers::pi));
}

double logProfile(const ProcedureProfile& profile, const std::vector<FeatureRange>& any,
                  const Eigen::RowVectorXd& x) {
  double sum = std::log(profile.share);
  for (std::size_t d = 0; d < any.size(); ++d) {
    const double value = x[static_cast<Eigen::Index>(d)], at_large = density(value, any[d]);
    const FeatureRange& range = profile.features[d];
    const double own = range.spread > 0 ? density(value, range) : at_large;
    sum +=
        std::log((1 - kAnything) * own + kAnything * at_large + std::numeric_limits<double>::min());
  }
  return sum;
}

double logSum(const std::vector<double>& logs) {
  const double top = *std::max_element(logs.begin(), logs.end());
  double sum = 0;
  for (const double one : logs) sum += std::exp(one - top);
  return top + std::log(sum);
}

void requireLibrary(const ProcedureLibrary& library, const Eigen::MatrixXd& features) {
  if (library.procedures.empty())
    throw Error("it names no procedure", kProceduresWhere, "Give a library with procedures");
  if (features.cols() != kInteractionFeatures ||
      library.any.size() != static_cast<std::size_t>(kInteractionFeatures))
    throw Error("the recording has " + std::to_string(features.cols()) + " features, the library " +
                    std::to_string(library.any.size()),
                kProceduresWhere, "Compute the features that the library knows");
}

/// Visits as the library counts them in steps.
struct Visits {
  std::vector<std::size_t> least;
  Eigen::VectorXd stay, leave;  ///< ln of going on, of ending after the least
  Eigen::MatrixXd move;         ///< ln, from row to column
};

Visits visitsOf(const ProcedureLibrary& library, std::size_t steps) {
  const auto count = static_cast<Eigen::Index>(library.procedures.size());
  Visits v{{},
           Eigen::VectorXd(count),
           Eigen::VectorXd(count),
           Eigen::MatrixXd::Constant(count, count, -std::log(static_cast<double>(count)))};
  v.move.diagonal().setConstant(kNoWay);
  for (Eigen::Index k = 0; k < count; ++k) {
    const InteractiveProcedure& p = library.procedures[static_cast<std::size_t>(k)];
    const auto least = static_cast<std::size_t>(std::lround(p.least_s / kInteractionStep_s));
    v.least.push_back(std::clamp<std::size_t>(least, 1, steps));
    const double more = std::max((p.mean_s - p.least_s) / kInteractionStep_s, 1.0);
    v.stay[k] = std::log(more / (1 + more));
    v.leave[k] = -std::log(1 + more);
  }
  return v;
}

/// The best way to be in a procedure at a step, its least duration done: its score, and where the
/// visit began and from which procedure.
struct Best {
  Eigen::MatrixXd score;
  Eigen::MatrixXi began, from;
};

/// `evidence`: a procedure a row, a step a column.
Best bestWays(const Visits& v, const Eigen::MatrixXd& evidence) {
  const Eigen::Index count = evidence.rows(), steps = evidence.cols();
  Eigen::MatrixXd sums = Eigen::MatrixXd::Zero(count, steps + 1);  // of the evidence before a step
  for (Eigen::Index t = 0; t < steps; ++t) sums.col(t + 1) = sums.col(t) + evidence.col(t);
  Best best{Eigen::MatrixXd::Constant(count, steps, kNoWay), Eigen::MatrixXi::Zero(count, steps),
            Eigen::MatrixXi::Constant(count, steps, -1)};
  for (Eigen::Index t = 0; t < steps; ++t)
    for (Eigen::Index k = 0; k < count; ++k) {
      if (t > 0 && best.score(k, t - 1) > kNoWay) {
        best.score(k, t) = best.score(k, t - 1) + v.stay[k] + evidence(k, t);
        best.began(k, t) = best.began(k, t - 1);
        best.from(k, t) = best.from(k, t - 1);
      }
      const Eigen::Index begin =
          t + 1 - static_cast<Eigen::Index>(v.least[static_cast<std::size_t>(k)]);
      if (begin < 0) continue;
      Eigen::Index from = -1;
      const double before =
          begin == 0 ? 0 : (best.score.col(begin - 1) + v.leave + v.move.col(k)).maxCoeff(&from);
      const double arrived = before + sums(k, t + 1) - sums(k, begin);
      if (arrived <= best.score(k, t)) continue;
      best.score(k, t) = arrived;
      best.began(k, t) = static_cast<int>(begin);
      best.from(k, t) = static_cast<int>(from);
    }
  return best;
}

}  // namespace

int ProcedureLibrary::indexOf(const std::string& procedure) const {
  for (std::size_t k = 0; k < procedures.size(); ++k)
    if (procedures[k].name == procedure) return static_cast<int>(k);
  return -1;
}

Eigen::MatrixXd procedureLikelihoods(const ProcedureLibrary& library,
                                     const Eigen::MatrixXd& features) {
  requireLibrary(library, features);
  Eigen::MatrixXd likelihoods(features.rows(),
                              static_cast<Eigen::Index>(library.procedures.size()));
  std::vector<double> by_profile;
  for (Eigen::Index t = 0; t < features.rows(); ++t) {
    const Eigen::RowVectorXd x = features.row(t);
    for (std::size_t k = 0; k < library.procedures.size(); ++k) {
      by_profile.clear();
      for (const ProcedureProfile& profile : library.procedures[k].profiles)
        by_profile.push_back(logProfile(profile, library.any, x));
      likelihoods(t, static_cast<Eigen::Index>(k)) = logSum(by_profile);
    }
  }
  return likelihoods;
}

std::vector<int> matchProcedures(const ProcedureLibrary& library, const Eigen::MatrixXd& features) {
  requireLibrary(library, features);
  const auto steps = static_cast<std::size_t>(features.rows());
  if (steps == 0) return {};
  const double counts = std::min(1.0, kInteractionStep_s / library.independent_s);
  const Best best = bestWays(visitsOf(library, steps),
                             counts * procedureLikelihoods(library, features).transpose());
  std::vector<int> path(steps);
  Eigen::Index at = 0;
  auto end = static_cast<Eigen::Index>(steps) - 1;
  best.score.col(end).maxCoeff(&at);
  while (end >= 0) {
    const Eigen::Index began = best.began(at, end), from = best.from(at, end);
    for (Eigen::Index t = began; t <= end; ++t)
      path[static_cast<std::size_t>(t)] = static_cast<int>(at);
    end = began - 1;
    at = from;
  }
  return path;
}

std::vector<FeatureRange> rangesOf(const std::vector<Eigen::MatrixXd>& features) {
  double steps = 0;
  Eigen::RowVectorXd sum = Eigen::RowVectorXd::Zero(static_cast<int>(kInteractionFeatures)),
                     squares = sum;
  for (const Eigen::MatrixXd& x : features) {
    steps += static_cast<double>(x.rows());
    sum += x.colwise().sum();
    squares += x.array().square().matrix().colwise().sum();
  }
  if (steps < 1) throw Error("there are no steps", kProceduresWhere, "Record trials");
  std::vector<FeatureRange> ranges;
  for (int d = 0; d < kInteractionFeatures; ++d) {
    const double mean = sum[d] / steps, variance = std::max(squares[d] / steps - mean * mean, 0.0);
    ranges.push_back({mean, std::max(std::sqrt(variance), interactionFeatureName(d).least_spread)});
  }
  return ranges;
}

}  // namespace palpa::calibration
