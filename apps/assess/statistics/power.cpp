#include "apps/assess/statistics/power.h"

#include <algorithm>
#include <boost/math/distributions/non_central_t.hpp>
#include <boost/math/distributions/normal.hpp>
#include <boost/math/distributions/students_t.hpp>
#include <cmath>

#include "anatomy/base/error.h"

namespace palpa::statistics {
namespace {

constexpr char kPlanning[] = "planning of a study";
constexpr int kMostSubjects = 1000000;

void requireLevel(double level) {
  if (!(level > 0 && level < 1))
    throw Error("the level must be between 0 and 1", kPlanning, "0.05 is usual");
}

double powerOf(double shift, double degrees, double level, Tails tails) {
  const double beyond = tails == Tails::two ? level / 2 : level;
  const double critical =
      boost::math::quantile(boost::math::complement(boost::math::students_t(degrees), beyond));
  const boost::math::non_central_t distribution(degrees, std::abs(shift));
  const double found = boost::math::cdf(boost::math::complement(distribution, critical));
  return tails == Tails::two ? found + boost::math::cdf(distribution, -critical) : found;
}

void requirePower(double effect, double power, double level) {
  requireLevel(level);
  if (!(std::abs(effect) > 0))
    throw Error("without an effect no number of subjects is enough", kPlanning,
                "Say how large a difference matters");
  if (!(power > level && power < 1))
    throw Error("the power must lie between the level and 1", kPlanning, "0.8 or 0.9 is usual");
}

}  // namespace

double powerOfTwoGroups(double effect, double n_a, double n_b, double level, Tails tails) {
  requireLevel(level);
  if (!(n_a >= 2 && n_b >= 2)) throw Error("each group needs two subjects", kPlanning, "Plan more");
  return powerOf(effect / std::sqrt(1 / n_a + 1 / n_b), n_a + n_b - 2, level, tails);
}

double powerOfPairs(double effect, double n, double level, Tails tails) {
  requireLevel(level);
  if (!(n >= 2)) throw Error("two pairs are needed", kPlanning, "Plan more");
  return powerOf(effect * std::sqrt(n), n - 1, level, tails);
}

double powerOfEquivalence(double margin, double n, double level) {
  requireLevel(level);
  if (!(n >= 2)) throw Error("two pairs are needed", kPlanning, "Plan more");
  const double one = powerOf(margin * std::sqrt(n), n - 1, level, Tails::one);
  return std::max(2 * one - 1, 0.0);
}

namespace {

/// Fewest for which `enough(n)`.
template <class Enough>
int fewest(const Enough& enough) {
  int few = 1, many = 2;  // not enough, and a guess
  while (!enough(many)) {
    few = many;
    many *= 2;
    if (many > kMostSubjects)
      throw Error("more than a million subjects would be needed", kPlanning,
                  "Such an effect cannot be shown");
  }
  while (many - few > 1) {
    const int middle = few + (many - few) / 2;
    (enough(middle) ? many : few) = middle;
  }
  return many;
}

}  // namespace

int pairsForEquivalence(double margin, double power, double level) {
  requirePower(margin, power, level);
  if (!(margin > 0))
    throw Error("the margin must be positive", kPlanning, "Say how large a difference matters");
  return fewest([&](int n) { return powerOfEquivalence(margin, n, level) >= power; });
}

int subjectsPerGroup(double effect, double power, double level, Tails tails) {
  requirePower(effect, power, level);
  return fewest([&](int n) { return powerOfTwoGroups(effect, n, n, level, tails) >= power; });
}

int subjectsPerGroupForRates(double rate_a, double rate_b, double power, double level,
                             Tails tails) {
  if (!(rate_a >= 0 && rate_a <= 1 && rate_b >= 0 && rate_b <= 1))
    throw Error("a rate must be between 0 and 1", kPlanning, "0.8 is 80 %");
  const double h = 2 * std::asin(std::sqrt(rate_a)) - 2 * std::asin(std::sqrt(rate_b));
  requirePower(h, power, level);
  const boost::math::normal normal;
  const double z = boost::math::quantile(normal, power) +
                   boost::math::quantile(normal, 1 - (tails == Tails::two ? level / 2 : level));
  const double n = std::ceil(2 * z * z / (h * h));
  if (n > kMostSubjects)
    throw Error("more than a million subjects would be needed", kPlanning,
                "Such an effect cannot be shown");
  return static_cast<int>(n);
}

}  // namespace palpa::statistics
