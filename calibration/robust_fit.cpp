#include "calibration/robust_fit.h"

#include <algorithm>
#include <boost/math/distributions/chi_squared.hpp>
#include <boost/math/distributions/students_t.hpp>
#include <cmath>
#include <limits>

#include "anatomy/base/error.h"
#include "anatomy/geometry/dense_solvers.h"

namespace palpa::calibration {
namespace {

constexpr double kGoodQuantile = 0.999;
constexpr int kLeastNormSteps = 40, kSquareSteps = 30, kSelections = 20;
constexpr double kStill = 1e-10;    // relative change of the cost below which a fit has ended
constexpr double kRounding = 1e-9;  // no block is an outlier for less: data without noise have none

using ChiSquared = boost::math::chi_squared;

class RobustFitter {
 public:
  RobustFitter(const FitProblem& problem, const std::string& where, double step)
      : problem_(problem),
        where_(where),
        step_(step),
        good_(static_cast<std::size_t>(problem.blocks), true) {}

  Fit run(double most_outliers) {
    requireEnough(problem_.blocks);
    at(VectorX::Zero(problem_.parameters));
    leastNorms();
    for (int i = 0; i < kSelections; ++i) {
      const bool changed = select();
      leastSquares();
      if (!changed && i > 0) break;
    }
    const auto out = static_cast<double>(std::count(good_.begin(), good_.end(), false));
    if (out > most_outliers * problem_.blocks)
      throw Error(std::to_string(static_cast<int>(out)) + " of " + std::to_string(problem_.blocks) +
                      " measurements do not fit the others",
                  where_,
                  "Look for a loose part, a slipped marker or mixed-up files, and measure again");
    return result();
  }

 private:
  void requireEnough(int blocks) const {
    if (blocks * problem_.size <= problem_.parameters)
      throw Error(std::to_string(blocks) + " measurements are too few", where_, "Measure more");
  }

  void at(const VectorX& dx) {
    r_ = problem_.residuals(dx);
    if (!r_.allFinite()) throw Error("a measurement is not a number", where_, "Remove it");
  }

  int independent() const { return problem_.freedom ? problem_.freedom : problem_.size; }

  double norm(int block) const { return r_.segment(block * problem_.size, problem_.size).norm(); }

  MatrixX jacobian() const {
    if (problem_.jacobian) return problem_.jacobian();
    MatrixX J(r_.size(), problem_.parameters);
    VectorX dx = VectorX::Zero(problem_.parameters);
    for (int k = 0; k < problem_.parameters; ++k) {
      dx[k] = step_;
      J.col(k) = problem_.residuals(dx);
      dx[k] = -step_;
      J.col(k) = (J.col(k) - problem_.residuals(dx)) / (2 * step_);
      dx[k] = 0;
    }
    return J;
  }

  /// J' W J and J' W r.
  struct Normal {
    MatrixX A;
    VectorX g;
  };
  Normal normalOf(const VectorX& weights) const {
    MatrixX J = jacobian();
    VectorX r = r_;
    for (int b = 0; b < problem_.blocks; ++b) {
      J.middleRows(b * problem_.size, problem_.size) *= std::sqrt(weights[b]);
      r.segment(b * problem_.size, problem_.size) *= std::sqrt(weights[b]);
    }
    MatrixX lower = MatrixX::Zero(J.cols(), J.cols());
    lower.selfadjointView<Eigen::Lower>().rankUpdate(J.transpose());
    return {lower.selfadjointView<Eigen::Lower>(), J.transpose() * r};
  }

  double cost(const VectorX& r, const VectorX& weights) const {
    double sum = 0;
    for (int b = 0; b < problem_.blocks; ++b)
      sum += weights[b] * r.segment(b * problem_.size, problem_.size).squaredNorm();
    return sum;
  }

  /// Units in which every parameter counts alike (Jacobi's), so that pixels and radians may stand
  /// side by side.
  static VectorX unitsOf(const MatrixX& A) {
    const double least = 1e-24 * A.diagonal().maxCoeff() + std::numeric_limits<double>::min();
    return A.diagonal().cwiseMax(least).cwiseSqrt().cwiseInverse();
  }

  /// One damped step of the weighted squares; the relative gain, 0 when none was found.
  double improve(const VectorX& weights) {
    const Normal normal = normalOf(weights);
    const double before = cost(r_, weights);
    const VectorX unit = unitsOf(normal.A);
    const MatrixX scaled = unit.asDiagonal() * normal.A * unit.asDiagonal();
    for (; damping_ < 1e12; damping_ *= 10) {
      MatrixX damped = scaled;
      damped.diagonal().array() += damping_;
      const VectorX dx = unit.cwiseProduct(solveSymmetric(damped, -unit.cwiseProduct(normal.g)));
      if (!dx.allFinite()) continue;
      const VectorX r = problem_.residuals(dx);
      const double after =
          r.allFinite() ? cost(r, weights) : std::numeric_limits<double>::infinity();
      if (!(after < before)) continue;
      problem_.move(dx);
      r_ = problem_.residuals(VectorX::Zero(problem_.parameters));
      damping_ = std::max(damping_ / 10, 1e-12);
      return (before - after) / before;
    }
    damping_ = 1e-6;
    return 0;
  }

  /// Weiszfeld's iteration: each block weighs the inverse of its norm.
  void leastNorms() {
    VectorX weights(problem_.blocks);
    for (int i = 0; i < kLeastNormSteps; ++i) {
      const double floor = 0.01 * medianNorm() + std::numeric_limits<double>::min();
      for (int b = 0; b < problem_.blocks; ++b) weights[b] = 1 / std::max(norm(b), floor);
      if (improve(weights) < 1e-6) break;
    }
  }

  double medianNorm() const {
    std::vector<double> norms;
    for (int b = 0; b < problem_.blocks; ++b) norms.push_back(norm(b));
    std::nth_element(norms.begin(), norms.begin() + problem_.blocks / 2, norms.end());
    return norms[static_cast<std::size_t>(problem_.blocks / 2)];
  }

  /// Which blocks are good; whether that changed.
  bool select() {
    if (problem_.keep_all) return false;
    const ChiSquared chi2(independent());
    // The median sees the fit's own freedom: few measurements leave residuals smaller than the
    // noise.
    const double freedom =
        std::sqrt(1 - static_cast<double>(problem_.parameters) / (problem_.blocks * problem_.size));
    const double scale = medianNorm() / std::sqrt(boost::math::quantile(chi2, 0.5)) / freedom;
    const double limit =
        std::max(scale * std::sqrt(boost::math::quantile(chi2, kGoodQuantile)), kRounding);
    const std::vector<bool> before = good_;
    for (int b = 0; b < problem_.blocks; ++b)
      good_[static_cast<std::size_t>(b)] = !(norm(b) > limit);
    requireEnough(static_cast<int>(std::count(good_.begin(), good_.end(), true)));
    return good_ != before;
  }

  VectorX goodWeights() const {
    VectorX weights(problem_.blocks);
    for (int b = 0; b < problem_.blocks; ++b)
      weights[b] = good_[static_cast<std::size_t>(b)] ? 1 : 0;
    return weights;
  }

  void leastSquares() {
    const VectorX weights = goodWeights();
    for (int i = 0; i < kSquareSteps; ++i)
      if (improve(weights) < kStill) break;
  }

  Fit result() const {
    Fit fit;
    fit.r = r_;
    fit.good = good_;
    double squares = 0;
    int blocks = 0;
    for (int b = 0; b < problem_.blocks; ++b) {
      if (!good_[static_cast<std::size_t>(b)]) continue;
      squares += norm(b) * norm(b);
      ++blocks;
    }
    fit.dof = blocks * problem_.size - problem_.parameters;
    const double m = independent(), q = boost::math::quantile(ChiSquared(m), kGoodQuantile);
    const double kept = problem_.keep_all ? 1
                                          : boost::math::cdf(ChiSquared(m + 2), q) /
                                                kGoodQuantile;  // of the variance, inside the cut
    fit.sigma = std::sqrt(squares / fit.dof / kept);
    fit.rms = std::sqrt(squares / blocks);
    const MatrixX information = normalOf(goodWeights()).A;
    const VectorX unit = unitsOf(information);
    const MatrixX scaled = unit.asDiagonal() * information * unit.asDiagonal();
    fit.covariance =
        fit.sigma * fit.sigma * unit.asDiagonal() * pseudoInverse(scaled) * unit.asDiagonal();
    return fit;
  }

  const FitProblem& problem_;
  const std::string& where_;
  double step_, damping_ = 1e-6;
  VectorX r_;
  std::vector<bool> good_;
};

}  // namespace

int Fit::outliers() const { return static_cast<int>(std::count(good.begin(), good.end(), false)); }

double Fit::halfWidth95(int i) const {
  return boost::math::quantile(boost::math::students_t(dof), 0.975) * std::sqrt(covariance(i, i));
}

Fit robustFit(const FitProblem& problem, const std::string& where, double most_outliers,
              double step) {
  return RobustFitter(problem, where, step).run(most_outliers);
}

Fit nearFit(FitProblem problem, double signal_rms, const std::string& where) {
  constexpr double kNear = 0.1;
  problem.keep_all = true;
  Fit fit = robustFit(problem, where);
  if (fit.sigma < kNear * signal_rms) return fit;
  problem.keep_all = false;
  return robustFit(problem, where);
}

}  // namespace palpa::calibration
