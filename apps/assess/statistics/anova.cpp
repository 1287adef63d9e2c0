#include "apps/assess/statistics/anova.h"

#include <boost/math/distributions/fisher_f.hpp>
#include <limits>

#include "anatomy/geometry/error.h"
#include "apps/assess/statistics/sample.h"

namespace palpa::statistics {
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
