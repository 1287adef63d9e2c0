#include "haptics/surface/floor.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <tuple>
#include <utility>

#include "anatomy/base/error.h"
#include "tests/surface/surface_bench.h"

namespace palpa::haptics {
namespace {

constexpr double kTurnOfDirections = 6.283185307179586;

TEST(GaborTable, HasTheSizeOfItsBits) {
  EXPECT_EQ(GaborTable(1024, 240).bytes(), 20'971'520u);
  EXPECT_EQ(GaborTable(8, 240).bytes(), 64u * 160 / 8);
}

TEST(GaborTable, KeepsEveryBitApart) {
  GaborTable table(64, 240);
  Draws draw(51);
  std::set<std::tuple<int, int, int, int>> set;
  const auto any = [&draw](int n) { return static_cast<int>(draw() * n); };
  for (int n = 0; n < 20000; ++n) {
    const int i = any(64), j = any(64), direction = any(32), scale = any(5);
    const bool rises = draw() < 0.6;
    table.set(i, j, direction, scale, rises);
    if (rises)
      set.insert({i, j, direction, scale});
    else
      set.erase({i, j, direction, scale});
  }
  for (int j = 0; j < 64; ++j)
    for (int i = 0; i < 64; ++i)
      for (int d = 0; d < 32; ++d)
        for (int s = 0; s < 5; ++s)
          ASSERT_EQ(table.pixel(i, j, d, s), set.count({i, j, d, s}) == 1)
              << i << " " << j << " " << d << " " << s;
}

/// One pixel set: found all over it and nowhere else, and at its middle where the header says.
TEST(GaborTable, RisesOverAPixelAndNotBesidesIt) {
  GaborTable table(1024, 240);
  const double pixel = 240.0 / 1024;
  for (const auto& [i, j] :
       {std::pair{0, 0}, {1023, 0}, {0, 1023}, {1023, 1023}, {517, 300}, {7, 8}}) {
    const double x = (i + 0.5) * pixel - 120, y = (j + 0.5) * pixel - 120;
    EXPECT_FALSE(table.rises(x, y, 31, 4));
    table.set(i, j, 31, 4, true);
    for (const double dx : {-0.49, 0.0, 0.49})
      for (const double dy : {-0.49, 0.0, 0.49})
        EXPECT_TRUE(table.rises(x + dx * pixel, y + dy * pixel, 31, 4)) << i << " " << j;
    for (const auto& [dx, dy] : {std::pair{0.51, 0.0}, {-0.51, 0.0}, {0.0, 0.51}, {0.0, -0.51}})
      EXPECT_FALSE(table.rises(x + dx * pixel, y + dy * pixel, 31, 4)) << i << " " << j;
    EXPECT_FALSE(table.rises(x, y, 30, 4));
    EXPECT_FALSE(table.rises(x, y, 31, 3));
    table.set(i, j, 31, 4, false);
    EXPECT_FALSE(table.rises(x, y, 31, 4));
  }
}

TEST(GaborTable, NothingRisesBeyondTheMap) {
  GaborTable table(8, 240);
  for (int i = 0; i < 8; ++i)
    for (int j = 0; j < 8; ++j) table.set(i, j, 0, 0, true);
  EXPECT_TRUE(table.rises(-120, -120, 0, 0));
  EXPECT_TRUE(table.rises(119.999, 119.999, 0, 0));
  for (const double beyond : {120.0, -120.001, 1e300, -1e300, HUGE_VAL, -HUGE_VAL, std::nan("")}) {
    EXPECT_FALSE(table.rises(beyond, 0, 0, 0)) << beyond;
    EXPECT_FALSE(table.rises(0, beyond, 0, 0)) << beyond;
  }
}

TEST(GaborTable, TakesTheNearestDirection) {
  for (int k = 0; k < 32; ++k)
    for (const double off : {-0.499, -0.3, 0.0, 0.3, 0.499})
      for (const double speed : {1e-200, 1.0, 1e200}) {
        const double angle = (k + off) * kTurnOfDirections / 32;
        EXPECT_EQ(GaborTable::directionOf(speed * std::cos(angle), speed * std::sin(angle)), k)
            << off;
      }
  EXPECT_EQ(GaborTable::directionOf(1, 0), 0);
  EXPECT_EQ(GaborTable::directionOf(1, -1e-9), 0);
  EXPECT_EQ(GaborTable::directionOf(0, 1), 8);
  EXPECT_EQ(GaborTable::directionOf(-1, 0.0), 16);
  EXPECT_EQ(GaborTable::directionOf(-1, -0.0), 16);
  EXPECT_EQ(GaborTable::directionOf(0, -1), 24);
  for (const double bad : {std::nan(""), HUGE_VAL, -HUGE_VAL, 0.0}) {
    EXPECT_GE(GaborTable::directionOf(bad, bad), 0);
    EXPECT_LT(GaborTable::directionOf(bad, bad), 32);
  }
}

TEST(GaborTable, AScaleIsADoublingOfSpeed) {
  for (const double first : {1.0, 0.3, 37.0, 1e-6})
    for (int k = 0; k < 9; ++k) {
      const int scale = std::min(k, 4);
      EXPECT_EQ(GaborTable::scaleOf(first * std::ldexp(1, k), first), scale) << first;
      EXPECT_EQ(GaborTable::scaleOf(std::nextafter(first * std::ldexp(1, k), 0.0), first),
                std::clamp(k - 1, 0, 4))
          << first;
      EXPECT_EQ(GaborTable::scaleOf(1.5 * first * std::ldexp(1, k), first), scale);
    }
  EXPECT_EQ(GaborTable::scaleOf(0.01, 1), 0);
  EXPECT_EQ(GaborTable::scaleOf(0, 1), 0);
  EXPECT_EQ(GaborTable::scaleOf(-5, 1), 0);
  EXPECT_EQ(GaborTable::scaleOf(1e300, 1), 4);
  EXPECT_EQ(GaborTable::scaleOf(HUGE_VAL, 1), 4);
  EXPECT_EQ(GaborTable::scaleOf(std::nan(""), 1), 0);
}

TEST(GaborTable, RefusesMapsThatAreNone) {
  EXPECT_THROW(GaborTable(0, 240), Error);
  EXPECT_THROW(GaborTable(-8, 240), Error);
  EXPECT_THROW(GaborTable(12, 240), Error);
  EXPECT_THROW(GaborTable(1 << 20, 240), Error);
  EXPECT_THROW(GaborTable(8, 0), Error);
  EXPECT_THROW(GaborTable(8, -1), Error);
  EXPECT_THROW(GaborTable(8, std::nan("")), Error);
  EXPECT_THROW(GaborTable(8, HUGE_VAL), Error);
}

}  // namespace
}  // namespace palpa::haptics
