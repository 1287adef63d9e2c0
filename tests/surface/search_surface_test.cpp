#include "haptics/surface/search_surface.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

#include "anatomy/base/error.h"
#include "tests/surface/surface_bench.h"

namespace palpa::haptics {
namespace {

constexpr double kThird = 2.0943951023931953;

TEST(SearchSurface, ElementsAreEquallySpacedOnTheirCircle) {
  for (const double orientation : {0.0, 0.7, -2.0, 5.0}) {
    const SearchSurface floor = searchFloor(1, {orientation, 0});
    for (int e = 0; e < 3; ++e) {
      const auto [x, y] = floor.middle(e);
      const auto [nx, ny] = floor.middle((e + 1) % 3);
      EXPECT_NEAR(std::hypot(x, y), 200.0 / 3, 1e-12);
      EXPECT_NEAR(std::hypot(nx - x, ny - y), 200.0 / std::sqrt(3.0), 1e-12);
      EXPECT_NEAR(x, 200.0 / 3 * std::cos(orientation + e * kThird), 1e-12);
      EXPECT_NEAR(y, 200.0 / 3 * std::sin(orientation + e * kThird), 1e-12);
    }
  }
}

TEST(SearchSurface, OneElementHasTheTargetsTextureTheOthersAreAlike) {
  for (int target = 0; target < 3; ++target) {
    const SearchSurface floor = searchFloor(4, {0, target});
    for (int e = 0; e < 3; ++e) EXPECT_EQ(floor.texture(e).spec().radius, e == target ? 2 : 1);
    EXPECT_EQ(&floor.texture((target + 1) % 3), &floor.texture((target + 2) % 3));
  }
}

TEST(SearchSurface, SameSeedSameStimulusOtherSeedAnother) {
  const SearchSurface one = searchFloor(5), same = searchFloor(5), other = searchFloor(6);
  Draws draw(71);
  int differs = 0;
  for (int n = 0; n < 20000; ++n) {
    const double x = draw.from(-120, 120), y = draw.from(-120, 120);
    ASSERT_EQ(one.height(x, y), same.height(x, y));
    differs += one.height(x, y) != other.height(x, y);
  }
  EXPECT_GT(differs, 500);
}

/// The target's bumps come first: what a distractor needs does not change them.
TEST(SearchSurface, TheTargetIsDrawnFirst) {
  Draws draw(8);
  const BumpPattern target(SearchSpec{}.target, [&] { return draw(); });
  const SearchSurface floor(SearchSpec{}, {0, 2}, evenly(8));
  ASSERT_EQ(floor.texture(2).bumps().size(), target.bumps().size());
  for (std::size_t k = 0; k < target.bumps().size(); ++k)
    EXPECT_EQ(floor.texture(2).bumps()[k].x, target.bumps()[k].x);
}

TEST(SearchSurface, HeightAlongARadius) {
  const SearchSurface floor = searchFloor(2);
  for (int e = 0; e < 3; ++e) {
    const auto [mx, my] = floor.middle(e);
    for (const double angle : {0.3, 2.1, 4.4}) {
      const auto at = [&, mx = mx, my = my](double r) {
        return floor.smoothHeight(mx + r * std::cos(angle), my + r * std::sin(angle));
      };
      EXPECT_NEAR(at(0), -1, 1e-12);
      EXPECT_NEAR(at(30), -2, 1e-12);
      EXPECT_NEAR(at(30 + 2.7), at(30 - 2.7), 1e-12);
      EXPECT_LT(at(4.99), 0);
      for (const double level : {5.01, 12.0, 24.99, 35.01, 40.0}) EXPECT_EQ(at(level), 0) << level;
      EXPECT_LT(at(25.01), 0);
      EXPECT_LT(at(34.99), 0);
    }
  }
  EXPECT_EQ(floor.height(0, 0), 0);
  EXPECT_EQ(floor.height(119, -119), 0);
}

TEST(SearchSurface, HeightIsThatOfPlainLoops) {
  const SearchSurface floor = searchFloor(3);
  Draws draw(72);
  for (int n = 0; n < 20000; ++n) {
    const double x = draw.from(-120, 120), y = draw.from(-120, 120);
    ASSERT_NEAR(floor.height(x, y), plainHeight(floor, x, y), 1e-7);
  }
}

TEST(SearchSurface, PlaceSaysWhatIsThere) {
  const SearchSurface floor = searchFloor(3);
  for (int e = 0; e < 3; ++e) {
    const auto [mx, my] = floor.middle(e);
    for (const double angle : {0.0, 1.0, 3.5})
      for (const double r : {0.0, 4.999, 5.001, 15.0, 24.999, 25.001, 34.999, 35.001, 44.0}) {
        const SearchSurface::Place place =
            floor.place(mx + r * std::cos(angle), my + r * std::sin(angle));
        EXPECT_EQ(place.element, r < 35 ? e : -1) << r;
        EXPECT_EQ(place.pit, r < 5) << r;
        EXPECT_EQ(place.texture, r > 5 && r < 25) << r;
        if (place.element < 0) continue;
        EXPECT_NEAR(place.x, r * std::cos(angle), 1e-12);
        EXPECT_NEAR(place.y, r * std::sin(angle), 1e-12);
      }
  }
  EXPECT_EQ(floor.place(0, 0).element, -1);
  EXPECT_EQ(floor.place(std::nan(""), 0).element, -1);
}

/// Farther than 0.05 U from every footprint's edge, from every place where two hemispheres are
/// equally high: there the height has a gradient.
bool smoothThere(const BumpPattern& pattern, double x, double y) {
  double nearest = 1e9, next = 1e9;
  for (const BumpPattern::Bump& b : pattern.bumps()) {
    const double d = std::hypot(x - b.x, y - b.y);
    if (std::abs(d - pattern.spec().radius) < 0.05) return false;
    next = std::min(next, std::max(d, nearest));
    nearest = std::min(nearest, d);
  }
  return nearest > pattern.spec().radius || next - nearest > 0.05;
}

TEST(SearchSurface, NormalIsTheGradientOfHeight) {
  const SearchSurface floor = searchFloor(9);
  const double h = 1e-5;
  Draws draw(73);
  std::array<int, 4> seen{};  // on hemispheres, in pits, in grooves, level
  for (int n = 0; n < 20000; ++n) {
    const int e = n % 3;
    const auto [mx, my] = floor.middle(e);
    const double r = 36 * std::sqrt(draw()), angle = draw.from(0, 7), x = r * std::cos(angle),
                 y = r * std::sin(angle);
    if (!smoothThere(floor.texture(e), x, y)) continue;
    const auto at = [&, mx = mx, my = my](double dx, double dy) {
      return floor.height(mx + x + dx, my + y + dy);
    };
    const Vec3 gradient((at(h, 0) - at(-h, 0)) / (2 * h), (at(0, h) - at(0, -h)) / (2 * h), 0),
        normal = floor.normal(mx + x, my + y);
    EXPECT_LT((normal - (Vec3::UnitZ() - gradient).normalized()).norm(), 1e-5) << r << " " << angle;
    EXPECT_NEAR(normal.norm(), 1, 1e-12);
    ++seen[r < 5 ? 1u : r > 25 ? 2u : at(0, 0) > 0 ? 0u : 3u];
  }
  for (const int count : seen) EXPECT_GT(count, 200);
  for (int e = 0; e < 3; ++e)
    EXPECT_EQ(floor.normal(floor.middle(e)[0], floor.middle(e)[1]), Vec3::UnitZ());
}

TEST(SearchSurface, AtAnEdgeTheNormalIsTheHemispheres) {
  const SearchSurface floor = searchFloor(10);
  const int e = floor.stimulus().target;
  const BumpPattern::Bump b = floor.texture(e).bumps()[0];
  const double x = floor.middle(e)[0] + b.x, y = floor.middle(e)[1] + b.y;
  EXPECT_LT((floor.normal(x + 2 - 1e-12, y) - Vec3::UnitX()).norm(), 1e-5);
  EXPECT_LT((floor.normal(x, y) - Vec3::UnitZ()).norm(), 1e-12);
}

/// As BumpPattern::entered, but in F, with ways that lead from one element to another or pass them
/// all.
TEST(SearchSurface, CrossingABumpIsSteppingIntoAFootprint) {
  const SearchSurface floor = searchFloor(11);
  Draws draw(74);
  for (const double length : {0.05, 0.5, 2.0, 7.0, 20.0, 120.0}) {
    int in = 0, out = 0;
    for (int n = 0; n < (length > 50 ? 25 : 80); ++n) {
      const auto [mx, my] = floor.middle(n % 3);
      const double r = 36 * std::sqrt(draw()), around = draw.from(0, 7), angle = draw.from(0, 7);
      const double ax = mx + r * std::cos(around), ay = my + r * std::sin(around),
                   dx = length * std::cos(angle), dy = length * std::sin(angle);
      bool entered = false, grazed = false;
      for (int e = 0; e < 3 && !entered; ++e)
        for (const BumpPattern::Bump& b : floor.texture(e).bumps()) {
          const double bx = floor.middle(e)[0] + b.x, by = floor.middle(e)[1] + b.y,
                       radius = floor.texture(e).spec().radius;
          if (std::hypot(ax - bx, ay - by) < radius ||
              std::hypot(ax - bx, ay - by) > length + radius + 0.01)
            continue;
          double nearest = 1e9;
          const int steps = 2000;
          for (int k = 1; k <= steps; ++k)
            nearest =
                std::min(nearest, std::hypot(ax + k * dx / steps - bx, ay + k * dy / steps - by));
          entered = entered || nearest < radius;
          grazed = grazed || (nearest >= radius &&
                              nearest < radius + 1e-3);  // 120 U in 2000 steps: 4.5e-4 of sagitta
        }
      if (grazed && !entered) continue;
      EXPECT_EQ(floor.crossesBump(ax, ay, ax + dx, ay + dy), entered)
          << length << ": " << ax << " " << ay;
      ++(entered ? in : out);
    }
    EXPECT_TRUE(length < 1 || in > 10) << length;
    EXPECT_TRUE(length > 10 || out > 10) << length;
  }
}

/// Slow ways and fast ones, within an element, from one to another and past them all.
TEST(SearchSurface, TheBumpOnAWayIsTheOneAtItsEndOrElseOneItEnters) {
  const SearchSurface floor = searchFloor(12);
  Draws draw(75);
  for (const double length : {0.0, 0.02, 0.4, 2.0, 7.0, 20.0, 120.0}) {
    int low = 0, high = 0, none = 0;
    for (int n = 0; n < 1500; ++n) {
      const auto [mx, my] = floor.middle(n % 3);
      const double r = 36 * std::sqrt(draw()), around = draw.from(0, 7), angle = draw.from(0, 7);
      const double ax = mx + r * std::cos(around), ay = my + r * std::sin(around),
                   bx = ax + length * std::cos(angle), by = ay + length * std::sin(angle);
      const WayOverBumps way = plainWay(floor, ax, ay, bx, by);
      if (way.unsure) continue;
      const double told = floor.bumpOnWay(ax, ay, bx, by);
      if (way.heights.empty()) {
        EXPECT_EQ(told, 0) << length << ": " << ax << " " << ay;
      } else {
        EXPECT_TRUE(std::count(way.heights.begin(), way.heights.end(), told) > 0)
            << length << ": " << ax << " " << ay << " " << told;
      }
      ++(told > 1 ? high : told > 0 ? low : none);
    }
    EXPECT_GT(low, 20) << length;
    EXPECT_GT(high, 20) << length;
    EXPECT_GT(none, 20) << length;
  }
}

TEST(SearchSurface, NoBumpIsOnAWayElsewhere) {
  const SearchSurface floor = searchFloor(12);
  Draws draw(76);
  for (int n = 0; n < 2000; ++n) {
    const auto [mx, my] = floor.middle(n % 3);
    const double angle = draw.from(0, 7), turn = draw.from(-0.5, 0.5), in = draw.from(0, 5),
                 out = draw.from(
                     29, 36);  // in the pit; round the groove: the chord stays 28 from the middle
    EXPECT_EQ(floor.bumpOnWay(mx, my, mx + in * std::cos(angle), my + in * std::sin(angle)), 0)
        << in;
    EXPECT_EQ(floor.bumpOnWay(mx + out * std::cos(angle), my + out * std::sin(angle),
                              mx + out * std::cos(angle + turn), my + out * std::sin(angle + turn)),
              0)
        << out;
  }
  EXPECT_EQ(floor.bumpOnWay(-20, -20, 20, 20), 0);
}

TEST(SearchSurface, RefusesFiguresThatDoNotFit) {
  const auto floor = [](const auto& change) {
    SearchSpec spec;
    SearchStimulus stimulus;
    change(spec, stimulus);
    SearchSurface made(spec, stimulus, evenly(1));
  };
  EXPECT_NO_THROW(floor([](auto&, auto&) {}));
  EXPECT_THROW(floor([](auto& s, auto&) { s.side = 203; }), Error);
  EXPECT_THROW(floor([](auto& s, auto&) { s.circle = 40; }), Error) << "they would overlap";
  EXPECT_THROW(floor([](auto& s, auto&) { s.groove = 29; }), Error);
  EXPECT_THROW(floor([](auto& s, auto&) { s.disc = 4; }), Error);
  EXPECT_THROW(floor([](auto& s, auto&) { s.pit = 2; }), Error) << "no arcs fit";
  EXPECT_THROW(floor([](auto& s, auto&) { s.groove_depth = -2; }), Error);
  EXPECT_THROW(floor([](auto& s, auto&) { s.target.outer = 26; }), Error);
  EXPECT_THROW(floor([](auto& s, auto&) { s.distractor.inner = 4; }), Error);
  EXPECT_THROW(floor([](auto& s, auto&) { s.target.radius = 0; }), Error);
  EXPECT_THROW(floor([](auto&, auto& t) { t.target = 3; }), Error);
  EXPECT_THROW(floor([](auto&, auto& t) { t.target = -1; }), Error);
  EXPECT_THROW(floor([](auto&, auto& t) { t.orientation = std::nan(""); }), Error);
  for (double SearchSpec::*length :
       {&SearchSpec::side, &SearchSpec::circle, &SearchSpec::disc, &SearchSpec::groove,
        &SearchSpec::groove_half_width, &SearchSpec::groove_depth, &SearchSpec::pit,
        &SearchSpec::pit_depth})
    EXPECT_THROW(floor([length](auto& s, auto&) { s.*length = std::nan(""); }), Error);
}

}  // namespace
}  // namespace palpa::haptics
