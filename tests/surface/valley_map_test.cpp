#include "haptics/surface/floor.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "anatomy/base/error.h"
#include "tests/surface/surface_bench.h"

namespace palpa::haptics {
namespace {

constexpr double kValleyTurn = 6.283185307179586, kValleyReach = 6;

ValleyPoint onCircle(double angle, double cx = 0, double cy = 0) {
  return {cx + 30 * std::cos(angle), cy + 30 * std::sin(angle), -std::sin(angle), std::cos(angle),
          2};
}

std::vector<ValleyPoint> circleOf(int n, double cx = 0, double cy = 0) {
  std::vector<ValleyPoint> points;
  for (int k = 0; k < n; ++k) points.push_back(onCircle(k * kValleyTurn / n, cx, cy));
  return points;
}

double toPoint(const ValleyPoint& p, double x, double y) { return std::hypot(p.x - x, p.y - y); }

TEST(ValleyMap, KeepsEveryPoint) {
  Draws draw(61);
  std::vector<ValleyPoint> points;
  for (int n = 0; n < 500; ++n)
    points.push_back({draw.from(-130, 130), draw.from(-130, 130), 0, 0, draw()});
  const ValleyMap map(points, 240, 7);
  ASSERT_EQ(map.points().size(), points.size());
  for (const ValleyPoint& p : points)
    EXPECT_TRUE(std::any_of(map.points().begin(), map.points().end(), [&](const ValleyPoint& q) {
      return q.x == p.x && q.y == p.y && q.radius == p.radius;
    }));
  EXPECT_EQ(map.reach(), 7);
}

/// Points without a direction, also beyond the floor: just the nearest one.
TEST(ValleyMap, OfPitsTakesTheNearest) {
  Draws draw(62);
  std::vector<ValleyPoint> points;
  for (int n = 0; n < 400; ++n)
    points.push_back({draw.from(-130, 130), draw.from(-130, 130), 0, 0, 1 + draw()});
  for (const double reach : {0.01, 3.0, 9.0, 400.0}) {
    const ValleyMap map(points, 240, reach);
    int found = 0;
    for (int n = 0; n < 2000; ++n) {
      const double x = draw.from(-140, 140), y = draw.from(-140, 140);
      const auto by_plain = std::min_element(
          points.begin(), points.end(),
          [&](const auto& p, const auto& q) { return toPoint(p, x, y) < toPoint(q, x, y); });
      const double distance = toPoint(*by_plain, x, y);
      const NearestValley nearest = map.nearest(x, y);
      ASSERT_EQ(nearest.found, distance <= reach) << x << " " << y << " " << distance;
      if (!nearest.found) continue;
      ++found;
      EXPECT_NEAR(nearest.distance, distance, 1e-12);
      EXPECT_NEAR(nearest.dx, by_plain->x - x, 1e-12);
      EXPECT_NEAR(nearest.dy, by_plain->y - y, 1e-12);
      EXPECT_EQ(nearest.radius, by_plain->radius);
    }
    EXPECT_TRUE(reach < 1 || found > 100) << found;
  }
}

/// A circle of points 0.8 U apart: its distance does not ripple; s^2 / (8 R) = 2.7e-3 U is what
/// tangents leave of it.
TEST(ValleyMap, BetweenPointsOfACircleIsTheCircle) {
  const int n = 236;
  const double spacing = kValleyTurn * 30 / n, error = 1.05 * spacing * spacing / (8 * 30);
  const ValleyMap map(circleOf(n, 11, -7), 240, kValleyReach);
  Draws draw(63);
  int found = 0;
  for (int k = 0; k < 5000; ++k) {
    const double r = draw.from(20, 40), angle = draw.from(0, kValleyTurn),
                 x = 11 + r * std::cos(angle), y = -7 + r * std::sin(angle);
    const double distance = std::abs(r - 30);
    const NearestValley nearest = map.nearest(x, y);
    if (std::abs(distance - kValleyReach) < error) continue;
    ASSERT_EQ(nearest.found, distance < kValleyReach) << r << " " << angle;
    if (!nearest.found) continue;
    ++found;
    EXPECT_NEAR(nearest.distance, distance, error);
    EXPECT_NEAR(nearest.distance, std::hypot(nearest.dx, nearest.dy), 1e-12);
    const double along = nearest.dx * -std::sin(angle) + nearest.dy * std::cos(angle);
    EXPECT_NEAR(along, 0, 0.02 * distance + 1e-3)
        << "straight across: a tangent turns by half a step, 0.013 rad";
    EXPECT_EQ(nearest.radius, 2);
  }
  EXPECT_GT(found, 2000);
}

/// Unevenly spaced, as points that come of pixels are: gaps from a fifth of the mean to twice it
/// leave no holes.
TEST(ValleyMap, UnevenPointsLeaveNoHoles) {
  Draws draw(64);
  std::vector<ValleyPoint> points;
  double widest = 0;
  for (double angle = 0; angle < kValleyTurn - 0.02;) {
    points.push_back(onCircle(angle));
    const double step = draw.from(0.002, 0.02);
    widest = std::max(widest, 30 * step);
    angle += step;
  }
  const ValleyMap map(points, 240, kValleyReach);
  for (int k = 0; k < 3000; ++k) {
    const double angle = draw.from(0.02, kValleyTurn - 0.04);
    const NearestValley nearest = map.nearest(30 * std::cos(angle), 30 * std::sin(angle));
    ASSERT_TRUE(nearest.found);
    EXPECT_LT(nearest.distance, widest * widest / (8 * 30) * 1.05) << angle;
  }
}

TEST(ValleyMap, DistanceNeverJumps) {
  const ValleyMap map(circleOf(100), 240, 12);  // 1.9 U apart
  Draws draw(65);
  for (int k = 0; k < 200; ++k) {
    const double x = draw.from(-30, 30), y = draw.from(-30, 30), angle = draw.from(0, kValleyTurn),
                 step = 1e-3;
    NearestValley before = map.nearest(x, y);
    for (int n = 1; n < 2000; ++n) {
      const NearestValley now =
          map.nearest(x + n * step * std::cos(angle), y + n * step * std::sin(angle));
      const double change =
          before.found && now.found ? std::abs(now.distance - before.distance) : 0;
      ASSERT_LE(change, step * (1 + 1e-9));
      before = now;
    }
  }
}

TEST(ValleyMap, ALineEndsAtItsLastPoint) {
  std::vector<ValleyPoint> line;
  for (int k = 0; k <= 10; ++k) line.push_back({0.5 * k, 0, 1, 0, 2});
  line.push_back({9.5, 0, 1, 0, 2});  // nine spacings on: another line
  const ValleyMap map(line, 240, 5);
  EXPECT_NEAR(map.nearest(5.9, 1.2).distance, 1.5, 1e-12);
  EXPECT_NEAR(map.nearest(5.9, 1.2).dx, -0.9, 1e-12);
  EXPECT_NEAR(map.nearest(-0.9, -1.2).distance, 1.5, 1e-12);
  EXPECT_NEAR(map.nearest(2.77, 1.2).distance, 1.2, 1e-12);
  EXPECT_NEAR(map.nearest(2.77, 1.2).dx, 0, 1e-12);
  EXPECT_NEAR(map.nearest(9, 0).distance, 0.5, 1e-12);
}

/// Across another line, close by: a neighbour is one that lies ahead or behind and runs the same
/// way.
TEST(ValleyMap, LinesThatCrossOrRunBesidesDoNotJoin) {
  std::vector<ValleyPoint> points;
  for (int k = -10; k <= 10; ++k) {
    points.push_back({0.5 * k, 0, 1, 0, 2});
    points.push_back({0.5 * k, 0.8, -1, 0, 3});
    points.push_back({7 + 0.25, 0.5 * k, 0, 1, 4});
  }
  const ValleyMap map(points, 240, 5);
  EXPECT_NEAR(map.nearest(1.27, 0.3).distance, 0.3, 1e-12);
  EXPECT_EQ(map.nearest(1.27, 0.3).radius, 2);
  EXPECT_NEAR(map.nearest(1.27, 0.5).distance, 0.3, 1e-12);
  EXPECT_EQ(map.nearest(1.27, 0.5).radius, 3);
  EXPECT_NEAR(map.nearest(6, 0).distance, 1, 1e-12) << "the first line's end, not its tangent";
}

TEST(ValleyMap, ALonePitAttractsFromAllSides) {
  const ValleyMap map({{40, -20, 0, 0, 2}}, 240, 5);
  for (int k = 0; k < 32; ++k) {
    const double angle = k * kValleyTurn / 32, r = 0.15 * k;
    const NearestValley nearest = map.nearest(40 + r * std::cos(angle), -20 + r * std::sin(angle));
    ASSERT_TRUE(nearest.found);
    EXPECT_NEAR(nearest.distance, r, 1e-12);
    EXPECT_NEAR(nearest.dx, -r * std::cos(angle), 1e-12);
    EXPECT_NEAR(nearest.dy, -r * std::sin(angle), 1e-12);
  }
  EXPECT_TRUE(map.nearest(44.999, -20).found);
  EXPECT_FALSE(map.nearest(45.001, -20).found);
}

TEST(ValleyMap, OnAPointThereIsNothingLeftToGo) {
  std::vector<ValleyPoint> points = circleOf(200);
  points.push_back({3, 4, 0, 0, 2});
  const ValleyMap map(points, 240, 5);
  for (const ValleyPoint& p : points) {
    const NearestValley nearest = map.nearest(p.x, p.y);
    EXPECT_TRUE(nearest.found);
    EXPECT_EQ(nearest.dx, 0);
    EXPECT_EQ(nearest.dy, 0);
    EXPECT_EQ(nearest.distance, 0);
  }
}

TEST(ValleyMap, WithoutPointsOrWithoutAPlaceFindsNothing) {
  EXPECT_FALSE(ValleyMap({}, 240, 5).nearest(0, 0).found);
  const ValleyMap map(circleOf(200), 240, 5);
  for (const double bad : {std::nan(""), HUGE_VAL, -HUGE_VAL, 1e300})
    EXPECT_FALSE(map.nearest(bad, 0).found);
}

TEST(ValleyMap, RefusesWhatIsNone) {
  EXPECT_THROW(ValleyMap({}, 0, 5), Error);
  EXPECT_THROW(ValleyMap({}, 240, 0), Error);
  EXPECT_THROW(ValleyMap({}, 240, -1), Error);
  EXPECT_THROW(ValleyMap({}, std::nan(""), 5), Error);
  EXPECT_THROW(ValleyMap({}, 240, HUGE_VAL), Error);
  EXPECT_THROW(ValleyMap({{std::nan(""), 0, 0, 0, 2}}, 240, 5), Error);
  EXPECT_THROW(ValleyMap({{0, 0, 2, 0, 2}}, 240, 5), Error);
  EXPECT_THROW(ValleyMap({{0, 0, std::nan(""), 0, 2}}, 240, 5), Error);
  EXPECT_THROW(ValleyMap({{0, 0, 1, 0, HUGE_VAL}}, 240, 5), Error);
}

}  // namespace
}  // namespace palpa::haptics
