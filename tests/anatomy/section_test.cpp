#include "anatomy/query/section.h"

#include <gtest/gtest.h>

#include "tests/anatomy/test_shapes.h"

namespace palpa::anatomy {
namespace {

double signedArea(const SectionLine& line) {
  double twice = 0;
  for (std::size_t i = 0; i < line.points.size(); ++i) {
    const Eigen::Vector2d &a = line.points[i], &b = line.points[(i + 1) % line.points.size()];
    twice += a.x() * b.y() - a.y() * b.x();
  }
  return twice / 2;
}

OrganSurface ball(double radius) {
  return {"ball", Organ::vein, sphereMesh(radius, 0.0005), {1, 1, 1, 1}};
}

OrganSurface tetrahedron() {
  OrganSurface organ{"four corners", Organ::rib, {}, {1, 1, 1, 1}};
  organ.mesh.points = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  organ.mesh.triangles = {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {0, 3, 2}};
  return organ;
}

TEST(Section, OfABallIsACircle) {
  const double radius = 0.01, off = 0.006;
  const SectionPlane plane{{0, 0, off}, Vec3::UnitX(), Vec3::UnitY()};
  const auto lines = sectionOf(ball(radius), plane);
  ASSERT_EQ(lines.size(), 1u);
  EXPECT_EQ(lines[0].organ, Organ::vein);
  EXPECT_TRUE(lines[0].closed);
  const double expected = std::sqrt(radius * radius - off * off);
  for (const Eigen::Vector2d& p : lines[0].points) EXPECT_NEAR(p.norm(), expected, 1e-4);
  EXPECT_NEAR(signedArea(lines[0]), M_PI * expected * expected, 2e-6);  // the ball on its left
}

TEST(Section, IsTheSameInWhicheverAxesItIsAsked) {
  const Vec3 across = Vec3(1, 2, -1).normalized(), up = across.cross(Vec3(0, 1, 1)).normalized();
  const SectionPlane plane{0.003 * across.cross(up), across, up};
  const auto lines = sectionOf(ball(0.01), plane);
  ASSERT_EQ(lines.size(), 1u);
  for (const Eigen::Vector2d& p : lines[0].points) {
    EXPECT_NEAR(p.norm(), std::sqrt(1e-4 - 9e-6), 1e-4);
    const Vec3 p_A = plane.origin_A + p.x() * across + p.y() * up;
    EXPECT_NEAR(plane.offset(p_A), 0, 1e-15);
    EXPECT_LT((plane.at(p_A) - p).norm(), 1e-15);
  }
}

TEST(Section, OfWhatThePlaneMissesIsNothing) {
  EXPECT_TRUE(sectionOf(ball(0.01), {{0, 0, 0.02}, Vec3::UnitX(), Vec3::UnitY()}).empty());
}

TEST(Section, WithACornerInThePlaneIsStillClosed) {
  const auto lines =
      sectionOf(tetrahedron(), {Vec3::Zero(), Vec3(1, 1, 0).normalized(), Vec3::UnitZ()});
  ASSERT_EQ(lines.size(), 1u);
  EXPECT_TRUE(lines[0].closed);
  EXPECT_NEAR(std::abs(signedArea(lines[0])), std::sqrt(0.5) / 2, 1e-12);
}

TEST(Section, IsNotPartedByASeam) {
  OrganSurface seamed = ball(0.01);
  TriangleMesh& mesh = seamed.mesh;
  for (auto& triangle : mesh.triangles)  // each with corners of its own
    for (std::uint32_t& corner : triangle) {
      mesh.points.push_back(mesh.points[corner]);
      corner = static_cast<std::uint32_t>(mesh.points.size() - 1);
    }
  const SectionPlane plane{{0, 0, 0.002}, Vec3::UnitX(), Vec3::UnitY()};
  const auto lines = sectionOf(seamed, plane), whole = sectionOf(ball(0.01), plane);
  ASSERT_EQ(lines.size(), 1u);
  EXPECT_TRUE(lines[0].closed);
  EXPECT_EQ(lines[0].points.size(), whole[0].points.size());
}

TEST(Section, IsNotPartedByASliver) {
  OrganSurface slivered = tetrahedron();
  TriangleMesh& mesh = slivered.mesh;
  mesh.points.push_back(mesh.points[0]);  // a corner twice, and triangles that are edges
  mesh.triangles.insert(mesh.triangles.begin(), {{0, 4, 3}, {3, 4, 0}});
  const auto lines = sectionOf(slivered, {{0, 0, 0.5}, Vec3::UnitX(), Vec3::UnitY()});
  ASSERT_EQ(lines.size(), 1u);
  EXPECT_TRUE(lines[0].closed);
  EXPECT_EQ(lines[0].points.size(), 3u);
}

TEST(Section, OfAnOpenSurfaceHasEnds) {
  OrganSurface one = tetrahedron();
  one.mesh.triangles.resize(1);
  const auto lines = sectionOf(one, {{0.25, 0, 0}, Vec3::UnitY(), Vec3::UnitZ()});
  ASSERT_EQ(lines.size(), 1u);
  EXPECT_FALSE(lines[0].closed);
  ASSERT_EQ(lines[0].points.size(), 2u);
  EXPECT_NEAR((lines[0].points[0] - lines[0].points[1]).norm(), 0.75, 1e-12);
}

/// Of a whole patient every line is closed.
TEST(Section, OfAPatientIsClosed) {
  const Patient& patient = referencePatient();
  const Vec3& target = patient.landmark(landmark::kVeinTarget);
  std::size_t lines = 0;
  for (const OrganSurface& organ : patient.organs)
    for (const SectionLine& line : sectionOf(organ, {target, Vec3::UnitY(), Vec3::UnitZ()})) {
      EXPECT_TRUE(line.closed) << organ.id;
      ++lines;
    }
  EXPECT_GE(lines, 4u);
}

}  // namespace
}  // namespace palpa::anatomy
