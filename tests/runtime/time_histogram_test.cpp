#include "apps/runtime/executive.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "anatomy/base/random.h"
#include "tests/support/allocation_guard.h"

namespace palpa::runtime {
namespace {

TEST(TimeHistogram, SmallTimesAreExact) {
  TimeHistogram h;
  for (int t = 1; t <= 200; ++t) h.add(t);
  EXPECT_EQ(h.count(), 200u);
  EXPECT_EQ(h.quantile(0.5), 100);
  EXPECT_EQ(h.quantile(0.99), 198);
  EXPECT_EQ(h.quantile(0.999), 200);
  EXPECT_EQ(h.max_ns(), 200);
}

TEST(TimeHistogram, QuantilesOfLongTimesAreWithinTheStatedShare) {
  TimeHistogram h;
  std::vector<std::int64_t> all;
  RandomStream random(7, "histogram");
  for (int i = 0; i < 20'000; ++i) {  // 1 us to 1 s, even over the octaves
    all.push_back(
        static_cast<std::int64_t>(std::exp(random.uniform(std::log(1e3), std::log(1e9)))));
    h.add(all.back());
  }
  std::sort(all.begin(), all.end());
  for (const double q : {0.01, 0.5, 0.9, 0.99, 0.999, 1.0}) {
    const auto rank = static_cast<std::size_t>(std::ceil(q * static_cast<double>(all.size()))) - 1;
    const auto exact = static_cast<double>(all[rank]);
    EXPECT_NEAR(h.quantile(q), exact, 0.004 * exact) << q;
  }
}

TEST(TimeHistogram, TheLargestIsExactAndNoQuantileExceedsIt) {
  TimeHistogram h;
  h.add(1'000'001);
  EXPECT_EQ(h.max_ns(), 1'000'001);
  EXPECT_LE(h.quantile(1), 1'000'001);
  EXPECT_NEAR(h.quantile(0), 1'000'001, 4000);
}

TEST(TimeHistogram, BothEndsHoldWhatLiesBeyond) {
  TimeHistogram h;
  h.add(-5);
  EXPECT_EQ(h.quantile(1), 0);
  h.add(std::int64_t{1} << 50);
  EXPECT_EQ(h.max_ns(), std::int64_t{1} << 50);
  EXPECT_GT(h.quantile(1), 0.99 * std::ldexp(1, 40));
}

TEST(TimeHistogram, TheSumOfTwoIsTheHistogramOfAll) {
  TimeHistogram a, b, both;
  for (int i = 0; i < 1000; ++i) {
    const std::int64_t t = 37ll * i * i;
    (i % 3 ? a : b).add(t);
    both.add(t);
  }
  a.add(b);
  EXPECT_EQ(a.count(), both.count());
  EXPECT_EQ(a.max_ns(), both.max_ns());
  for (double q = 0; q <= 1; q += 0.05) EXPECT_EQ(a.quantile(q), both.quantile(q));
}

TEST(TimeHistogram, CountsWithoutAllocation) {
  TimeHistogram h;
  const NoAllocation guard;
  for (std::int64_t t = 1; t < std::int64_t{1} << 42; t *= 2) h.add(t);
  EXPECT_GT(spreadOf(h).max_us, 0);
  EXPECT_EQ(guard.allocations(), 0);
}

TEST(TimeHistogram, OfNothingIsZero) {
  const TimeSpread s = spreadOf(TimeHistogram());
  EXPECT_EQ(s.median_us, 0);
  EXPECT_EQ(s.p999_us, 0);
  EXPECT_EQ(s.max_us, 0);
}

TEST(TimeHistogram, IsSpokenOfInMicroseconds) {
  TimeHistogram h;
  for (int i = 0; i < 1000; ++i) h.add(128'000);
  const TimeSpread s = spreadOf(h);
  EXPECT_NEAR(s.median_us, 128, 0.5);
  EXPECT_EQ(s.max_us, 128);
}

}  // namespace
}  // namespace palpa::runtime
