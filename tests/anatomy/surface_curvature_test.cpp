#include "anatomy/query/surface_curvature.h"

#include <gtest/gtest.h>

#include "anatomy/query/surface_query.h"
#include "anatomy/shapes/mesh_tools.h"
#include "test_shapes.h"

namespace palpa::anatomy {
namespace {

constexpr double kTorusBig = 0.05, kTorusSmall = 0.02;  // of the torus

/// A closed grid over two angles, its points pushed about by `uneven` of a cell so that no triangle
/// is regular.
template <class Point, class Normal>
TriangleMesh grid(int rows, int columns, double uneven, Point point, Normal normal) {
  TriangleMesh mesh;
  RandomStream random = RandomStream::ofSeed(5);
  for (int i = 0; i < rows; ++i)
    for (int j = 0; j < columns; ++j) {
      const double u = 2 * M_PI * (i + uneven * (random.openUniform() - 0.5)) / rows;
      const double v = 2 * M_PI * (j + uneven * (random.openUniform() - 0.5)) / columns;
      mesh.points.push_back(point(u, v));
      mesh.normals.push_back(normal(u, v));
    }
  const auto at = [&](int i, int j) {
    return static_cast<std::uint32_t>((i % rows) * columns + j % columns);
  };
  for (int i = 0; i < rows; ++i)
    for (int j = 0; j < columns; ++j) {
      mesh.triangles.push_back({at(i, j), at(i + 1, j), at(i + 1, j + 1)});
      mesh.triangles.push_back({at(i, j), at(i + 1, j + 1), at(i, j + 1)});
    }
  return mesh;
}

Vec3 torusNormal(double u, double v) {
  return {std::cos(u) * std::cos(v), std::sin(u) * std::cos(v), std::sin(v)};
}
Vec3 torusPoint(double u, double v) {
  return Vec3(kTorusBig * std::cos(u), kTorusBig * std::sin(u), 0) +
         kTorusSmall * torusNormal(u, v);
}
TriangleMesh torus(int rows, double uneven) {
  return grid(rows, rows / 2, uneven, torusPoint, torusNormal);
}

/// Largest error of k1 and k2 at random points of the torus, as a part of 1 / r.
double torusError(const TriangleMesh& mesh) {
  const SurfaceQuery query(patientOf(mesh, Organ::vein));
  RandomStream random = RandomStream::ofSeed(6);
  double worst = 0;
  for (int i = 0; i < 1000; ++i) {
    const double u = 2 * M_PI * random.openUniform(), v = 2 * M_PI * random.openUniform();
    const CurvedPoint at = query.curved(0, torusPoint(u, v));
    const double across = std::cos(v) / (kTorusBig + kTorusSmall * std::cos(v));
    worst = std::max(
        {worst, std::abs(at.curvature.k1 - 1 / kTorusSmall), std::abs(at.curvature.k2 - across)});
  }
  return worst * kTorusSmall;
}

TEST(Curvature, OfASphereIsOneOverItsRadius) {
  for (const double radius : {0.01, 0.05}) {
    TriangleMesh mesh = sphereMesh(radius, radius / 25);
    const auto worst = [&] {
      const SurfaceQuery query(patientOf(mesh, Organ::lung));
      RandomStream random = RandomStream::ofSeed(7);
      double most = 0;
      for (int i = 0; i < 1000; ++i) {
        const PrincipalCurvatures k = query.curved(0, radius * randomDirection(random)).curvature;
        most = std::max({most, std::abs(k.k1 * radius - 1), std::abs(k.k2 * radius - 1)});
      }
      return most;
    };
    RecordProperty("as_meshed_percent", std::to_string(100 * worst()));
    EXPECT_LT(worst(), 0.03);
    for (std::size_t i = 0; i < mesh.points.size(); ++i)
      mesh.normals[i] = mesh.points[i].normalized();
    RecordProperty("with_exact_normals_percent", std::to_string(100 * worst()));
    EXPECT_LT(worst(), 0.01);
  }
}

TEST(Curvature, OfATubeIsOneOverItsRadiusAndNothingAlongIt) {
  const double radius = 0.006;
  const TriangleMesh mesh = capsuleMesh({-0.03, 0, 0}, {0.03, 0, 0}, radius, 60, 64);
  const SurfaceQuery query(patientOf(mesh, Organ::vein));
  RandomStream random = RandomStream::ofSeed(8);
  double worst = 0;
  for (int i = 0; i < 500; ++i) {
    const double turn = 2 * M_PI * random.openUniform(), x = 0.04 * (random.openUniform() - 0.5);
    const CurvedPoint at = query.curved(0, {x, radius * std::cos(turn), radius * std::sin(turn)});
    worst = std::max(
        {worst, std::abs(at.curvature.k1 * radius - 1), std::abs(at.curvature.k2 * radius)});
    EXPECT_GT(std::abs(at.curvature.d2.x()), 0.999);
    EXPECT_NEAR(at.curvature.d1.dot(at.n_A), 0, 1e-12);
    EXPECT_NEAR(at.curvature.d1.cross(at.curvature.d2).dot(at.n_A), 1, 1e-12);
  }
  RecordProperty("percent", std::to_string(100 * worst));
  EXPECT_LT(worst, 0.01);
}

TEST(Curvature, OfATorusFallsWithTheSquareOfTheEdge) {
  const double coarse = torusError(torus(60, 0)), fine = torusError(torus(120, 0));
  RecordProperty("percent", std::to_string(100 * coarse));
  EXPECT_LT(coarse, 0.02);
  EXPECT_NEAR(std::log2(coarse / fine), 2, 0.4);
}

TEST(Curvature, OfATorusOfUnevenTrianglesStaysNear) {
  const double coarse = torusError(torus(80, 0.5)), fine = torusError(torus(240, 0.5));
  RecordProperty("coarse_percent", std::to_string(100 * coarse));
  RecordProperty("fine_percent", std::to_string(100 * fine));
  EXPECT_LT(coarse, 0.10);
  EXPECT_LT(fine, 0.5 * coarse);
}

TEST(Curvature, IsNegativeWhereTheSurfaceIsHollow) {
  TriangleMesh mesh = sphereMesh(0.05, 0.002);
  flip(&mesh);
  for (Vec3& n : mesh.normals) n = -n;
  const SurfaceQuery query(patientOf(mesh, Organ::lung));
  EXPECT_NEAR(query.curved(0, {0.05, 0, 0}).curvature.k2 * 0.05, -1, 0.03);
}

TEST(TangentPlane, OfASphereIsAcrossItsRadiusAndMissesItByTheSag) {
  const double radius = 0.05, reach = 0.01;
  const SurfaceQuery query(patientOf(sphereMesh(radius, 0.001), Organ::lung));
  RandomStream random = RandomStream::ofSeed(9);
  for (int i = 0; i < 50; ++i) {
    const Vec3 out = randomDirection(random);
    const SurfaceQuery::TangentPlane plane = query.tangentPlane(0, 1.2 * radius * out, reach);
    EXPECT_GT(plane.n_A.dot(out), 0.9999);
    // Height r^2 / 2R with weights (1 - r^2/reach^2)^2: its weighted deviation is reach^2 / 2R
    // sqrt(3/80).
    EXPECT_NEAR(plane.rms, reach * reach / (2 * radius) * std::sqrt(3.0 / 80), 0.05e-3);
  }
}

}  // namespace
}  // namespace palpa::anatomy
