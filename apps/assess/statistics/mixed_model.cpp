#include "apps/assess/statistics/mixed_model.h"

#include <Eigen/Cholesky>
#include <Eigen/QR>
#include <algorithm>
#include <boost/math/distributions/students_t.hpp>
#include <boost/math/tools/minima.hpp>
#include <cmath>
#include <map>
#include <numbers>

#include "anatomy/base/error.h"

namespace palpa::statistics {
namespace {

constexpr char kMixed[] = "mixed model";
constexpr double kLargestShare = 1 - 1e-9;  // of the spread that can be the subjects' own
constexpr int kGrid = 40, kBits = 40;  // coarse search along the line; precision of the fine one

/// What of a subject's trials enters the likelihood.
struct SubjectSums {
  Eigen::VectorXd x;
  double y = 0, n = 0;
};

struct CrossProducts {
  Eigen::MatrixXd xx;
  Eigen::VectorXd xy;
  double yy = 0, n = 0;
  std::vector<SubjectSums> subjects;
};

/// The model for one ratio of the two variances.
struct AtRatio {
  Eigen::VectorXd b;
  Eigen::MatrixXd inverse;  ///< of X' V^-1 X
  double variance = 0;      ///< of the residuals
  double deviance = 0;      ///< -2 log likelihood, restricted
};

CrossProducts tablesOf(const Eigen::VectorXd& y, const Eigen::MatrixXd& x,
                       const std::vector<int>& subject) {
  CrossProducts t{
      x.transpose() * x, x.transpose() * y, y.squaredNorm(), static_cast<double>(y.size()), {}};
  std::map<int, SubjectSums> sums;
  for (Eigen::Index i = 0; i < y.size(); ++i) {
    SubjectSums& s = sums[subject[static_cast<std::size_t>(i)]];
    if (s.n == 0) s.x = Eigen::VectorXd::Zero(x.cols());
    s.x += x.row(i).transpose();
    s.y += y[i];
    s.n += 1;
  }
  for (auto& [id, s] : sums) t.subjects.push_back(std::move(s));
  return t;
}

AtRatio at(const CrossProducts& t, double ratio) {
  Eigen::MatrixXd a = t.xx;
  Eigen::VectorXd c = t.xy;
  double yy = t.yy, log_det = 0;
  for (const SubjectSums& s : t.subjects) {
    const double weight = ratio / (1 + s.n * ratio);
    a -= weight * s.x * s.x.transpose();
    c -= weight * s.y * s.x;
    yy -= weight * s.y * s.y;
    log_det += std::log1p(s.n * ratio);
  }
  const Eigen::LDLT<Eigen::MatrixXd> solver(a);
  const double free = t.n - static_cast<double>(a.rows());
  AtRatio fit{solver.solve(c), solver.solve(Eigen::MatrixXd::Identity(a.rows(), a.rows())), 0, 0};
  fit.variance = std::max(0.0, yy - c.dot(fit.b)) / free;
  fit.deviance = free * (std::log(2 * std::numbers::pi * fit.variance) + 1) + log_det +
                 solver.vectorD().array().log().sum();
  return fit;
}

/// The likeliest ratio, on the line of the share s = r / (1 + r): first coarsely, since the
/// likelihood may have two hills.
double likeliestRatio(const CrossProducts& t) {
  const auto deviance = [&](double share) { return at(t, share / (1 - share)).deviance; };
  int best = 0;
  double lowest = deviance(0);
  for (int i = 1; i <= kGrid; ++i)
    if (const double d = deviance(kLargestShare * i / kGrid); d < lowest) {
      lowest = d;
      best = i;
    }
  const double from = kLargestShare * std::max(0, best - 1) / kGrid,
               to = kLargestShare * std::min(kGrid, best + 1) / kGrid;
  const auto [share, least] = boost::math::tools::brent_find_minima(deviance, from, to, kBits);
  return least < deviance(0) ? share / (1 - share) : 0;
}

bool withinSubjects(const Eigen::VectorXd& column, const std::vector<int>& subject) {
  std::map<int, double> first;
  for (Eigen::Index i = 0; i < column.size(); ++i)
    if (const auto known = first.emplace(subject[static_cast<std::size_t>(i)], column[i]).first;
        std::abs(known->second - column[i]) > 1e-12)
      return true;
  return false;
}

void requireTables(const Eigen::VectorXd& y, const Eigen::MatrixXd& x,
                   const std::vector<std::string>& names, const std::vector<int>& subject) {
  if (x.rows() != y.size() || subject.size() != static_cast<std::size_t>(y.size()) ||
      names.size() != static_cast<std::size_t>(x.cols()))
    throw Error("values, columns and subjects are not of one length", kMixed, "Check the table");
  if (!y.allFinite() || !x.allFinite())
    throw Error("a value is not a number", kMixed, "Leave trials without a value out");
  if (y.size() <= x.cols())
    throw Error("there are fewer trials than questions", kMixed, "Collect more trials");
  if (Eigen::ColPivHouseholderQR<Eigen::MatrixXd>(x).rank() < x.cols())
    throw Error("two of the questions are the same", kMixed, "Leave one of them out");
}

FixedEffect effectOf(const std::string& name, double estimate, double error, double degrees,
                     bool within) {
  const boost::math::students_t distribution(degrees);
  FixedEffect effect{name, estimate, error, 0, 0, estimate / error, degrees, 1, within};
  effect.p = 2 * boost::math::cdf(distribution, -std::abs(effect.t));
  const double half = error * boost::math::quantile(distribution, 0.975);
  effect.low = estimate - half;
  effect.high = estimate + half;
  return effect;
}

}  // namespace

MixedModel fitMixedModel(const Eigen::VectorXd& y, const Eigen::MatrixXd& x,
                         const std::vector<std::string>& names, const std::vector<int>& subject) {
  requireTables(y, x, names, subject);
  const Eigen::VectorXd plain = Eigen::ColPivHouseholderQR<Eigen::MatrixXd>(x).solve(y),
                        rest = y - x * plain;
  if (!(rest.norm() > 1e-12 * (1 + y.norm())))
    throw Error("nothing varies beside what is asked", kMixed, "Constant values cannot be tested");
  const CrossProducts tables = tablesOf(
      rest, x, subject);  // of what plain least squares leaves: no digits are lost to a large mean
  std::vector<bool> within;
  double inner = 0;
  for (Eigen::Index c = 0; c < x.cols(); ++c) {
    within.push_back(withinSubjects(x.col(c), subject));
    inner += within.back() ? 1 : 0;
  }
  const double subjects = static_cast<double>(tables.subjects.size()),
               outer = static_cast<double>(x.cols()) - inner;
  const double between_degrees = subjects - outer, within_degrees = tables.n - subjects - inner;
  if (between_degrees < 1 || (inner > 0 && within_degrees < 1))
    throw Error("there are too few subjects or trials for these questions", kMixed, "Collect more");

  const double ratio = likeliestRatio(tables);
  const AtRatio fit = at(tables, ratio);
  MixedModel model;
  model.sd_residual = std::sqrt(fit.variance);
  model.sd_subject = std::sqrt(ratio * fit.variance);
  model.alike = ratio / (1 + ratio);
  model.log_likelihood = -fit.deviance / 2;
  model.subjects = tables.subjects.size();
  model.trials = static_cast<std::size_t>(y.size());
  for (Eigen::Index c = 0; c < x.cols(); ++c) {
    const auto i = static_cast<std::size_t>(c);
    model.effects.push_back(effectOf(names[i], plain[c] + fit.b[c],
                                     std::sqrt(fit.variance * fit.inverse(c, c)),
                                     within[i] ? within_degrees : between_degrees, within[i]));
  }
  return model;
}

}  // namespace palpa::statistics
