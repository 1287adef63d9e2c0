#include "calibration/parts/agreement.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "anatomy/base/random.h"
#include "tests/support/complaint.h"

namespace palpa::calibration {
namespace {

using palpa::test::complaint;
using palpa::test::says;
using Labels = std::vector<int>;

double kappaOf(const Labels& a, const Labels& b) { return cohensKappa(contingencyOf(a, b)); }
double randIndexOf(const Labels& a, const Labels& b) {
  return adjustedRandIndex(contingencyOf(a, b));
}

/// Two labelings whose contingency is that table.
std::pair<Labels, Labels> labelsOf(const std::vector<std::vector<int>>& table) {
  std::pair<Labels, Labels> both;
  for (std::size_t i = 0; i < table.size(); ++i)
    for (std::size_t j = 0; j < table[i].size(); ++j) {
      both.first.insert(both.first.end(), static_cast<std::size_t>(table[i][j]),
                        static_cast<int>(i));
      both.second.insert(both.second.end(), static_cast<std::size_t>(table[i][j]),
                         static_cast<int>(j));
    }
  return both;
}

Labels randomLabels(int labels, std::size_t steps, std::uint64_t seed) {
  RandomStream random = RandomStream::ofSeed(seed);
  Labels all(steps);
  for (int& one : all) one = static_cast<int>(random.openUniform() * labels);
  return all;
}

TEST(Agreement, CountsHowLabelsMeet) {
  const Contingency table = contingencyOf({5, 5, -2, 5, 9}, {1, 1, 0, 0, 1});
  EXPECT_EQ(table.one, (Labels{-2, 5, 9}));
  EXPECT_EQ(table.other, (Labels{0, 1}));
  Eigen::MatrixXi expected(3, 2);
  expected << 1, 0, 1, 2, 0, 1;
  EXPECT_EQ(table.counts, expected);
}

TEST(Agreement, OfTablesCountedByHand) {
  // Two raters, 50 cases: p_o = 35/50, p_e = (25 * 30 + 25 * 20) / 2500 = 0.5.
  const auto [a, b] = labelsOf({{20, 5}, {10, 15}});
  EXPECT_NEAR(kappaOf(a, b), 0.4, 1e-12);
  // Of pairs: 190 + 10 + 45 + 105 = 350; 300 + 300 of rows; 435 + 190 of columns; 1225 of all.
  const double by_chance = 600.0 * 625 / 1225;
  EXPECT_NEAR(randIndexOf(a, b), (350 - by_chance) / (612.5 - by_chance), 1e-12);
  // A textbook's six: {1,1,1,2,2,2} beside {1,1,2,2,3,3}: 2 pairs together, 6 and 3, 15 of all: E
  // = 1.2.
  EXPECT_NEAR(randIndexOf({1, 1, 1, 2, 2, 2}, {1, 1, 2, 2, 3, 3}), (2 - 1.2) / (4.5 - 1.2), 1e-12);
  // There labels 1 and 3 have partners: p_o = 4/6, p_e = 2 * (3 * 2) / 36 = 1/3.
  EXPECT_NEAR(kappaOf({1, 1, 1, 2, 2, 2}, {1, 1, 2, 2, 3, 3}), 0.5, 1e-12);
  // Worse than chance: pairs that are together here are apart there. E = 2 * 2 / 6.
  EXPECT_NEAR(randIndexOf({0, 0, 1, 1}, {0, 1, 0, 1}), -0.5, 1e-12);
}

TEST(Agreement, TheMatchingIsTheBestOfAll) {
  for (const std::uint64_t seed : {1u, 2u, 3u, 4u, 5u, 6u, 7u, 8u}) {
    const int rows = 2 + static_cast<int>(seed % 4), columns = 5;
    const Contingency table =
        contingencyOf(randomLabels(rows, 60, seed), randomLabels(columns, 60, seed + 100));
    const Labels matching = bestMatching(table);
    std::vector<bool> taken(static_cast<std::size_t>(columns), false);
    int met = 0, most = 0;
    for (std::size_t i = 0; i < matching.size(); ++i) {
      ASSERT_GE(matching[i], 0);
      ASSERT_FALSE(taken[static_cast<std::size_t>(matching[i])]);
      taken[static_cast<std::size_t>(matching[i])] = true;
      met += table.counts(static_cast<Eigen::Index>(i), matching[i]);
    }
    Labels order(static_cast<std::size_t>(columns));
    std::iota(order.begin(), order.end(), 0);
    do {
      int sum = 0;
      for (std::size_t i = 0; i < matching.size(); ++i)
        sum += table.counts(static_cast<Eigen::Index>(i), order[i]);
      most = std::max(most, sum);
    } while (std::next_permutation(order.begin(), order.end()));
    EXPECT_EQ(met, most) << seed;
    const Contingency other_way =
        contingencyOf(randomLabels(columns, 60, seed + 100),
                      randomLabels(rows, 60, seed));  // more rows than columns
    const Labels other_matching = bestMatching(other_way);
    EXPECT_EQ(std::count(other_matching.begin(), other_matching.end(), -1), columns - rows);
    EXPECT_NEAR(cohensKappa(other_way), cohensKappa(table), 1e-12);
    EXPECT_NEAR(adjustedRandIndex(other_way), adjustedRandIndex(table), 1e-12);
  }
}

TEST(Agreement, NamesDoNotMatter) {
  const Labels a = randomLabels(4, 500, 1);
  Labels b = a, renamed(a.size());
  for (std::size_t i = 0; i < a.size(); i += 7) b[i] = (b[i] + 1) % 4;
  std::transform(b.begin(), b.end(), renamed.begin(), [](int label) {
    return std::vector<int>{30, -4, 12, 7}[static_cast<std::size_t>(label)];
  });
  EXPECT_GT(kappaOf(a, b), 0.7);
  EXPECT_NEAR(kappaOf(a, renamed), kappaOf(a, b), 1e-12);
  EXPECT_NEAR(randIndexOf(a, renamed), randIndexOf(a, b), 1e-12);
  EXPECT_NEAR(kappaOf(b, renamed), 1, 1e-12);
  EXPECT_NEAR(randIndexOf(b, renamed), 1, 1e-12);
}

TEST(Agreement, ByChanceIsNothing) {
  double index = 0;
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    const Labels a = randomLabels(4, 5000, seed), b = randomLabels(3, 5000, 50 + seed);
    EXPECT_LT(std::abs(randIndexOf(a, b)), 0.01);
    EXPECT_GT(kappaOf(a, b), 0);  // the matching looks for it
    EXPECT_LT(kappaOf(a, b), 4 / std::sqrt(5000.0));
    index += randIndexOf(a, b) / 20;
  }
  EXPECT_LT(std::abs(index), 0.001);
}

TEST(Agreement, WhereThereIsOneLabelOrAsManyAsSteps) {
  EXPECT_EQ(kappaOf({3, 3, 3}, {8, 8, 8}), 1);
  EXPECT_EQ(randIndexOf({3, 3, 3}, {8, 8, 8}), 1);
  EXPECT_EQ(kappaOf({3}, {8}), 1);
  EXPECT_EQ(randIndexOf({3}, {8}), 1);
  EXPECT_NEAR(kappaOf({3, 3, 3, 3}, {1, 1, 1, 2}), 0, 1e-12);
  EXPECT_NEAR(randIndexOf({3, 3, 3, 3}, {1, 1, 1, 2}), 0, 1e-12);
  EXPECT_EQ(randIndexOf({1, 2, 3}, {4, 6, 5}), 1);
  EXPECT_NEAR(kappaOf({1, 2, 3}, {4, 6, 5}), 1, 1e-12);
  EXPECT_NEAR(randIndexOf({1, 2, 3}, {4, 4, 4}), 0, 1e-12);
}

/// Labels that change at each of these steps.
Labels changingAt(const Labels& boundaries, int steps) {
  Labels labels;
  for (int t = 0; t < steps; ++t)
    labels.push_back(static_cast<int>(std::count_if(boundaries.begin(), boundaries.end(),
                                                    [&](int b) { return b <= t; })) %
                     2);
  return labels;
}

TEST(Agreement, OfBoundaries) {
  EXPECT_EQ(boundariesOf({1, 1, 2, 2, 1, 3}), (Labels{2, 4, 5}));
  EXPECT_TRUE(boundariesOf({1, 1}).empty());
  EXPECT_TRUE(boundariesOf({}).empty());
  const Labels truth = changingAt({20, 50, 80}, 100), found = changingAt({18, 53, 60, 81}, 100);
  const BoundaryAgreement near = boundaryAgreement(found, truth, 2);
  EXPECT_EQ(near.met, 2);
  EXPECT_DOUBLE_EQ(near.precision(), 0.5);
  EXPECT_DOUBLE_EQ(near.recall(), 2 / 3.0);
  EXPECT_DOUBLE_EQ(near.f(), 4 / 7.0);
  EXPECT_EQ(boundaryAgreement(found, truth, 0).met, 0);
  EXPECT_EQ(boundaryAgreement(found, truth, 0).f(), 0);
  EXPECT_EQ(boundaryAgreement(found, truth, 3).met, 3);
  EXPECT_EQ(boundaryAgreement(truth, truth, 0).f(), 1);
  const BoundaryAgreement other_way = boundaryAgreement(truth, found, 2);
  EXPECT_DOUBLE_EQ(other_way.precision(), near.recall());
  EXPECT_DOUBLE_EQ(other_way.f(), near.f());
}

TEST(Agreement, ABoundaryIsMetOnce) {
  EXPECT_EQ(boundaryAgreement(changingAt({48, 50, 52}, 100), changingAt({50}, 100), 5).met, 1);
  EXPECT_EQ(boundaryAgreement(changingAt({48, 54}, 100), changingAt({44, 50}, 100), 4).met,
            2);  // not 48 to 50, which is nearer
}

TEST(Agreement, OfNoBoundaries) {
  const Labels none(100, 4), some = changingAt({30}, 100);
  EXPECT_EQ(boundaryAgreement(none, none, 3).f(), 1);
  const BoundaryAgreement missed = boundaryAgreement(none, some, 3),
                          wrong = boundaryAgreement(some, none, 3);
  EXPECT_EQ(missed.precision(), 1);
  EXPECT_EQ(missed.recall(), 0);
  EXPECT_EQ(missed.f(), 0);
  EXPECT_EQ(wrong.precision(), 0);
  EXPECT_EQ(wrong.recall(), 1);
  BoundaryAgreement sum = missed;
  sum += wrong;
  sum += boundaryAgreement(some, some, 0);
  EXPECT_DOUBLE_EQ(sum.f(), 0.5);
}

TEST(Agreement, WhatCannotBeComparedIsNamed) {
  EXPECT_TRUE(says(complaint([] { contingencyOf({}, {}); }), "no steps"));
  EXPECT_TRUE(says(complaint([] { contingencyOf({1, 2}, {1}); }), "2 steps and 1"));
  EXPECT_TRUE(says(complaint([] { boundaryAgreement({1}, {1, 2}, 1); }), "1 steps and 2"));
  EXPECT_TRUE(says(complaint([] { boundaryAgreement({1}, {1}, -1); }), "negative"));
}

}  // namespace
}  // namespace palpa::calibration
