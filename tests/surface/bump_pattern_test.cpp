#include "haptics/surface/bump_pattern.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <set>

#include "anatomy/base/error.h"
#include "tests/surface/surface_bench.h"

namespace palpa::haptics {
namespace {

const BumpSpec kTargetBumps{2, 7, 5.6, 5, 25}, kDistractorBumps{1, 3, 2.4, 5, 25};

bool sameBumps(const BumpPattern& a, const BumpPattern& b) {
  return std::equal(a.bumps().begin(), a.bumps().end(), b.bumps().begin(), b.bumps().end(),
                    [](const auto& p, const auto& q) { return p.x == q.x && p.y == q.y; });
}

TEST(BumpPattern, NoFootprintCrossesARim) {
  for (const BumpSpec& spec : {kTargetBumps, kDistractorBumps})
    for (std::uint64_t seed = 0; seed < 500; ++seed) {
      const BumpPattern pattern(spec, evenly(seed));
      ASSERT_FALSE(pattern.bumps().empty());
      for (const BumpPattern::Bump& b : pattern.bumps()) {
        const double r = std::hypot(b.x, b.y);
        EXPECT_GE(r - spec.radius, 5 - 1e-12);
        EXPECT_LE(r + spec.radius, 25 + 1e-12);
      }
    }
}

/// Every cell whose draws keep the rims gives its bump, and the draws of the others are used up all
/// the same: row by row, x first.
TEST(BumpPattern, IsTheGridWithItsDraws) {
  for (const BumpSpec& spec : {kTargetBumps, kDistractorBumps}) {
    int drawn = 0;
    Draws draw(3), again(3);
    const BumpPattern pattern(spec, [&] { return ++drawn, draw(); });
    const int side = spec.radius > 1 ? 8 : 17;  // of 7 or 3 U each, to cover 50
    EXPECT_EQ(drawn, 2 * side * side);
    std::size_t kept = 0;
    for (int j = 0; j < side; ++j)
      for (int i = 0; i < side; ++i) {
        const double x = (i - 0.5 * (side - 1)) * spec.spacing + (again() - 0.5) * spec.jitter;
        const double y = (j - 0.5 * (side - 1)) * spec.spacing + (again() - 0.5) * spec.jitter;
        const double r = std::hypot(x, y);
        if (r - spec.radius < spec.inner || r + spec.radius > spec.outer) continue;
        ASSERT_LT(kept, pattern.bumps().size());
        EXPECT_NEAR(pattern.bumps()[kept].x, x, 1e-12);
        EXPECT_NEAR(pattern.bumps()[kept].y, y, 1e-12);
        ++kept;
      }
    EXPECT_EQ(kept, pattern.bumps().size());
  }
}

TEST(BumpPattern, SameDrawsSameBumpsOtherDrawsOthers) {
  for (const BumpSpec& spec : {kTargetBumps, kDistractorBumps}) {
    EXPECT_TRUE(sameBumps({spec, evenly(5)}, {spec, evenly(5)}));
    EXPECT_FALSE(sameBumps({spec, evenly(5)}, {spec, evenly(6)}));
  }
}

TEST(BumpPattern, NearFindsEveryBumpWithinReachOnce) {
  Draws draw(21);
  for (const BumpSpec& spec : {kTargetBumps, kDistractorBumps,
                               BumpSpec{1, 4, 9, 2, 30}})  // the last: jitter over more than a cell
    for (int n = 0; n < 2000; ++n) {
      const BumpPattern pattern(spec, evenly(static_cast<std::uint64_t>(n / 100)));
      const double x = draw.from(-60, 60), y = draw.from(-60, 60), reach = draw.from(0, 20);
      std::multiset<const BumpPattern::Bump*> seen;
      pattern.near(x, y, reach, [&](const BumpPattern::Bump& b) { seen.insert(&b); });
      for (const BumpPattern::Bump& b : pattern.bumps())
        if (std::hypot(b.x - x, b.y - y) <= reach) {
          EXPECT_EQ(seen.count(&b), 1u) << x << " " << y << " " << reach;
        }
      EXPECT_EQ(seen.size(), std::set<const BumpPattern::Bump*>(seen.begin(), seen.end()).size());
    }
}

TEST(BumpPattern, SurvivesPlacesThatAreNone) {
  const BumpPattern pattern(kTargetBumps, evenly(1));
  for (const double bad : {std::nan(""), 1e300, -1e300, HUGE_VAL, -HUGE_VAL}) {
    EXPECT_EQ(pattern.height(bad, 0), 0);
    EXPECT_FALSE(pattern.covered(0, bad));
    EXPECT_EQ(pattern.over(bad, bad), nullptr);
  }
}

TEST(BumpPattern, HemispheresAreHemispheres) {
  for (const BumpSpec& spec : {kTargetBumps, kDistractorBumps}) {
    const BumpPattern pattern(spec, evenly(8));
    const BumpPattern::Bump b = pattern.bumps()[0];
    EXPECT_NEAR(pattern.height(b.x, b.y), spec.radius, 1e-12);
    double highest = 0;
    Draws draw(9);
    for (int n = 0; n < 20000; ++n) {
      const double x = draw.from(-27, 27), y = draw.from(-27, 27), h = highestBump(pattern, x, y);
      EXPECT_NEAR(pattern.height(x, y), h, 1e-7);  // a root of a rounding, at an edge
      EXPECT_EQ(pattern.covered(x, y), h > 0);
      highest = std::max(highest, h);
    }
    EXPECT_NEAR(highest, spec.radius, 1e-2);
  }
}

TEST(BumpPattern, WhereTwoOverlapTheHigherCounts) {
  const BumpSpec spec{2, 7, 7, 5, 25};
  const BumpPattern pattern(spec, placing(spec, {{6.5, 10}, {8.5, 10}}));
  EXPECT_NEAR(pattern.height(6.6, 10), std::sqrt(4 - 0.01), 1e-12);  // the other: sqrt(4 - 3.61)
  EXPECT_NEAR(pattern.height(8.4, 10), std::sqrt(4 - 0.01), 1e-12);
  EXPECT_NEAR(pattern.height(7.5, 10), std::sqrt(3.0), 1e-12);
  ASSERT_NE(pattern.over(7.6, 10), nullptr);
  EXPECT_NEAR(pattern.over(7.6, 10)->x, 8.5, 1e-12);
  EXPECT_NEAR(pattern.over(7.4, 10)->x, 6.5, 1e-12);
}

/// The way in fine steps: entered where a sample lies in a footprint that does not hold the first.
/// What only grazes a footprint, samples may miss.
enum class Steps { out, graze, in };
Steps stepped(const BumpPattern& pattern, double ax, double ay, double bx, double by, int steps) {
  const double r = pattern.spec().radius;
  Steps found = Steps::out;
  for (const BumpPattern::Bump& b : pattern.bumps()) {
    if (std::hypot(ax - b.x, ay - b.y) < r) continue;
    double nearest2 = 1e9;
    for (int k = 1; k <= steps; ++k) {
      const double t = static_cast<double>(k) / steps, x = ax + t * (bx - ax) - b.x,
                   y = ay + t * (by - ay) - b.y;
      nearest2 = std::min(nearest2, x * x + y * y);
    }
    if (nearest2 < r * r) return Steps::in;
    if (nearest2 < (r + 1e-4) * (r + 1e-4))
      found = Steps::graze;  // 20 U in 2000 steps: 1.3e-5 of sagitta under a step
  }
  return found;
}

TEST(BumpPattern, EnteredAgreesWithFineSteps) {
  Draws draw(31);
  for (const BumpSpec& spec : {kTargetBumps, kDistractorBumps})
    for (const double length : {0.05, 0.2, 1.0, 3.0, 7.0, 20.0}) {
      const BumpPattern pattern(spec, evenly(static_cast<std::uint64_t>(length * 100)));
      int in = 0, out = 0;
      for (int n = 0; n < 120; ++n) {
        // From near a footprint's edge, on either side of it.
        const BumpPattern::Bump& b = pattern.bumps()[static_cast<std::size_t>(
            draw() * static_cast<double>(pattern.bumps().size()))];
        const double around = draw.from(0, 6.2832),
                     from = spec.radius + length * draw.from(-0.3, 0.7),
                     angle = draw.from(0, 6.2832);
        const double ax = b.x + from * std::cos(around), ay = b.y + from * std::sin(around);
        const double bx = ax + length * std::cos(angle), by = ay + length * std::sin(angle);
        const Steps steps = stepped(pattern, ax, ay, bx, by, 2000);
        if (steps == Steps::graze) continue;
        EXPECT_EQ(pattern.entered(ax, ay, bx, by), steps == Steps::in)
            << length << ": " << ax << " " << ay << " " << bx << " " << by;
        ++(steps == Steps::in ? in : out);
      }
      EXPECT_GT(in, 15) << length;
      EXPECT_TRUE(length > 10 || out > 15) << length << " " << out;
    }
}

TEST(BumpPattern, AWayThroughEntersATouchDoesNot) {
  const BumpSpec spec{2, 7, 7, 5, 25};
  const BumpPattern pattern(spec, placing(spec, {{10.5, 10.5}}));  // others at 10.5 +- 7
  EXPECT_TRUE(pattern.entered(7.4, 10.5, 13.6, 10.5)) << "past it altogether";
  EXPECT_TRUE(pattern.entered(7.4, 10.5, 9, 10.5)) << "into it";
  EXPECT_FALSE(pattern.entered(10, 10.5, 11, 10.5)) << "within it";
  EXPECT_FALSE(pattern.entered(10, 10.5, 13.6, 10.5)) << "out of it";
  EXPECT_TRUE(pattern.entered(10, 10.5, 15.8, 10.5)) << "out of it, into the next";
  EXPECT_FALSE(pattern.entered(8, 12.5, 13, 12.5)) << "along its edge";
  EXPECT_TRUE(pattern.entered(8, 12.5 - 1e-9, 13, 12.5 - 1e-9));
  EXPECT_FALSE(pattern.entered(8, 12.5 + 1e-9, 13, 12.5 + 1e-9));
  EXPECT_FALSE(pattern.entered(7.4, 10.5, 8.5, 10.5)) << "up to its edge";
  EXPECT_FALSE(pattern.entered(7.4, 10.5, 7.4, 10.5));
  EXPECT_FALSE(pattern.entered(10.5, 10.5, 10.5, 10.5));
}

/// However a way is cut, each footprint on it is entered once.
TEST(BumpPattern, PiecesOfAWayEnterAsOftenAsTheWayDoes) {
  const BumpSpec spec{2, 7, 7, 5, 25};
  const BumpPattern pattern(
      spec, placing(spec, {}));  // a grid: the row at y = 10.5 has middles at -17.5, -10.5 ... 17.5
  Draws draw(41);
  for (int n = 0; n < 200; ++n) {
    const double y = 10.5 + draw.from(-1.9, 1.9);
    int entered = 0;
    for (double x = -22; x < 22;) {
      const double next = std::min(x + draw.from(1e-6, 1.2), 22.0);
      entered += pattern.entered(x, y, next, y);
      x = next;
    }
    EXPECT_EQ(entered, 6);
  }
}

TEST(BumpPattern, RefusesWhatIsNone) {
  const auto pattern = [](BumpSpec spec) { return BumpPattern(spec, evenly(1)); };
  EXPECT_NO_THROW(pattern({2, 7, 0, 0, 25}));
  EXPECT_THROW(pattern({0, 7, 5.6, 5, 25}), Error);
  EXPECT_THROW(pattern({-1, 7, 5.6, 5, 25}), Error);
  EXPECT_THROW(pattern({2, 0, 5.6, 5, 25}), Error);
  EXPECT_THROW(pattern({2, 7, -1, 5, 25}), Error);
  EXPECT_THROW(pattern({2, 7, 5.6, -5, 25}), Error);
  EXPECT_THROW(pattern({2, 7, 5.6, 25, 5}), Error);
  EXPECT_THROW(pattern({2, 7, 5.6, 5, 8.9}), Error);
  EXPECT_THROW(pattern({2, 1e-3, 0, 5, 25}), Error);
  for (const double bad : {std::nan(""), HUGE_VAL})
    for (int field = 0; field < 5; ++field) {
      std::array<double, 5> f{2, 7, 5.6, 5, 25};
      f[static_cast<std::size_t>(field)] = bad;
      EXPECT_THROW(pattern({f[0], f[1], f[2], f[3], f[4]}), Error) << field;
    }
}

}  // namespace
}  // namespace palpa::haptics
