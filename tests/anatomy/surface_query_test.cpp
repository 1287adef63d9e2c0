#include "anatomy/query/surface_query.h"

#include <gtest/gtest.h>

#include <limits>
#include <thread>

#include "anatomy/base/error.h"
#include "anatomy/query/triangle_distance.h"
#include "anatomy/query/triangle_tree.h"
#include "anatomy/shapes/mesh_tools.h"
#include "test_shapes.h"

namespace palpa::anatomy {
namespace {

constexpr double kRadius = 0.05, kCell = 0.002;
// Vertices lie on the sphere; a chord of an edge e sags by e^2 / 8 R, an edge is at most 2.5 cells.
constexpr double kSag = 6.25 * kCell * kCell / (8 * kRadius);

double segmentDistance(const Vec3& p, const Vec3& a, const Vec3& b) {
  const double t = std::clamp((p - a).dot(b - a) / (b - a).squaredNorm(), 0.0, 1.0);
  return (p - a - t * (b - a)).norm();
}

TEST(SurfaceQuery, SphereDistanceAndNormalAreTheClosedForm) {
  const SurfaceQuery query(patientOf(sphereMesh(kRadius, kCell), Organ::lung));
  RandomStream random = RandomStream::ofSeed(1);
  for (int i = 0; i < 2000; ++i) {
    const Vec3 p = randomIn(random, 0.08);
    const SurfacePoint found = query.closest(0, p);
    EXPECT_NEAR(found.distance, p.norm() - kRadius, kSag);
    if (p.norm() > 0.01) {
      EXPECT_GT(found.n_A.dot(p.normalized()), 1 - 1e-3);
    }  // edges see 0.05 rad
  }
}

TEST(SurfaceQuery, CapsuleDistanceIsTheClosedForm) {
  const Vec3 a(-0.03, 0.01, 0), b(0.04, -0.02, 0.03);
  const double radius = 0.006;
  const SurfaceQuery query(patientOf(capsuleMesh(a, b, radius, 80, 96), Organ::clavicle));
  RandomStream random = RandomStream::ofSeed(2);
  // Sagitta of a chord: r (1 - cos(pi / around)); the seven-ring caps sag by r (1 - cos(pi / 28)).
  const double tolerance = radius * (1 - std::cos(M_PI / 28)) * 1.5;
  for (int i = 0; i < 2000; ++i) {
    const Vec3 p = randomIn(random, 0.06);
    EXPECT_NEAR(query.closest(0, p).distance, segmentDistance(p, a, b) - radius, tolerance);
  }
}

TEST(SurfaceQuery, ClosestPointIsThatOfEveryTriangleTried) {
  const TriangleMesh& mesh = referencePatient().organ(Organ::clavicle).mesh;
  const TriangleTree tree(mesh);
  const Vec3 middle = referencePatient().landmark(landmark::kMedialThird);
  RandomStream random = RandomStream::ofSeed(3);
  for (int i = 0; i < 60; ++i) {
    const Vec3 p = middle + randomIn(random, 0.05);
    double least = std::numeric_limits<double>::infinity();
    for (const auto& t : mesh.triangles) {
      const Vec3 &a = mesh.points[t[0]], &b = mesh.points[t[1]], &c = mesh.points[t[2]];
      const Vec3 w = closestWeights(p, a, b, c);
      least = std::min(least, (p - (w[0] * a + w[1] * b + w[2] * c)).norm());
    }
    EXPECT_NEAR(std::abs(tree.closest(p).signed_distance), least, 1e-15);
  }
}

TEST(SurfaceQuery, SignIsRightAtEdgesAndCornersOfACube) {
  // A cube is the hard case: from outside near an edge the nearest face may look away.
  TriangleMesh cube;
  for (int i = 0; i < 8; ++i) cube.points.emplace_back(i & 1, i >> 1 & 1, i >> 2 & 1);
  cube.triangles = {{0, 2, 1}, {1, 2, 3}, {4, 5, 6}, {5, 7, 6}, {0, 1, 4}, {1, 5, 4},
                    {2, 6, 3}, {3, 6, 7}, {0, 4, 2}, {2, 4, 6}, {1, 3, 5}, {3, 7, 5}};
  ASSERT_TRUE(isClosed(cube));
  ASSERT_NEAR(signedVolume(cube), 1, 1e-12);
  computeNormals(&cube);
  const TriangleTree tree(cube);
  RandomStream random = RandomStream::ofSeed(4);
  for (int i = 0; i < 5000; ++i) {
    const Vec3 p = randomIn(random, 1) + Vec3::Constant(0.5);
    const Vec3 q = (p - Vec3::Constant(0.5)).cwiseAbs() - Vec3::Constant(0.5);
    const double exact = q.cwiseMax(0.0).norm() + std::min(q.maxCoeff(), 0.0);
    EXPECT_NEAR(tree.closest(p).signed_distance, exact, 1e-12);
  }
}

TEST(SurfaceQuery, RaysCrossASphereTwiceAtTheClosedForm) {
  const SurfaceQuery query(patientOf(sphereMesh(kRadius, kCell), Organ::lung));
  RandomStream random = RandomStream::ofSeed(5);
  int crossed = 0;
  for (int i = 0; i < 2000; ++i) {
    const Vec3 start = 0.1 * randomDirection(random);
    const Vec3 direction = (randomIn(random, 0.05) - start).normalized();
    const double along = -start.dot(direction);
    const double off = (start + along * direction).norm();
    const auto hits = query.cast(start, direction, 0.3);
    if (off > kRadius - 2 * kSag && off < kRadius + kSag) continue;  // grazes the polyhedron
    if (off >= kRadius) {
      EXPECT_TRUE(hits.empty());
      continue;
    }
    const double half = std::sqrt(kRadius * kRadius - off * off);
    ASSERT_EQ(hits.size(), 2u);
    EXPECT_TRUE(hits[0].entering);
    EXPECT_FALSE(hits[1].entering);
    const double tolerance = 2 * kSag * kRadius / half;  // the sag, seen at the ray's slant
    EXPECT_NEAR(hits[0].s, along - half, tolerance);
    EXPECT_NEAR(hits[1].s, along + half, tolerance);
    EXPECT_LT(hits[0].n_A.dot(direction), 0);
    EXPECT_GT(hits[1].n_A.dot(direction), 0);
    ++crossed;
  }
  EXPECT_GT(crossed, 500);
}

TEST(SurfaceQuery, ARayThroughVerticesAndEdgesCountsEachCrossingOnce) {
  const TriangleMesh mesh = sphereMesh(kRadius, kCell);
  const SurfaceQuery query(patientOf(mesh, Organ::lung));
  for (std::size_t i = 0; i < mesh.points.size(); i += 7) {
    const Vec3& p = mesh.points[i];
    EXPECT_EQ(query.cast(2 * p, -p.normalized(), 2 * p.norm()).size(), 1u) << "vertex " << i;
    const auto& t = mesh.triangles[i];
    const Vec3 edge = (mesh.points[t[0]] + mesh.points[t[1]]) / 2;
    EXPECT_EQ(query.cast(2 * edge, -edge.normalized(), 2 * edge.norm()).size(), 1u) << "edge " << i;
  }
}

TEST(SurfaceQuery, RaysAgreeWithEveryTriangleTried) {
  const Patient& patient = referencePatient();
  const SurfaceQuery query(patient);
  RandomStream random = RandomStream::ofSeed(6);
  const Vec3 centre = patient.landmark(landmark::kVeinTarget);
  for (int i = 0; i < 25; ++i) {
    const Vec3 direction = randomDirection(random);
    const Vec3 start = centre + randomIn(random, 0.01) - 0.25 * direction;
    std::size_t brute = 0;
    for (const OrganSurface& o : patient.organs)
      for (const auto& t : o.mesh.triangles) {
        const Vec3 &a = o.mesh.points[t[0]], &b = o.mesh.points[t[1]], &c = o.mesh.points[t[2]];
        // Signs of the three volumes, independent of the tree's algorithm.
        const double u = direction.dot((b - start).cross(c - start));
        const double v = direction.dot((c - start).cross(a - start));
        const double w = direction.dot((a - start).cross(b - start));
        if (!((u > 0 && v > 0 && w > 0) || (u < 0 && v < 0 && w < 0))) continue;
        const Vec3 n = (b - a).cross(c - a);
        const double s = (a - start).dot(n) / direction.dot(n);
        brute += s >= 0 && s <= 0.5;
      }
    const auto hits = query.cast(start, direction, 0.5);
    EXPECT_EQ(hits.size(), brute);
    for (std::size_t k = 1; k < hits.size(); ++k) EXPECT_LE(hits[k - 1].s, hits[k].s);
  }
}

TEST(SurfaceQuery, ThreadsGetTheSameAnswersAsOneThread) {
  const Patient& patient = referencePatient();
  const SurfaceQuery query(patient);
  const Vec3 centre = patient.landmark(landmark::kEntry);
  const auto sum = [&] {
    RandomStream random = RandomStream::ofSeed(7);
    double total = 0;
    for (int i = 0; i < 300; ++i) {
      const Vec3 p = centre + randomIn(random, 0.05);
      for (int s = 0; s < static_cast<int>(patient.organs.size()); ++s)
        total += query.closest(s, p).distance;
      for (const RayHit& hit : query.cast(p, Vec3::UnitY(), 0.1)) total += hit.s;
    }
    return total;
  };
  const double alone = sum();
  std::array<double, 4> together{};
  std::vector<std::thread> threads;
  for (double& result : together) threads.emplace_back([&] { result = sum(); });
  for (std::thread& thread : threads) thread.join();
  for (const double result : together) EXPECT_EQ(result, alone);
}

TEST(SurfaceQuery, ASurfaceWithoutTrianglesIsRefused) {
  EXPECT_THROW(SurfaceQuery{patientOf(TriangleMesh{}, Organ::lung)}, Error);
}

}  // namespace
}  // namespace palpa::anatomy
