#include "anatomy/import/weld.h"

#include <gtest/gtest.h>

#include <map>
#include <random>

#include "anatomy/import/repair.h"
#include "anatomy/import/surface_topology.h"
#include "round_meshes.h"

namespace palpa::anatomy {
namespace {

using namespace test;

/// A ball cut at its equator; the points of the cut stand there twice, each thrown by up to
/// `throw_by` a coordinate.
RawMesh cutBall(double throw_by) {
  const RawMesh whole = ball(10, 12, 24);
  RawMesh cut = whole;
  cut.triangles.clear();
  std::map<std::uint32_t, std::uint32_t> lower;
  std::mt19937_64 bits(7);
  std::uniform_real_distribution<double> dice(-throw_by, throw_by);
  const auto thrown = [&](const Vec3& p) {
    return Vec3(p + Vec3(dice(bits), dice(bits), dice(bits)));
  };
  for (auto t : whole.triangles) {
    if ((whole.points[t[0]] + whole.points[t[1]] + whole.points[t[2]]).z() < 0)
      for (auto& c : t) {
        if (std::abs(whole.points[c].z()) > 1e-9) continue;
        const auto [at, fresh] = lower.emplace(c, static_cast<std::uint32_t>(cut.points.size()));
        if (fresh) cut.points.push_back(thrown(whole.points[c]));
        c = at->second;
      }
    cut.triangles.push_back(t);
  }
  for (const auto& [upper, copy] : lower) cut.points[upper] = thrown(whole.points[upper]);
  return cut;
}

TEST(Weld, ACutAndJitteredBallIsWholeAgain) {
  const RawMesh cut = cutBall(0.005);
  EXPECT_EQ(checkSurface(cut).open_edges, 48u);
  RepairReport report;
  const SurfaceCheck check = checkSurface(repaired(cut, &report, 0.02));
  EXPECT_TRUE(check.sound());
  EXPECT_EQ(check.pieces, 1u);
  EXPECT_EQ(report.welded_points, 24u);
  EXPECT_EQ(report.closed_holes, 0u) << "the seam was welded, not filled";
  EXPECT_GT(report.farthest_weld, 0);
  EXPECT_LE(report.farthest_weld, 0.01) << "half the tolerance, for two points at their mean";
  EXPECT_NEAR(check.volume, checkSurface(ball(10, 12, 24)).volume, 1);
  EXPECT_NE(words(report, 1e-3)[0].find("24 points of seams joined, none moved by more than "),
            std::string::npos);
}

TEST(Weld, WithoutAToleranceNothingNearIsJoined) {
  RepairReport report;
  EXPECT_EQ(checkSurface(repaired(cutBall(0.005), &report)).pieces, 2u)
      << "two caps, each closed for itself";
  EXPECT_EQ(report.welded_points, 0u);
  EXPECT_EQ(report.closed_holes, 2u);
}

TEST(Weld, AWiderSeamThanTheToleranceStays) {
  WeldReport report;
  welded(cutBall(0.05), 1e-4, &report);
  EXPECT_EQ(report.joined_points, 0u);
}

TEST(Weld, SheetsThatRunSideBySideStayTwo) {
  for (const bool turned : {false, true}) {
    RawMesh two = sheet(6, 0, 0, false);
    append(&two, sheet(6, 0, 0.01, turned));
    WeldReport report;
    const RawMesh after = welded(two, 0.02, &report);
    EXPECT_EQ(report.joined_points, 0u) << turned;
    EXPECT_EQ(checkSurface(after).pieces, 2u);
  }
}

TEST(Weld, SheetsThatMeetAreJoinedAlongTheirSeamOnly) {
  RawMesh two = sheet(6, 0, 0, false);
  append(&two, sheet(6, 1.01, 0.002, false));
  WeldReport report;
  const SurfaceCheck check = checkSurface(welded(two, 0.02, &report));
  EXPECT_EQ(report.joined_points, 7u);
  EXPECT_EQ(check.pieces, 1u);
  EXPECT_EQ(check.open_edges, 4u * 12u - 12u);
  EXPECT_NEAR(report.farthest, std::hypot(0.01, 0.002) / 2, 1e-12);
}

TEST(Weld, PointsOfOneEdgeAreNeverJoined) {
  RawMesh fine = sheet(6, 0, 0, false);
  for (Vec3& p : fine.points) p *= 0.01;  // every edge is shorter than the tolerance
  WeldReport report;
  const RawMesh after = welded(fine, 0.02, &report);
  EXPECT_EQ(after.triangles.size(), fine.triangles.size());
  for (const auto& t : after.triangles) EXPECT_TRUE(t[0] != t[1] && t[1] != t[2] && t[2] != t[0]);
}

TEST(Repair, RingsThatMeetInAPointAreBothClosed) {
  RawMesh mesh = ball(10, 12, 24);
  // Two quads that touch in one corner only.
  const Vec3 corner = mesh.points[1 + 5 * 24 + 6];
  const auto hasCorner = [&](const auto& t) {
    return mesh.points[t[0]] == corner || mesh.points[t[1]] == corner ||
           mesh.points[t[2]] == corner;
  };
  std::vector<std::array<std::uint32_t, 3>> around, kept;
  for (const auto& t : mesh.triangles) (hasCorner(t) ? around : kept).push_back(t);
  ASSERT_EQ(around.size(), 6u);
  for (const auto& t : around) {
    const Vec3 middle = (mesh.points[t[0]] + mesh.points[t[1]] + mesh.points[t[2]]) / 3 - corner;
    if ((middle.z() > 0) != (middle.cross(corner).z() > 0)) kept.push_back(t);
  }
  mesh.triangles = kept;
  ASSERT_GT(checkSurface(mesh).open_edges, 0u);
  RepairReport report;
  EXPECT_TRUE(checkSurface(repaired(mesh, &report)).sound());
  EXPECT_EQ(report.left_holes, 0u);
}

}  // namespace
}  // namespace palpa::anatomy
