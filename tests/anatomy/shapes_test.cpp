#include <gtest/gtest.h>

#include "anatomy/parametric/bones.h"
#include "anatomy/shapes/implicit_surface.h"
#include "anatomy/shapes/mesh_tools.h"
#include "anatomy/shapes/root.h"
#include "anatomy/shapes/spline.h"
#include "test_shapes.h"

namespace palpa::anatomy {
namespace {

TEST(SurfaceNets, SphereIsClosedAndOfTheRightVolume) {
  const double radius = 0.05, cell = 0.002;
  const TriangleMesh mesh = sphereMesh(radius, cell);
  EXPECT_TRUE(isClosed(mesh));
  // A polyhedron inscribed with sag h loses about 3 h / R of the volume; h below cell^2 / R.
  const double volume = 4 * M_PI / 3 * radius * radius * radius;
  EXPECT_LT(signedVolume(mesh), volume);
  EXPECT_NEAR(signedVolume(mesh), volume, volume * 3 * cell * cell / (radius * radius));
  for (const Vec3& p : mesh.points) EXPECT_NEAR(p.norm(), radius, 1e-4 * cell);
}

// Two sheets in one cell, as where grooves meet: the mesh must stay a closed surface.
TEST(SurfaceNets, StaysClosedWhereTheFieldIsFinerThanTheCells) {
  RandomStream random = RandomStream::ofSeed(41);
  for (int i = 0; i < 30; ++i) {
    std::vector<Vec3> centres;
    for (int k = 0; k < 40; ++k) centres.push_back(randomIn(random, 3));
    const auto field = [&](const Vec3& p) {
      double f = 1e9;
      for (const Vec3& c : centres) f = std::min(f, (p - c).norm() - 0.55);
      return f;
    };
    const TriangleMesh mesh = surfaceNets(field, {Vec3::Constant(-5), Vec3::Constant(5)}, 0.5);
    EXPECT_TRUE(isClosed(mesh)) << "case " << i;
    EXPECT_GT(signedVolume(mesh), 0);
  }
}

TEST(Spline, GoesThroughItsKnotsWithoutKinks) {
  const Spline s{{0, 1}, {1, 3}, {2.5, -1}, {4, 0}};
  EXPECT_DOUBLE_EQ(s(0), 1);
  EXPECT_NEAR(s(1), 3, 1e-12);
  EXPECT_NEAR(s(2.5), -1, 1e-12);
  EXPECT_DOUBLE_EQ(s(9), 0);
  constexpr double h = 1e-4;
  for (const double t : {1.0, 2.5}) {
    const double before = (s(t) - s(t - h)) / h, after = (s(t + h) - s(t)) / h;
    EXPECT_NEAR(before, after, 1e-2);  // h times the second derivative, below 30
  }
}

TEST(Field, SmoothUnionIsTheUnionAwayFromTheFillet) {
  EXPECT_EQ(smoothMin(1, 3, 1), 1);
  EXPECT_EQ(smoothMin(3, 1, 1), 1);
  EXPECT_DOUBLE_EQ(smoothMin(2, 2, 1), 2 - 0.25);  // deepest where both are equal: k / 4
  EXPECT_DOUBLE_EQ(smoothMax(2, 2, 1), 2 + 0.25);
  EXPECT_GT(smoothMin(1, 1.5, 1), 1 - 0.25);
}

TEST(Root, IsFoundForSteepAndFlatFunctions) {
  EXPECT_NEAR(findRoot([](double x) { return std::exp(x) - 2; }, 0, 5, 1e-10), std::log(2), 1e-8);
  EXPECT_NEAR(findRoot([](double x) { return x * x * x - 0.001; }, -1, 2, 1e-10), 0.1, 1e-6);
}

// Radius of the circle through three points.
double circleRadius(const Vec3& a, const Vec3& b, const Vec3& c) {
  const double area = (b - a).cross(c - a).norm() / 2;
  return (b - a).norm() * (c - b).norm() * (a - c).norm() / (4 * area);
}

TEST(Clavicle, HasThePublishedCurvesAndThickness) {
  const Clavicle clavicle = makeClavicle(149.4, 12);
  double medial = 1e9, lateral = 1e9;
  const auto& s = clavicle.sections;
  for (std::size_t i = 6; i + 6 < s.size(); ++i) {
    const double radius = circleRadius(s[i - 6].centre, s[i].centre, s[i + 6].centre);
    double& least = i < s.size() * 58 / 100 ? medial : lateral;
    least = std::min(least, radius);
  }
  // The chord's direction and scale change the drawn curvature by the arc's excess: 5 percent.
  EXPECT_NEAR(medial, 66, 66 * 0.05);
  EXPECT_NEAR(lateral, 34, 34 * 0.08);  // its bump is sharper than the circle's baseline
  // Convex forward medially, backward laterally: off the chord to opposite sides.
  const Vec3 chord = (s.back().centre - s.front().centre).normalized();
  const auto off = [&](std::size_t i) {
    const Vec3 v = s[i].centre - s.front().centre;
    return (v - chord * chord.dot(v)).y();
  };
  EXPECT_LT(off(s.size() / 3), -4);
  EXPECT_GT(off(s.size() * 85 / 100), 2);
  EXPECT_DOUBLE_EQ(2 * s[48].half_up, 12);
  EXPECT_TRUE(isClosed(clavicle.mesh));
  EXPECT_NEAR((clavicle.acromial_end - clavicle.sternal_end).norm(), 149.4, 1.0);
}

}  // namespace
}  // namespace palpa::anatomy
