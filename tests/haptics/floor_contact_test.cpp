#include "haptics/contact/probe_contact.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "tests/surface/surface_bench.h"

namespace palpa::haptics {
namespace {

constexpr double kFloorUnit = 60e-6, kAnyStiffness = 1e9;  // m; N/m
constexpr double kFloorK = 5250, kFloorB = 20;             // N/m, N s/m

/// A place of the surface and its outward normal, by hand. What lies straight under it is nearest
/// to it.
struct FloorSpot {
  const char* name;
  Vec3 c_U, n;
};

/// Across a groove, at the angle `turn` on the arc of its bottom from the deepest line outward;
/// `around`: of the element.
FloorSpot grooveBottom(const SearchSurface& floor, double around, double turn) {
  const Vec3 out(std::cos(around), std::sin(around), 0),
      middle(floor.middle(1)[0], floor.middle(1)[1], 0);
  return {"groove's bottom",
          middle + (30 + 2 * std::sin(turn)) * out - 2 * std::cos(turn) * Vec3::UnitZ(),
          std::cos(turn) * Vec3::UnitZ() - std::sin(turn) * out};
}

/// Half way up the outer flank, which is straight.
FloorSpot grooveFlank(const SearchSurface& floor, double around) {
  const TroughProfile& groove = floor.groove();
  const double t = groove.angle(), s = groove.bottomJoint() + 0.5 * groove.flank() * std::cos(t),
               z = -2 + 2 * (1 - std::cos(t)) + 0.5 * groove.flank() * std::sin(t);
  const Vec3 out(std::cos(around), std::sin(around), 0),
      middle(floor.middle(1)[0], floor.middle(1)[1], 0);
  return {"groove's flank", middle + (30 + s) * out + z * Vec3::UnitZ(),
          std::cos(t) * Vec3::UnitZ() - std::sin(t) * out};
}

/// On the first of the target's hemispheres that is bare at that side.
FloorSpot bumpSide(const SearchSurface& floor, double around) {
  const int target = floor.stimulus().target;
  const Vec3 n = Vec3(std::cos(around), std::sin(around), 2).normalized(),
             middle(floor.middle(target)[0], floor.middle(target)[1], 0);
  for (const BumpPattern::Bump& bump : floor.texture(target).bumps()) {
    const Vec3 c = middle + Vec3(bump.x, bump.y, 0) + 2 * n;
    if (plainDepth(floor, c + 0.3 * n) <= 0 && plainDepth(floor, c) < 1e-9) return {"bump", c, n};
  }
  ADD_FAILURE() << "no bump is bare";
  return {};
}

std::vector<FloorSpot> floorSpots(const SearchSurface& floor) {
  return {{"floor", {3, -4, 0}, Vec3::UnitZ()},
          {"wall", {120, 7, 4}, -Vec3::UnitX()},
          {"other wall", {-30, -120, 9}, Vec3::UnitY()},
          grooveBottom(floor, 1, 0),
          grooveBottom(floor, 2, 0.4),
          grooveBottom(floor, 5, -0.4),
          grooveFlank(floor, 3),
          bumpSide(floor, 0.3),
          bumpSide(floor, 4)};
}

FloorTouch touchAt(const SearchSurface& floor, const Vec3& p_U, const Vec3& v_F = Vec3::Zero(),
                   double stiffest = kAnyStiffness) {
  return touchFloor(floor, {kFloorK, kFloorB}, stiffest, kFloorUnit, kFloorUnit * p_U, v_F);
}

TEST(FloorContact, IsASpringAndADamperTowardTheClosestFreePoint) {
  const SearchSurface floor = searchFloor(21);
  Draws draw(91);
  for (const FloorSpot& spot : floorSpots(floor))
    for (const double deep : {0.05, 0.3, 0.7}) {
      const Vec3 v = 0.3e-3 * Vec3(draw.from(-1, 1), draw.from(-1, 1), draw.from(-1, 1));
      const FloorTouch touch = touchAt(floor, spot.c_U - deep * spot.n, v);
      const double push = kFloorK * deep * kFloorUnit - kFloorB * v.dot(spot.n);
      ASSERT_GT(push, 0);
      EXPECT_TRUE(touch.touching) << spot.name;
      EXPECT_NEAR(touch.penetration, deep * kFloorUnit, 1e-12) << spot.name;
      EXPECT_LT((touch.f_F - push * spot.n).norm(), 1e-8) << spot.name << ' ' << deep;
    }
}

TEST(FloorContact, NeverPulls) {
  const SearchSurface floor = searchFloor(21);
  for (const FloorSpot& spot : floorSpots(floor)) {
    const double holds = kFloorK * 0.3 * kFloorUnit /
                         kFloorB;  // m/s: leaving so fast, the damper takes all of the spring
    EXPECT_GT(touchAt(floor, spot.c_U - 0.3 * spot.n, 0.99 * holds * spot.n).f_F.dot(spot.n), 0)
        << spot.name;
    for (const double times : {1.01, 3.0, 1000.0})
      EXPECT_EQ(touchAt(floor, spot.c_U - 0.3 * spot.n, times * holds * spot.n).f_F,
                Vec3(Vec3::Zero()))
          << spot.name;
  }
}

TEST(FloorContact, HasNoFriction) {
  const SearchSurface floor = searchFloor(21);
  for (const FloorSpot& spot : floorSpots(floor)) {
    const Vec3 p = spot.c_U - 0.3 * spot.n, along = spot.n.unitOrthogonal(),
               across = spot.n.cross(along);
    const Vec3 still = touchAt(floor, p).f_F;
    EXPECT_LT((still - still.dot(spot.n) * spot.n).norm(), 1e-9) << spot.name;
    for (const Vec3& way : {along, across, Vec3(-along - across)})
      EXPECT_LT((touchAt(floor, p, 0.3 * way).f_F - still).norm(), 1e-8)
          << spot.name;  // N, of 6 N a damper that acts along would give
  }
}

TEST(FloorContact, IsNoStifferThanTheCoupling) {
  const SearchSurface floor = searchFloor(21);
  for (const FloorSpot& spot : floorSpots(floor)) {
    const Vec3 p = spot.c_U - 0.5 * spot.n;
    EXPECT_NEAR(touchAt(floor, p, Vec3::Zero(), 1000).f_F.norm(), 1000 * 0.5 * kFloorUnit, 1e-9)
        << spot.name;
    EXPECT_NEAR(touchAt(floor, p, Vec3::Zero(), 9000).f_F.norm(), kFloorK * 0.5 * kFloorUnit, 1e-9)
        << spot.name;
  }
}

TEST(FloorContact, InTheFreeThereIsNone) {
  const SearchSurface floor = searchFloor(21);
  for (const FloorSpot& spot : floorSpots(floor)) {
    const FloorTouch touch = touchAt(floor, spot.c_U + 0.01 * spot.n, -1.0 * spot.n);
    EXPECT_FALSE(touch.touching) << spot.name;
    EXPECT_EQ(touch.penetration, 0);
    EXPECT_EQ(touch.f_F, Vec3(Vec3::Zero()));
  }
}

TEST(FloorContact, ThePlaceIsTold) {
  const SearchSurface floor = searchFloor(21);
  const auto bitsAt = [&](int element, double r, double z) {
    const double x = element < 0 ? 0 : floor.middle(element)[0] + r,
                 y = element < 0 ? 0 : floor.middle(element)[1];
    return static_cast<int>(placeBits(touchAt(floor, {x, y, z})));
  };
  EXPECT_EQ(placeBits(FloorTouch{}), 0);
  for (const double z : {5.0, -3.0}) {
    const int touching = z < 0 ? kPlaceTouching : 0;
    EXPECT_EQ(bitsAt(-1, 0, z), touching);
    for (int e = 0; e < 3; ++e) {
      EXPECT_EQ(bitsAt(e, 0, z), (e + 1) | kPlacePit | touching);
      EXPECT_EQ(bitsAt(e, 15, z), (e + 1) | kPlaceTexture | touching);
      EXPECT_EQ(bitsAt(e, 30, z), (e + 1) | touching);
      EXPECT_EQ(bitsAt(e, 15, z) & kPlaceElement, e + 1);
    }
  }
}

}  // namespace
}  // namespace palpa::haptics
