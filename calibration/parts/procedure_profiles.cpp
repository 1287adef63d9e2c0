#include <algorithm>
#include <cmath>

#include "anatomy/base/error.h"
#include "anatomy/base/random.h"
#include "calibration/parts/interactive_procedures.h"

namespace palpa::calibration {
namespace {

constexpr int kRounds = 40;
constexpr double kLeastShare = 0.03;  // of a procedure: less is an accident

struct Mixture {
  Eigen::VectorXd share;
  Eigen::MatrixXd centre, spread;  ///< a profile a row
};

Eigen::RowVectorXd leastSpreads() {
  Eigen::RowVectorXd least(static_cast<int>(kInteractionFeatures));
  for (int d = 0; d < kInteractionFeatures; ++d) least[d] = interactionFeatureName(d).least_spread;
  return least;
}

/// First centres far from each other: k-means++ (Arthur, Vassilvitskii 2007) of scaled features.
Mixture begunFrom(const Eigen::MatrixXd& x, int count, const Eigen::RowVectorXd& scale,
                  RandomStream* random) {
  Mixture m{Eigen::VectorXd::Constant(count, 1.0 / count), Eigen::MatrixXd(count, x.cols()),
            scale.replicate(count, 1)};
  Eigen::VectorXd nearest = Eigen::VectorXd::Constant(x.rows(), 1.0);
  for (Eigen::Index i = 0; i < count; ++i) {
    double left = random->openUniform() * nearest.sum();
    Eigen::Index chosen = 0;
    while (chosen + 1 < x.rows() && (left -= nearest[chosen]) > 0) ++chosen;
    m.centre.row(i) = x.row(chosen);
    const Eigen::VectorXd away =
        ((x.rowwise() - x.row(chosen)).array().rowwise() / scale.array()).square().rowwise().sum();
    nearest = i == 0 ? away : Eigen::VectorXd(nearest.cwiseMin(away));
  }
  return m;
}

/// P(profile | step), a step a row.
Eigen::MatrixXd expected(const Mixture& m, const Eigen::MatrixXd& x) {
  Eigen::MatrixXd logs(x.rows(), m.share.size());
  for (Eigen::Index i = 0; i < m.share.size(); ++i)
    logs.col(i) =
        (std::log(std::max(m.share[i], 1e-12)) - m.spread.row(i).array().log().sum() -
         0.5 * ((x.rowwise() - m.centre.row(i)).array().rowwise() / m.spread.row(i).array())
                   .square()
                   .rowwise()
                   .sum())
            .matrix();
  const Eigen::VectorXd top = logs.rowwise().maxCoeff();
  logs = (logs.colwise() - top).array().exp();
  const Eigen::VectorXd sum = logs.rowwise().sum();
  return (logs.array().colwise() / sum.array()).matrix();
}

Mixture maximised(const Eigen::MatrixXd& x, const Eigen::MatrixXd& held, const Mixture& before,
                  const Eigen::RowVectorXd& least) {
  Mixture m = before;
  for (Eigen::Index i = 0; i < m.share.size(); ++i) {
    const double steps = held.col(i).sum();
    m.share[i] = steps / static_cast<double>(x.rows());
    if (steps < 1) continue;
    m.centre.row(i) = held.col(i).transpose() * x / steps;
    m.spread.row(i) = (held.col(i).transpose() *
                       (x.rowwise() - m.centre.row(i)).array().square().matrix() / steps)
                          .cwiseSqrt()
                          .cwiseMax(least);
  }
  return m;
}

Mixture fitted(const Eigen::MatrixXd& x, int count, const Eigen::RowVectorXd& scale,
               std::uint64_t seed) {
  RandomStream random = RandomStream::ofSeed(seed);
  const Eigen::RowVectorXd least = leastSpreads();
  Mixture m = begunFrom(x, count, scale, &random);
  for (int round = 0; round < kRounds; ++round) m = maximised(x, expected(m, x), m, least);
  return m;
}

}  // namespace

std::vector<ProcedureProfile> fitProfiles(const Eigen::MatrixXd& steps, const std::string& from,
                                          const std::vector<FeatureRange>& any, int most,
                                          double step_s, double least_s, std::uint64_t seed) {
  if (steps.rows() < 1 || steps.cols() != kInteractionFeatures || most < 1)
    throw Error("there is nothing to make a profile of", from, "Record trials");
  const double seconds = step_s * static_cast<double>(steps.rows());
  Eigen::RowVectorXd scale(steps.cols());
  for (Eigen::Index d = 0; d < scale.size(); ++d)
    scale[d] = any[static_cast<std::size_t>(d)].spread;
  int count = std::clamp(static_cast<int>(seconds / least_s), 1, most);
  Mixture m = fitted(steps, count, scale, seed);
  while (count > 1 && (m.share.minCoeff() < kLeastShare || m.share.minCoeff() * seconds < least_s))
    m = fitted(steps, --count, scale, seed);
  std::vector<ProcedureProfile> profiles;
  for (Eigen::Index i = 0; i < count; ++i) {
    ProcedureProfile profile{from, m.share[i], seconds * m.share[i], {}};
    for (Eigen::Index d = 0; d < scale.size(); ++d)
      profile.features.push_back({m.centre(i, d), m.spread(i, d)});
    profiles.push_back(std::move(profile));
  }
  return profiles;
}

}  // namespace palpa::calibration
