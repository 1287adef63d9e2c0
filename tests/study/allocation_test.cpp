#include "apps/study/protocol.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <set>

namespace palpa::study {
namespace {

std::string orderOf(const Allocation& a, const std::string& group, std::uint64_t seed, int places) {
  std::string order;
  for (int place = 1; place <= places; ++place) order += conditionOf(a, group, seed, place);
  return order;
}

TEST(Allocation, IsBalancedAtTheEndOfEveryBlock) {
  for (const Allocation& a :
       {Allocation{{"A", "B"}, 2}, Allocation{{"A", "B"}, 4}, Allocation{{"A", "B", "C"}, 6}})
    for (std::uint64_t seed = 1; seed <= 50; ++seed) {
      const std::string order = orderOf(a, "novice", seed, 5 * a.block);
      for (int end = a.block; end <= 5 * a.block; end += a.block)
        for (const std::string& c : a.conditions)
          EXPECT_EQ(std::count(order.begin(), order.begin() + end, c[0]),
                    end / static_cast<int>(a.conditions.size()))
              << order;
    }
}

TEST(Allocation, FollowsFromSeedAndGroupAlone) {
  const Allocation a{{"A", "B"}, 4};
  EXPECT_EQ(orderOf(a, "novice", 3, 40), orderOf(a, "novice", 3, 40));
  EXPECT_NE(orderOf(a, "novice", 3, 40), orderOf(a, "experienced", 3, 40));
  EXPECT_NE(orderOf(a, "novice", 3, 40), orderOf(a, "novice", 4, 40));
}

/// Each of the six orders of a block of four is as likely as any other: chi-square of 6,000 blocks
/// with 5 degrees of freedom, 99.9 % below 20.5.
TEST(Allocation, EveryOrderIsAsLikely) {
  const Allocation a{{"A", "B"}, 4};
  std::map<std::string, int> seen;
  for (std::uint64_t seed = 1; seed <= 600; ++seed) {
    const std::string order = orderOf(a, "g", seed, 40);
    for (int block = 0; block < 10; ++block)
      ++seen[order.substr(static_cast<std::size_t>(4 * block), 4)];
  }
  ASSERT_EQ(seen.size(), 6u);
  double chi_square = 0;
  for (const auto& [order, count] : seen)
    chi_square += (count - 1000.0) * (count - 1000.0) / 1000.0;
  EXPECT_LT(chi_square, 20.5);
}

}  // namespace
}  // namespace palpa::study
