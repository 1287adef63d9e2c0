#include <gtest/gtest.h>

#include <limits>

#include "anatomy/query/surface_query.h"
#include "anatomy/query/triangle_distance.h"
#include "anatomy/query/triangle_tree.h"
#include "test_shapes.h"
#include "tests/support/counts.h"

namespace palpa::anatomy {
namespace {

/// Unconnected triangles of every size and shape, thin ones too, about a point away from the
/// origin.
TriangleMesh triangleSoup(RandomStream& random, int count) {
  TriangleMesh mesh;
  for (int i = 0; i < count; ++i) {
    const Vec3 middle = Vec3(0.3, -0.2, 0.1) + randomIn(random, 0.05);
    const double size = std::pow(10, -4 + 3 * random.openUniform());
    for (int k = 0; k < 3; ++k) {
      mesh.points.push_back(middle + randomIn(random, size));
      mesh.normals.push_back(Vec3::UnitZ());
    }
    const auto at = static_cast<std::uint32_t>(3 * i);
    mesh.triangles.push_back({at, at + 1, at + 2});
  }
  return mesh;
}

std::array<Vec3, 3> cornersOf(const TriangleMesh& mesh, std::size_t i) {
  const auto& t = mesh.triangles[i];
  return {mesh.points[t[0]], mesh.points[t[1]], mesh.points[t[2]]};
}

/// Segment against triangle by nested golden sections over the segment: convex, and nothing shared
/// with the exact one but the point-triangle distance.
double searched(const Vec3& a, const Vec3& b, const std::array<Vec3, 3>& t) {
  const auto at = [&](double s) {
    const Vec3 p = a + s * (b - a), w = closestWeights(p, t[0], t[1], t[2]);
    return (p - w[0] * t[0] - w[1] * t[1] - w[2] * t[2]).norm();
  };
  double low = 0, high = 1;
  for (int i = 0; i < 80; ++i) {
    const double third = (high - low) / 3;
    (at(low + third) < at(high - third) ? high : low) =
        at(low + third) < at(high - third) ? high - third : low + third;
  }
  return at(0.5 * (low + high));
}

TEST(SegmentDistance, ToATriangleIsTheLeastOverTheSegment) {
  RandomStream random = RandomStream::ofSeed(11);
  for (int i = 0; i < test::counted(3000, 100'000); ++i) {
    const std::array<Vec3, 3> t{randomIn(random, 1), randomIn(random, 1), randomIn(random, 1)};
    const Vec3 a = randomIn(random, 2), b = i % 10 == 0 ? a : randomIn(random, 2);
    const SegmentToTriangle found = segmentToTriangle(a, b, t);
    EXPECT_NEAR(std::sqrt(found.squared), searched(a, b, t), 1e-7);
    const Vec3 on = a + found.s * (b - a);
    const Vec3 p = found.weights[0] * t[0] + found.weights[1] * t[1] + found.weights[2] * t[2];
    EXPECT_NEAR((on - p).norm(), std::sqrt(found.squared), 1e-7);
    EXPECT_GE(found.weights.minCoeff(), 0);
  }
}

TEST(SegmentDistance, OfAMeshIsThatOfEveryTriangleTried) {
  RandomStream random = RandomStream::ofSeed(12);
  for (int round = 0; round < test::counted(8, 200); ++round) {
    const TriangleMesh mesh = triangleSoup(random, 1 + 90 * round);
    const TriangleTree tree(mesh);
    for (int i = 0; i < 60; ++i) {
      const double reach = std::pow(10, -3 + 3 * random.openUniform());
      const Vec3 a = Vec3(0.3, -0.2, 0.1) + randomIn(random, reach),
                 b = a + randomIn(random, i % 4 ? reach : 1e-9);
      double least = std::numeric_limits<double>::infinity(), least_point = least;
      for (std::size_t k = 0; k < mesh.triangles.size(); ++k) {
        const std::array<Vec3, 3> t = cornersOf(mesh, k);
        least = std::min(least, segmentToTriangle(a, b, t).squared);
        const Vec3 w = closestWeights(a, t[0], t[1], t[2]);
        least_point =
            std::min(least_point, (a - w[0] * t[0] - w[1] * t[1] - w[2] * t[2]).squaredNorm());
      }
      const TriangleTree::SegmentDistance found = tree.nearSegment(a, b);
      EXPECT_EQ(std::abs(found.signed_distance), std::sqrt(least));
      EXPECT_NEAR((a + found.s * (b - a) - found.p).norm(), std::sqrt(least), 1e-9);
      EXPECT_NEAR(std::abs(tree.closest(a).signed_distance), std::sqrt(least_point), 1e-15);
    }
  }
}

TEST(SegmentDistance, OfASphereIsTheClosedForm) {
  constexpr double kBall = 0.05, kBallCell = 0.002,
                   kBallSag = 6.25 * kBallCell * kBallCell / (8 * kBall);
  const SurfaceQuery query(patientOf(sphereMesh(kBall, kBallCell), Organ::lung));
  RandomStream random = RandomStream::ofSeed(13);
  int outside = 0, through = 0, within = 0;
  for (int i = 0; i < 1500; ++i) {
    const Vec3 a = randomIn(random, 0.09), b = a + randomIn(random, i % 2 ? 0.1 : 0.01);
    const double t = std::clamp(-a.dot(b - a) / (b - a).squaredNorm(), 0.0, 1.0);
    const double near = (a + t * (b - a)).norm(), far = std::max(a.norm(), b.norm());
    double s = -1;
    const SurfacePoint found = query.nearSegment(0, a, b, &s);
    if (near > kBall + kBallSag) {
      EXPECT_NEAR(found.distance, near - kBall, kBallSag);
      ++outside;
    } else if (far < kBall - kBallSag) {
      EXPECT_NEAR(found.distance, far - kBall, kBallSag);
      ++within;
    } else if (near < kBall - kBallSag && far > kBall + kBallSag) {
      EXPECT_EQ(found.distance, 0);
      EXPECT_NEAR(found.p_A.norm(), kBall, kBallSag);
      ++through;
    }
    EXPECT_NEAR((a + s * (b - a) - found.p_A).norm(), std::abs(found.distance), 1e-12);
  }
  EXPECT_GT(outside, 100);
  EXPECT_GT(through, 100);
  EXPECT_GT(within, 50);
}

TEST(NearMiss, TellsTipAndShaftApartForEveryOrgan) {
  const Patient& patient = referencePatient();
  const SurfaceQuery query(patient);
  const Vec3 tip = patient.landmark(landmark::kVeinTarget);
  const Vec3 back = tip + 2 * (patient.landmark(landmark::kEntry) - tip);
  std::vector<NearMiss> misses(patient.organs.size() + 3);
  ASSERT_EQ(query.nearMisses(tip, back, misses), static_cast<int>(patient.organs.size()));
  for (int i = 0; i < query.surfaces(); ++i) {
    EXPECT_EQ(misses[i].organ, patient.organs[i].organ);
    EXPECT_EQ(misses[i].tip, query.closest(i, tip).distance);
    double sampled = std::numeric_limits<double>::infinity();
    for (int k = 0; k <= 2000; ++k)
      sampled =
          std::min(sampled, std::abs(query.closest(i, tip + (back - tip) * k / 2000).distance));
    EXPECT_LE(std::abs(misses[i].shaft), sampled + 1e-12);
    EXPECT_GE(std::abs(misses[i].shaft), sampled - (back - tip).norm() / 4000);
  }
}

TEST(NearMiss, WritesNoMoreThanThereIsRoom) {
  const SurfaceQuery query(referencePatient());
  std::array<NearMiss, 2> misses;
  EXPECT_EQ(query.nearMisses(Vec3::Zero(), Vec3::UnitZ(), misses), 2);
}

}  // namespace
}  // namespace palpa::anatomy
