#include "apps/assess/statistics/raters.h"

#include <boost/math/distributions/fisher_f.hpp>
#include <cmath>
#include <cstdlib>
#include <limits>

#include "anatomy/base/error.h"

namespace palpa::statistics {
namespace {

constexpr char kRaters[] = "agreement of raters";

/// Mean squares of a table without repetition.
struct MeanSquares {
  double n = 0, k = 0;  // subjects, raters
  double subjects = 0, raters = 0, error = 0, within = 0;
};

MeanSquares meanSquaresOf(const Eigen::MatrixXd& x) {
  const double n = static_cast<double>(x.rows()), k = static_cast<double>(x.cols()),
               grand = x.mean();
  const double total = (x.array() - grand).square().sum();
  const double subjects = k * (x.rowwise().mean().array() - grand).square().sum();
  const double raters = n * (x.colwise().mean().array() - grand).square().sum();
  const double error = std::max(0.0, total - subjects - raters);
  return {n,
          k,
          subjects / (n - 1),
          raters / (k - 1),
          error / ((n - 1) * (k - 1)),
          (raters + error) / (n * (k - 1))};
}

double quantileOfF(double q, double d1, double d2) {
  return boost::math::quantile(boost::math::fisher_f(d1, d2), q);
}

/// F bounds of mean square `over` under `subjects`.
struct Bounds {
  double low, high;
};
Bounds boundsOf(double over, double under, double d1, double d2) {
  const double f = under > 0 ? over / under : std::numeric_limits<double>::infinity();
  return {f / quantileOfF(0.975, d1, d2), f * quantileOfF(0.975, d2, d1)};
}

double fromF(double f, double k) { return std::isinf(f) ? 1 : (f - 1) / (f + k - 1); }
double fromFOfMean(double f) {
  return std::isinf(f) ? 1 : f > 0 ? 1 - 1 / f : -std::numeric_limits<double>::infinity();
}

/// Spearman and Brown: reliability of the mean of k.
double ofMean(double icc, double k) { return k * icc / (1 + (k - 1) * icc); }

Icc agreementOf(const MeanSquares& m) {
  const double icc = (m.subjects - m.error) /
                     (m.subjects + (m.k - 1) * m.error + m.k * (m.raters - m.error) / m.n);
  if (!(m.error > 0)) return {icc, icc, icc};
  const double fj = m.raters / m.error,
               base = m.k * icc * fj + m.n * (1 + (m.k - 1) * icc) - m.k * icc;
  const double degrees = (m.k - 1) * (m.n - 1) * base * base /
                         ((m.n - 1) * m.k * m.k * icc * icc * fj * fj +
                          std::pow(m.n * (1 + (m.k - 1) * icc) - m.k * icc, 2));
  const double upper = quantileOfF(0.975, m.n - 1, degrees),
               lower = quantileOfF(0.975, degrees, m.n - 1);
  const double rest = m.k * m.raters + (m.k * m.n - m.k - m.n) * m.error;
  return {icc, m.n * (m.subjects - upper * m.error) / (upper * rest + m.n * m.subjects),
          m.n * (lower * m.subjects - m.error) / (rest + m.n * lower * m.subjects)};
}

}  // namespace

RaterAgreement raterAgreement(const Eigen::MatrixXd& ratings) {
  if (ratings.rows() < 2 || ratings.cols() < 2)
    throw Error("needs two subjects and two raters", kRaters, "Let another rater fill in the form");
  if (!ratings.allFinite())
    throw Error("a rating is missing", kRaters, "Leave out subjects that not every rater saw");
  const MeanSquares m = meanSquaresOf(ratings);
  if (!(m.subjects > 0))
    throw Error("all subjects have the same mean rating", kRaters, "Rate subjects that differ");

  const Bounds one = boundsOf(m.subjects, m.within, m.n - 1, m.n * (m.k - 1)),
               three = boundsOf(m.subjects, m.error, m.n - 1, (m.n - 1) * (m.k - 1));
  const double f1 = m.within > 0 ? m.subjects / m.within : std::numeric_limits<double>::infinity();
  const double f3 = m.error > 0 ? m.subjects / m.error : std::numeric_limits<double>::infinity();
  RaterAgreement a;
  a.one_way = {fromF(f1, m.k), fromF(one.low, m.k), fromF(one.high, m.k)};
  a.consistency = {fromF(f3, m.k), fromF(three.low, m.k), fromF(three.high, m.k)};
  a.agreement = agreementOf(m);
  a.one_way_mean = {fromFOfMean(f1), fromFOfMean(one.low), fromFOfMean(one.high)};
  a.consistency_mean = {fromFOfMean(f3), fromFOfMean(three.low), fromFOfMean(three.high)};
  a.agreement_mean = {ofMean(a.agreement.value, m.k), ofMean(a.agreement.low, m.k),
                      ofMean(a.agreement.high, m.k)};
  return a;
}

double kappa(const std::vector<int>& one, const std::vector<int>& other, int categories,
             KappaWeights weights) {
  if (one.empty() || one.size() != other.size())
    throw Error("needs the same number of ratings from both raters", kRaters,
                "Leave out what only one has rated");
  Eigen::MatrixXd seen = Eigen::MatrixXd::Zero(categories, categories);
  for (std::size_t i = 0; i < one.size(); ++i) {
    if (std::min(one[i], other[i]) < 0 || std::max(one[i], other[i]) >= categories)
      throw Error("a rating is not one of the " + std::to_string(categories) + " categories",
                  kRaters, "Check the form");
    seen(one[i], other[i]) += 1 / static_cast<double>(one.size());
  }
  double observed = 0, expected = 0;
  for (int i = 0; i < categories; ++i)
    for (int j = 0; j < categories; ++j) {
      const double d = std::abs(i - j), w = weights == KappaWeights::none     ? (i != j ? 1.0 : 0.0)
                                            : weights == KappaWeights::linear ? d
                                                                              : d * d;
      observed += w * seen(i, j);
      expected += w * seen.row(i).sum() * seen.col(j).sum();
    }
  return expected > 0 ? 1 - observed / expected : std::numeric_limits<double>::quiet_NaN();
}

}  // namespace palpa::statistics
