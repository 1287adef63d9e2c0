#include "apps/assess/statistics/tests_of_means.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include <boost/math/distributions/fisher_f.hpp>
#include <boost/math/distributions/students_t.hpp>

#include "anatomy/base/error.h"
#include "apps/assess/statistics/sample.h"

namespace palpa::statistics {
namespace {

constexpr char kTTest[] = "t-test";

/// `size`: of the values; what rounding alone may leave of it is no variance.
void requireVariance(double variance, double size) {
  constexpr double kDigits = 8 * std::numeric_limits<double>::epsilon();
  if (!(variance > kDigits * kDigits * size * size))
    throw Error("nothing varies in the values", kTTest, "Constant values cannot be tested");
}

/// `sd`: of the values, for the effect; `error`: of the difference.
TTest testOf(double mean_a, double mean_b, double sd, double error, double degrees) {
  const boost::math::students_t distribution(degrees);
  TTest test;
  test.mean_a = mean_a;
  test.mean_b = mean_b;
  test.difference = mean_a - mean_b;
  test.t = test.difference / error;
  test.degrees = degrees;
  test.p_less = boost::math::cdf(distribution, test.t);
  test.p_greater = boost::math::cdf(boost::math::complement(distribution, test.t));
  test.p_two_sided = 2 * boost::math::cdf(distribution, -std::abs(test.t));
  const double half = error * boost::math::quantile(distribution, 0.975);
  test.low = test.difference - half;
  test.high = test.difference + half;
  test.effect = test.difference / sd * (1 - 3 / (4 * degrees - 1));
  return test;
}

double pooledVariance(const Moments& a, const Moments& b) {
  return ((a.n - 1) * a.sd * a.sd + (b.n - 1) * b.sd * b.sd) / (a.n + b.n - 2);
}

void require(const Moments& a, const Moments& b) {
  if (!(a.n >= 2 && b.n >= 2))
    throw Error("there are fewer than two values", kTTest, "Collect more trials");
  requireVariance(a.sd * a.sd + b.sd * b.sd, std::max(std::abs(a.mean), std::abs(b.mean)));
}

}  // namespace

TTest welchFromMoments(const Moments& a, const Moments& b) {
  require(a, b);
  const double va = a.sd * a.sd / a.n, vb = b.sd * b.sd / b.n;
  const double degrees = (va + vb) * (va + vb) / (va * va / (a.n - 1) + vb * vb / (b.n - 1));
  TTest test = testOf(a.mean, b.mean, std::sqrt(pooledVariance(a, b)), std::sqrt(va + vb), degrees);
  test.effect = pooledFromMoments(a, b).effect;
  return test;
}

TTest pooledFromMoments(const Moments& a, const Moments& b) {
  require(a, b);
  const double sd = std::sqrt(pooledVariance(a, b));
  return testOf(a.mean, b.mean, sd, sd * std::sqrt(1 / a.n + 1 / b.n), a.n + b.n - 2);
}

namespace {

std::vector<double> differencesOf(const std::vector<double>& a, const std::vector<double>& b) {
  if (a.size() != b.size())
    throw Error("the samples are not pairs", kTTest,
                "Leave out subjects who lack one of the two values");
  std::vector<double> differences(a.size());
  for (std::size_t i = 0; i < a.size(); ++i) differences[i] = a[i] - b[i];
  return differences;
}

}  // namespace

Equivalence equivalenceOfPairs(const std::vector<double>& a, const std::vector<double>& b,
                               double margin) {
  if (!(margin > 0))
    throw Error("the margin must be positive", kTTest, "Say how large a difference matters");
  const Moments d = momentsOf(differencesOf(a, b), kTTest);
  Equivalence result{.difference = d.mean, .sd = d.sd, .low = d.mean, .high = d.mean};
  const double error = d.sd / std::sqrt(d.n), nearest = margin - std::abs(d.mean);
  if (!(error > 0)) {
    result.p = nearest > 0 ? 0 : 1;
    return result;
  }
  const boost::math::students_t distribution(d.n - 1);
  const double half = error * boost::math::quantile(distribution, 0.95);
  result.low -= half;
  result.high += half;
  result.p = boost::math::cdf(distribution, -nearest / error);
  return result;
}

TTest paired(const std::vector<double>& a, const std::vector<double>& b) {
  const Moments d = momentsOf(differencesOf(a, b), kTTest);
  requireVariance(d.sd * d.sd, std::max(std::abs(meanOf(a)), std::abs(meanOf(b))));
  return testOf(meanOf(a), meanOf(b), d.sd, d.sd / std::sqrt(d.n), d.n - 1);
}

TTest welch(const std::vector<double>& a, const std::vector<double>& b) {
  return welchFromMoments(momentsOf(a, kTTest), momentsOf(b, kTTest));
}
TTest pooled(const std::vector<double>& a, const std::vector<double>& b) {
  return pooledFromMoments(momentsOf(a, kTTest), momentsOf(b, kTTest));
}

namespace {

constexpr char kAnova[] = "analysis of variance";

/// Squares that rounding alone may leave within groups of equal values.
double roundingOf(const std::vector<double>& values) {
  double squares = 0;
  for (const double v : values) squares += v * v;
  constexpr double kDigits = 8 * std::numeric_limits<double>::epsilon();
  return kDigits * kDigits * squares;
}

}  // namespace

double fTail(double f, double d1, double d2) {
  if (!(d1 > 0 && d2 > 0 && f >= 0))
    throw Error("F and its degrees of freedom must be positive", kAnova, "Check the figures");
  return boost::math::cdf(boost::math::complement(boost::math::fisher_f(d1, d2), f));
}

Anova oneWayAnova(const std::vector<std::vector<double>>& groups) {
  std::vector<double> all, means;
  for (const std::vector<double>& group : groups) {
    if (group.empty())
      throw Error("a group has no values", kAnova, "Leave it out or collect trials");
    all.insert(all.end(), group.begin(), group.end());
    means.push_back(describe(group).mean);
  }
  if (groups.size() < 2 || all.size() <= groups.size())
    throw Error("needs two groups and more values than groups", kAnova, "Collect more trials");

  Anova anova;
  const double grand = meanOf(all);
  for (std::size_t g = 0; g < groups.size(); ++g) {
    anova.squares_between +=
        static_cast<double>(groups[g].size()) * (means[g] - grand) * (means[g] - grand);
    for (const double v : groups[g]) anova.squares_within += (v - means[g]) * (v - means[g]);
  }
  if (!(anova.squares_within > roundingOf(all)))
    throw Error("nothing varies within the groups", kAnova, "Constant values cannot be tested");
  anova.degrees_between = static_cast<double>(groups.size()) - 1;
  anova.degrees_within = static_cast<double>(all.size() - groups.size());
  const double within = anova.squares_within / anova.degrees_within,
               total = anova.squares_between + anova.squares_within;
  anova.f = anova.squares_between / anova.degrees_between / within;
  anova.p = fTail(anova.f, anova.degrees_between, anova.degrees_within);
  anova.eta_squared = anova.squares_between / total;
  anova.omega_squared = (anova.squares_between - anova.degrees_between * within) / (total + within);
  return anova;
}

}  // namespace palpa::statistics
