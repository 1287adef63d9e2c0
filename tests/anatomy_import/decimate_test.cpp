#include "anatomy/import/decimate.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "anatomy/shapes/mesh_tools.h"
#include "round_meshes.h"

namespace palpa::anatomy {
namespace {

using namespace test;

TriangleMesh inMetres(const RawMesh& raw) {
  TriangleMesh mesh;
  for (const Vec3& p : raw.points) mesh.points.push_back(1e-3 * p);
  mesh.triangles = raw.triangles;
  return mesh;
}

double toSegment(const Vec3& p, const Vec3& a, const Vec3& b) {
  const double t = std::clamp((p - a).dot(b - a) / (b - a).squaredNorm(), 0.0, 1.0);
  return (p - a - t * (b - a)).norm();
}

/// By the plane where the foot is inside, else by the edges: nothing of the program's own search is
/// in it.
double toTriangle(const Vec3& p, const Vec3& a, const Vec3& b, const Vec3& c) {
  const Vec3 n = (b - a).cross(c - a);
  const bool inside = n.squaredNorm() > 0 && (b - a).cross(p - a).dot(n) >= 0 &&
                      (c - b).cross(p - b).dot(n) >= 0 && (a - c).cross(p - c).dot(n) >= 0;
  if (inside) return std::abs((p - a).dot(n)) / n.norm();
  return std::min({toSegment(p, a, b), toSegment(p, b, c), toSegment(p, c, a)});
}

void statesItsError(const TriangleMesh& mesh, std::size_t budget) {
  DecimationReport report;
  const TriangleMesh coarse = decimated(mesh, budget, &report);
  EXPECT_TRUE(isClosed(coarse));
  EXPECT_GT(signedVolume(coarse), 0);
  EXPECT_LE(coarse.triangles.size(), budget);
  EXPECT_GE(coarse.triangles.size(), budget / 2);
  EXPECT_EQ(report.after, coarse.triangles.size());
  EXPECT_EQ(report.before, mesh.triangles.size());
  double farthest = 0, squares = 0;
  for (const Vec3& p : mesh.points) {
    double least = 1;
    for (const auto& t : coarse.triangles)
      least = std::min(
          least, toTriangle(p, coarse.points[t[0]], coarse.points[t[1]], coarse.points[t[2]]));
    farthest = std::max(farthest, least);
    squares += least * least;
  }
  EXPECT_NEAR(report.farthest, farthest, 1e-9);
  EXPECT_NEAR(report.rms, std::sqrt(squares / static_cast<double>(mesh.points.size())), 1e-9);
  EXPECT_GT(report.farthest, 1e-6) << "a coarser ball is another one";
  for (const Vec3& n : coarse.normals) EXPECT_NEAR(n.norm(), 1, 1e-6);
}

TEST(Decimate, ABallKeepsClosedWithinItsBudgetAndTellsItsError) {
  statesItsError(inMetres(ball(50, 40, 60)), 600);
}

TEST(Decimate, SoDoesAThinPlate) {
  RawMesh plate = ball(50, 30, 60);
  for (Vec3& p : plate.points) p.z() *= 0.02;  // 2 mm thick, rim sharp
  statesItsError(inMetres(plate), 400);
}

TEST(Decimate, WhatIsFewEnoughIsLeftAlone) {
  const TriangleMesh mesh = inMetres(ball(50, 10, 12));
  DecimationReport report;
  const TriangleMesh same = decimated(mesh, 100'000, &report);
  EXPECT_EQ(same.triangles, mesh.triangles);
  EXPECT_EQ(report.way, "none");
  EXPECT_EQ(report.farthest, 0);
}

}  // namespace
}  // namespace palpa::anatomy
