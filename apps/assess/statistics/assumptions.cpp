#include "apps/assess/statistics/assumptions.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <numbers>
#include <numeric>

#include <boost/math/distributions/normal.hpp>

#include "anatomy/base/error.h"
#include "apps/assess/statistics/sample.h"
#include "apps/assess/statistics/tests_of_means.h"

namespace palpa::statistics {
namespace {

constexpr std::size_t kFew = 5;
constexpr double kLevel = 0.05;

double normalQuantile(double q) { return boost::math::quantile(boost::math::normal(), q); }
double normalAbove(double z) {
  return boost::math::cdf(boost::math::complement(boost::math::normal(), z));
}

/// c[0] + c[1] x + c[2] x^2 + ...
double polynomial(std::initializer_list<double> c, double x) {
  double sum = 0, power = 1;
  for (const double coefficient : c) {
    sum += coefficient * power;
    power *= x;
  }
  return sum;
}

/// Royston's weights of the ordered values, largest first; the smallest have the same with the
/// other sign.
std::vector<double> weightsOf(std::size_t n) {
  if (n == 3) return {std::sqrt(0.5)};
  std::vector<double> scores(n / 2);  // expected normal order statistics, Blom 1958
  for (std::size_t i = 0; i < scores.size(); ++i)
    scores[i] =
        -normalQuantile((static_cast<double>(i) + 1 - 0.375) / (static_cast<double>(n) + 0.25));
  double squares = 0;
  for (const double s : scores) squares += 2 * s * s;
  const double size = std::sqrt(squares), x = 1 / std::sqrt(static_cast<double>(n));
  std::vector<double> weights = scores;
  weights[0] =
      polynomial({0, 0.221157, -0.147981, -2.07119, 4.434685, -2.706056}, x) + scores[0] / size;
  double rest = squares - 2 * scores[0] * scores[0], left = 1 - 2 * weights[0] * weights[0];
  std::size_t from = 1;
  if (n > 5) {
    weights[1] =
        polynomial({0, 0.042981, -0.293762, -1.752461, 5.682633, -3.582633}, x) + scores[1] / size;
    rest -= 2 * scores[1] * scores[1];
    left -= 2 * weights[1] * weights[1];
    from = 2;
  }
  for (std::size_t i = from; i < weights.size(); ++i)
    weights[i] = scores[i] / std::sqrt(rest / left);
  return weights;
}

double royston(double w, std::size_t count) {
  const double n = static_cast<double>(count);
  if (count == 3)
    return std::clamp(6 / std::numbers::pi * (std::asin(std::sqrt(w)) - std::asin(std::sqrt(0.75))),
                      0.0, 1.0);
  const double y = std::log(1 - w), log_n = std::log(n);
  if (count <= 11) {
    const double g = polynomial({-2.273, 0.459}, n);
    if (y >= g) return 0;
    return normalAbove((-std::log(g - y) - polynomial({0.544, -0.39978, 0.025054, -6.714e-4}, n)) /
                       std::exp(polynomial({1.3822, -0.77857, 0.062767, -0.0020322}, n)));
  }
  return normalAbove((y - polynomial({-1.5861, -0.31082, -0.083751, 0.0038915}, log_n)) /
                     std::exp(polynomial({-0.4803, -0.082676, 0.0030302}, log_n)));
}

std::string threeDigits(double p) {
  char text[16];
  std::snprintf(text, sizeof text, "%.3f", p);
  return text;
}

bool varies(const std::vector<double>& values) {
  return !values.empty() && *std::min_element(values.begin(), values.end()) <
                                *std::max_element(values.begin(), values.end());
}

}  // namespace

NormalityTest shapiroWilk(const std::vector<double>& values) {
  if (values.size() < 3 || values.size() > 5000)
    throw Error("needs 3 to 5000 values", "Shapiro-Wilk test", "Collect more trials");
  const Moments moments = momentsOf(values, "Shapiro-Wilk test");
  if (!varies(values))
    throw Error("nothing varies in the values", "Shapiro-Wilk test",
                "Constant values cannot be tested");
  std::vector<double> sorted = values;
  std::sort(sorted.begin(), sorted.end());
  const std::vector<double> weights = weightsOf(values.size());
  double slope = 0;
  for (std::size_t i = 0; i < weights.size(); ++i)
    slope += weights[i] * (sorted[sorted.size() - 1 - i] - sorted[i]);
  const double w = std::min(1.0, slope * slope / (moments.sd * moments.sd * (moments.n - 1)));
  return {w, w < 1 ? royston(w, values.size()) : 1};
}

double spreadDiffers(const std::vector<std::vector<double>>& groups) {
  std::vector<std::vector<double>> distances = groups;
  for (std::vector<double>& group : distances) {
    const double median = interpolatedQuantile(group, 0.5);
    for (double& v : group) v = std::abs(v - median);
  }
  return oneWayAnova(distances).p;
}

std::vector<std::string> concernsAbout(const std::vector<std::vector<double>>& groups,
                                       const std::vector<std::string>& names) {
  std::vector<std::string> concerns;
  bool testable = groups.size() >= 2;
  for (std::size_t g = 0; g < groups.size(); ++g) {
    if (groups[g].size() < kFew)
      concerns.push_back(names[g] + ": only " + std::to_string(groups[g].size()) +
                         " values; a test cannot say much.");
    if (!varies(groups[g])) {
      concerns.push_back(names[g] + ": nothing varies.");
      testable = false;
    }
    testable = testable && groups[g].size() >= 3;
    if (groups[g].size() < 3 || groups[g].size() > 5000 || !varies(groups[g])) continue;
    const double p = shapiroWilk(groups[g]).p;
    if (p < kLevel)
      concerns.push_back(names[g] + ": the values are not spread like a bell (Shapiro-Wilk p = " +
                         threeDigits(p) + "); the tests on ranks are safer.");
  }
  if (testable) try {
      const double p = spreadDiffers(groups);
      if (p < kLevel)
        concerns.push_back("The groups spread differently (Brown-Forsythe p = " + threeDigits(p) +
                           "); Welch's test allows for it, the pooled one does not.");
    } catch (
        const Error&) {  // all values of every group as far from its median: no spread to compare
    }
  return concerns;
}

std::vector<double> holm(const std::vector<double>& p_values) {
  for (const double p : p_values)
    if (!(p >= 0 && p <= 1))
      throw Error("a p-value is not between 0 and 1", "Holm's correction", "Check the figures");
  std::vector<std::size_t> order(p_values.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(),
                   [&](std::size_t a, std::size_t b) { return p_values[a] < p_values[b]; });
  std::vector<double> adjusted(p_values.size());
  double before = 0;
  for (std::size_t i = 0; i < order.size(); ++i) {
    before =
        std::max(before, std::min(1.0, p_values[order[i]] * static_cast<double>(order.size() - i)));
    adjusted[order[i]] = before;
  }
  return adjusted;
}

}  // namespace palpa::statistics
