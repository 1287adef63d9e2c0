#include "anatomy/query/needle_passes.h"

#include <gtest/gtest.h>

#include "test_shapes.h"
#include "tests/support/allocation_guard.h"

namespace palpa::anatomy {
namespace {

constexpr double kOnionCell = 0.002;
/// A chord of an edge e sags by e^2 / 8 R, an edge is at most 2.5 cells.
double onionSag(double radius) { return 6.25 * kOnionCell * kOnionCell / (8 * radius); }

/// Spheres about the origin, one in the other: skin 50 mm, muscle 40 mm, lung 30 mm.
Patient onion() {
  Patient patient;
  for (const auto& [organ, radius] :
       {std::pair(Organ::muscle, 0.04), {Organ::skin, 0.05}, {Organ::lung, 0.03}})
    patient.organs.push_back({name(organ), organ, sphereMesh(radius, kOnionCell), {1, 1, 1, 1}});
  return patient;
}

TEST(Needle, MeetsTheLayersFromOutsideIn) {
  const SurfaceQuery query(onion());
  NeedlePasses passes;
  query.needle({-0.08, 0, 0}, {0.01, 0, 0}, &passes);
  ASSERT_EQ(passes.count, 3);
  EXPECT_FALSE(passes.lost);
  const std::array<Organ, 3> order{Organ::skin, Organ::muscle, Organ::lung};
  for (int i = 0; i < 3; ++i) {
    const NeedlePass& pass = passes.pass[i];
    const double radius = 0.05 - 0.01 * i;
    EXPECT_EQ(pass.organ, order[i]);
    EXPECT_NEAR(pass.enter, 0.08 - radius, onionSag(radius));
    EXPECT_DOUBLE_EQ(pass.leave, 0.09);
    EXPECT_TRUE(pass.ends_inside && !pass.starts_inside);
    EXPECT_LT(pass.n_enter_A.x(), -0.99);
    EXPECT_NEAR(passes.depth(order[i]), 0.01 + radius, onionSag(radius));
  }
  EXPECT_EQ(passes.depth(Organ::vein), 0);
}

TEST(Needle, ThatGoesThroughLeavesInTheOppositeOrder) {
  const SurfaceQuery query(onion());
  NeedlePasses passes;
  query.needle({-0.08, 0, 0}, {0.08, 0, 0}, &passes);
  ASSERT_EQ(passes.count, 3);
  for (int i = 0; i < 3; ++i) {
    const double radius = 0.05 - 0.01 * i;
    EXPECT_NEAR(passes.pass[i].length(), 2 * radius, 2 * onionSag(radius));
    EXPECT_GT(passes.pass[i].n_leave_A.x(), 0.99);
    EXPECT_FALSE(passes.pass[i].ends_inside);
  }
}

TEST(Needle, ThatLiesInsideFromEndToEndSaysSo) {
  const SurfaceQuery query(onion());
  NeedlePasses passes;
  query.needle({-0.035, 0, 0}, {-0.033, 0, 0}, &passes);
  ASSERT_EQ(passes.count, 2);  // in skin and muscle, short of the lung
  for (const NeedlePass& pass : passes) {
    EXPECT_TRUE(pass.starts_inside && pass.ends_inside);
    EXPECT_EQ(pass.enter, 0);
    EXPECT_DOUBLE_EQ(pass.leave, 0.002);
    EXPECT_NE(pass.organ, Organ::lung);
  }
  query.needle({0.06, 0, 0}, {0.09, 0, 0}, &passes);
  EXPECT_EQ(passes.count, 0);
  query.needle({0, 0, 0}, {0, 0, 0}, &passes);
  EXPECT_EQ(passes.count, 0);
}

TEST(Needle, StretchesAgreeWithInsideAskedPointByPoint) {
  const Patient& patient = referencePatient();
  const SurfaceQuery query(patient);
  const Vec3 centre = patient.landmark(landmark::kVeinTarget);
  RandomStream random = RandomStream::ofSeed(21);
  int met = 0;
  for (int i = 0; i < 40; ++i) {
    const Vec3 start = centre + randomIn(random, 0.12), tip = centre + randomIn(random, 0.03);
    NeedlePasses passes;
    query.needle(start, tip, &passes);
    for (int k = 1; k < passes.count; ++k)
      EXPECT_LE(passes.pass[k - 1].enter, passes.pass[k].enter);
    for (int j = 0; j <= 50; ++j) {
      const double s = passes.length * j / 50;
      const Vec3 p = start + (tip - start) * j / 50;
      for (int surface = 0; surface < query.surfaces(); ++surface) {
        if (std::abs(query.closest(surface, p).distance) < 1e-7) continue;
        const bool listed = std::any_of(passes.begin(), passes.end(), [&](const NeedlePass& pass) {
          return pass.surface == surface && pass.enter <= s && s <= pass.leave + 1e-12;
        });
        EXPECT_EQ(listed, query.inside(surface, p)) << patient.organs[surface].id;
        met += listed;
      }
    }
  }
  EXPECT_GT(met, 500);
}

TEST(Needle, RoomIsFixedAndWhatDoesNotFitIsTold) {
  Patient patient;
  for (int i = 0; i < NeedlePasses::kMost + 5; ++i) {
    TriangleMesh ball = sphereMesh(0.004, 0.002);
    for (Vec3& p : ball.points) p.x() += 0.01 * i;
    patient.organs.push_back({std::to_string(i), Organ::rib, ball, {1, 1, 1, 1}});
  }
  const SurfaceQuery query(patient);
  NeedlePasses passes;
  query.needle({-0.1, 1e-4, 1e-4}, {2, 1e-4, 1e-4}, &passes);
  EXPECT_EQ(passes.count, NeedlePasses::kMost);
  EXPECT_TRUE(passes.lost);
}

TEST(GeometricQueries, AllocateNothing) {
  const Patient& patient = referencePatient();
  const SurfaceQuery query(patient);
  const Vec3 entry = patient.landmark(landmark::kEntry),
             target = patient.landmark(landmark::kVeinTarget);
  NeedlePasses passes;
  std::array<NearMiss, 64> misses;
  SurfaceQuery::Tube tube;
  double sum = 0;
  int used = 0;
  {
    NoAllocation guard;
    for (int i = 0; i < query.surfaces(); ++i) {
      sum += query.curved(i, entry).curvature.k1 + query.rounded(i, target).distance;
      sum += query.inside(i, target) + query.tangentPlane(i, target, 0.02).rms;
      sum += query.fitTube(i, target, 0.02, &tube);
    }
    query.needle(entry + 2 * (entry - target), target, &passes);
    used = query.nearMisses(target, entry, misses);
    EXPECT_EQ(guard.allocations(), 0);
  }
  EXPECT_TRUE(std::isfinite(sum));
  EXPECT_GE(passes.count, 2);
  EXPECT_EQ(used, query.surfaces());
}

}  // namespace
}  // namespace palpa::anatomy
