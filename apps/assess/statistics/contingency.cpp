#include "apps/assess/statistics/contingency.h"

#include <algorithm>
#include <boost/math/distributions/chi_squared.hpp>
#include <boost/math/distributions/hypergeometric.hpp>
#include <cmath>

#include "anatomy/geometry/error.h"

namespace palpa::statistics {
namespace {

constexpr double kAsLikely = 1 + 1e-7;  // probabilities of equally likely tables differ by rounding

void requireCounts(const std::vector<int>& counts, const char* where) {
  for (const int c : counts)
    if (c < 0) throw Error("a count is negative", where, "Check the table");
}

std::vector<std::vector<int>> withoutEmpty(const std::vector<std::vector<int>>& table) {
  std::vector<std::vector<int>> kept;
  for (const std::vector<int>& row : table)
    if (std::any_of(row.begin(), row.end(), [](int c) { return c > 0; })) kept.push_back(row);
  return kept;
}

std::vector<std::vector<int>> transposed(const std::vector<std::vector<int>>& table) {
  std::vector<std::vector<int>> turned(table.empty() ? 0 : table[0].size());
  for (const std::vector<int>& row : table)
    for (std::size_t c = 0; c < row.size(); ++c) turned[c].push_back(row[c]);
  return turned;
}

double sumOf(const std::vector<int>& counts) {
  double sum = 0;
  for (const int c : counts) sum += c;
  return sum;
}

}  // namespace

FisherTest fisherExact(int a, int b, int c, int d) {
  requireCounts({a, b, c, d}, "Fisher's exact test");
  if (a + b + c + d == 0)
    throw Error("the table is empty", "Fisher's exact test", "Collect more trials");
  const auto row = static_cast<unsigned>(a + b), column = static_cast<unsigned>(a + c),
             all = static_cast<unsigned>(a + b + c + d);
  const boost::math::hypergeometric_distribution<> tables(row, column, all);
  const double here = boost::math::pdf(tables, static_cast<unsigned>(a));
  const auto [first, last] = boost::math::support(tables);
  FisherTest test{0, 0, 0, static_cast<double>(a) * d / (static_cast<double>(b) * c)};
  for (unsigned k = static_cast<unsigned>(first); k <= static_cast<unsigned>(last); ++k) {
    const double p = boost::math::pdf(tables, k);
    if (k <= static_cast<unsigned>(a)) test.p_less += p;
    if (k >= static_cast<unsigned>(a)) test.p_greater += p;
    if (p <= here * kAsLikely) test.p_two_sided += p;
  }
  for (double* p : {&test.p_less, &test.p_greater, &test.p_two_sided}) *p = std::min(1.0, *p);
  return test;
}

ChiSquareTest chiSquare(const std::vector<std::vector<int>>& table) {
  constexpr char kWhere[] = "chi-square test";
  for (const std::vector<int>& row : table) {
    requireCounts(row, kWhere);
    if (row.size() != table[0].size())
      throw Error("rows are of unlike length", kWhere, "Check the table");
  }
  const std::vector<std::vector<int>> columns = withoutEmpty(transposed(withoutEmpty(table))),
                                      rows = transposed(columns);
  if (rows.size() < 2 || columns.size() < 2)
    throw Error("needs two rows and two columns that hold something", kWhere,
                "Collect more trials");

  double all = 0;
  for (const std::vector<int>& row : rows) all += sumOf(row);
  ChiSquareTest test;
  test.smallest_expected = all;
  for (std::size_t r = 0; r < rows.size(); ++r)
    for (std::size_t c = 0; c < columns.size(); ++c) {
      const double expected = sumOf(rows[r]) * sumOf(columns[c]) / all, off = rows[r][c] - expected;
      test.chi_square += off * off / expected;
      test.smallest_expected = std::min(test.smallest_expected, expected);
    }
  const double smaller = static_cast<double>(std::min(rows.size(), columns.size())) - 1;
  test.degrees = static_cast<double>((rows.size() - 1) * (columns.size() - 1));
  test.p = boost::math::cdf(
      boost::math::complement(boost::math::chi_squared(test.degrees), test.chi_square));
  test.cramers_v = std::sqrt(test.chi_square / (all * smaller));
  return test;
}

}  // namespace palpa::statistics
