#include "apps/assess/welch.h"

#include <boost/math/distributions/students_t.hpp>
#include <cmath>
#include <numeric>

#include "anatomy/geometry/error.h"

namespace palpa::assess {
namespace {

struct Moments {
  double mean, sd, n;
};

Moments momentsOf(const std::vector<double>& values) {
  const double n = static_cast<double>(values.size());
  if (values.size() < 2) throw Error("needs at least two values", "Welch's test", "Collect more trials");
  const double mean = std::accumulate(values.begin(), values.end(), 0.0) / n;
  double squares = 0;
  for (const double v : values) squares += (v - mean) * (v - mean);
  return {mean, std::sqrt(squares / (n - 1)), n};
}

}  // namespace

WelchTest welchFromMoments(double mean_a, double sd_a, double n_a, double mean_b, double sd_b, double n_b) {
  const double va = sd_a * sd_a / n_a, vb = sd_b * sd_b / n_b;
  if (!(va + vb > 0)) throw Error("both samples are constant", "Welch's test", "Nothing can be tested");
  WelchTest test;
  test.mean_a = mean_a;
  test.mean_b = mean_b;
  test.t = (mean_a - mean_b) / std::sqrt(va + vb);
  test.degrees = (va + vb) * (va + vb) / (va * va / (n_a - 1) + vb * vb / (n_b - 1));
  const boost::math::students_t distribution(test.degrees);
  test.p_less = boost::math::cdf(distribution, test.t);
  test.p_two_sided = 2 * boost::math::cdf(distribution, -std::abs(test.t));
  return test;
}

WelchTest welch(const std::vector<double>& a, const std::vector<double>& b) {
  const Moments ma = momentsOf(a), mb = momentsOf(b);
  return welchFromMoments(ma.mean, ma.sd, ma.n, mb.mean, mb.sd, mb.n);
}

}  // namespace palpa::assess
