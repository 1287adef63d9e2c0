#include "apps/assess/statistics/rank_tests.h"

#include <algorithm>
#include <boost/math/distributions/normal.hpp>
#include <cmath>

#include "anatomy/geometry/error.h"
#include "apps/assess/statistics/sample.h"

namespace palpa::statistics {
namespace {

constexpr std::size_t kExactBelow = 50;

/// Share of all choices of `chosen` among 1 .. n whose sum is s, for each s: how U is distributed
/// when nothing differs.
std::vector<double> sumsOfChoices(std::size_t n, std::size_t chosen) {
  const std::size_t most = n * (n + 1) / 2;
  std::vector<std::vector<double>> ways(chosen + 1, std::vector<double>(most + 1, 0));
  ways[0][0] = 1;
  for (std::size_t rank = 1; rank <= n; ++rank)
    for (std::size_t k = std::min(rank, chosen); k >= 1; --k)
      for (std::size_t s = most; s >= rank; --s) ways[k][s] += ways[k - 1][s - rank];
  return ways[chosen];
}

/// Share of all sets of signs of 1 .. n whose positive ranks sum to s, for each s.
std::vector<double> sumsOfSigns(std::size_t n) {
  std::vector<double> ways(n * (n + 1) / 2 + 1, 0);
  ways[0] = 1;
  for (std::size_t rank = 1; rank <= n; ++rank)
    for (std::size_t s = ways.size() - 1; s >= rank; --s) ways[s] += ways[s - rank];
  return ways;
}

void fillExact(RankTest& test, const std::vector<double>& ways, std::size_t sum) {
  double below = 0, at = ways[sum], all = 0;
  for (std::size_t s = 0; s < ways.size(); ++s) {
    all += ways[s];
    if (s < sum) below += ways[s];
  }
  test.exact = true;
  test.p_less = (below + at) / all;
  test.p_greater = (all - below) / all;
  test.p_two_sided = std::min(1.0, 2 * std::min(test.p_less, test.p_greater));
}

void fillNormal(RankTest& test, double from_mean, double sd) {
  const boost::math::normal normal;
  const auto below = [&](double z) { return boost::math::cdf(normal, z); };
  if (!(sd > 0)) throw Error("all values are equal", "rank test", "Equal values cannot be tested");
  test.p_less = below((from_mean + 0.5) / sd);
  test.p_greater = below(-(from_mean - 0.5) / sd);
  test.p_two_sided = std::min(1.0, 2 * std::min(test.p_less, test.p_greater));
}

}  // namespace

RankTest mannWhitney(const std::vector<double>& a, const std::vector<double>& b) {
  if (a.empty() || b.empty())
    throw Error("a sample has no values", "Mann-Whitney test", "Collect more trials");
  std::vector<double> all = a;
  all.insert(all.end(), b.begin(), b.end());
  const Ranks ranks = ranksOf(all);
  const double na = static_cast<double>(a.size()), nb = static_cast<double>(b.size()), n = na + nb;
  double sum = 0;
  for (std::size_t i = 0; i < a.size(); ++i) sum += ranks.of[i];
  RankTest test;
  test.statistic = sum - na * (na + 1) / 2;
  test.effect = 2 * test.statistic / (na * nb) - 1;
  if (ranks.ties == 0 && a.size() < kExactBelow && b.size() < kExactBelow)
    fillExact(test, sumsOfChoices(all.size(), a.size()),
              static_cast<std::size_t>(std::lround(sum)));
  else
    fillNormal(test, test.statistic - na * nb / 2,
               std::sqrt(na * nb / 12 * (n + 1 - ranks.ties / (n * (n - 1)))));
  return test;
}

RankTest wilcoxon(const std::vector<double>& a, const std::vector<double>& b) {
  if (a.size() != b.size())
    throw Error("the samples are not pairs", "Wilcoxon test",
                "Leave out whoever lacks one of the two values");
  std::vector<double> differences, sizes;
  for (std::size_t i = 0; i < a.size(); ++i)
    if (a[i] != b[i]) differences.push_back(a[i] - b[i]);
  if (differences.empty())
    throw Error("no pair differs", "Wilcoxon test", "Equal values cannot be tested");
  for (const double d : differences) sizes.push_back(std::abs(d));
  const Ranks ranks = ranksOf(sizes);
  const double n = static_cast<double>(sizes.size()), most = n * (n + 1) / 2;
  RankTest test;
  for (std::size_t i = 0; i < sizes.size(); ++i)
    if (differences[i] > 0) test.statistic += ranks.of[i];
  test.effect = 2 * test.statistic / most - 1;
  const bool none_left_out = sizes.size() == a.size();
  if (ranks.ties == 0 && none_left_out && sizes.size() < kExactBelow)
    fillExact(test, sumsOfSigns(sizes.size()),
              static_cast<std::size_t>(std::lround(test.statistic)));
  else
    fillNormal(test, test.statistic - most / 2,
               std::sqrt(n * (n + 1) * (2 * n + 1) / 24 - ranks.ties / 48));
  return test;
}

}  // namespace palpa::statistics
