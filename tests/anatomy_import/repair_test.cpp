#include "anatomy/import/repair.h"

#include <gtest/gtest.h>

#include "anatomy/import/surface_topology.h"
#include "sample_meshes.h"

namespace palpa::anatomy {
namespace {

using namespace test;

void isTheBoxAgain(const RawMesh& mesh) {
  const SurfaceCheck check = checkSurface(mesh);
  EXPECT_TRUE(check.sound());
  EXPECT_EQ(check.repeated_points, 0u);
  EXPECT_NEAR(check.volume, 24, 1e-9);
  EXPECT_LT((check.low - Vec3(0, -0.5, -1)).norm() + (check.high - Vec3(2, 2.5, 3)).norm(), 1e-12);
}

TEST(Repair, ASoundSurfaceIsLeftAlone) {
  RepairReport report;
  const RawMesh mesh = repaired(box(), &report);
  isTheBoxAgain(mesh);
  EXPECT_FALSE(report.changed());
  EXPECT_EQ(mesh.triangles, box().triangles);
  EXPECT_TRUE(words(report).empty());
}

TEST(Repair, CornersOfAnStlAreJoined) {
  RepairReport report;
  isTheBoxAgain(repaired(readMesh(MeshFormat::stl, asStl(box(), false), "box.stl")[0], &report));
  EXPECT_EQ(report.joined_points, 36u - 8u);
}

TEST(Repair, EveryTurnedTriangleIsTurnedBack) {
  for (unsigned mask : {0x001u, 0x0a5u, 0x7feu, 0xfffu}) {  // the last: all of them, inside out
    RawMesh mesh = box();
    std::size_t turned = 0;
    for (std::size_t i = 0; i < 12; ++i)
      if (mask >> i & 1) std::swap(mesh.triangles[i][0], mesh.triangles[i][1]), ++turned;
    RepairReport report;
    isTheBoxAgain(repaired(mesh, &report));
    EXPECT_EQ(report.turned_triangles, turned) << mask;
  }
}

TEST(Repair, HolesAreClosedWhateverTheirSize) {
  RawMesh mesh = box();
  mesh.triangles.erase(mesh.triangles.begin() + 8);  // a triangle of the left side
  mesh.triangles.erase(mesh.triangles.begin() + 9, mesh.triangles.end());  // the whole right side
  RepairReport report;
  const RawMesh whole = repaired(mesh, &report);
  isTheBoxAgain(whole);
  EXPECT_EQ(report.closed_holes, 2u);
  EXPECT_EQ(report.added_triangles, 1u + 2u);
}

TEST(Repair, ALargeOpeningWasMeant) {
  RawMesh tube;
  const std::size_t around = kLargestHole + 1;
  for (std::size_t i = 0; i < around; ++i) {
    const double a = 2 * M_PI * static_cast<double>(i) / static_cast<double>(around);
    tube.points.push_back({std::cos(a), std::sin(a), 0});
    tube.points.push_back({std::cos(a), std::sin(a), 1});
  }
  const auto n = static_cast<std::uint32_t>(2 * around);
  for (std::uint32_t i = 0; i < n; i += 2) {
    tube.triangles.push_back({i, (i + 2) % n, i + 1});
    tube.triangles.push_back({i + 1, (i + 2) % n, (i + 3) % n});
  }
  RepairReport report;
  const SurfaceCheck check = checkSurface(repaired(tube, &report));
  EXPECT_EQ(report.left_holes, 2u);
  EXPECT_EQ(check.holes, 2u);
}

TEST(Repair, WhatIsNothingOrTwiceGoes) {
  RawMesh mesh = box();
  mesh.triangles.push_back({1, 1, 5});
  mesh.triangles.push_back({mesh.triangles[3][1], mesh.triangles[3][2], mesh.triangles[3][0]});
  RepairReport report;
  isTheBoxAgain(repaired(mesh, &report));
  EXPECT_EQ(report.dropped_triangles, 2u);
}

TEST(Repair, PiecesAreTurnedEachForItself) {
  RawMesh mesh = box();
  RawMesh other = box();
  for (auto& t : other.triangles) std::swap(t[0], t[1]);
  for (const Vec3& p : other.points) mesh.points.push_back(p + Vec3(10, 0, 0));
  for (const auto& t : other.triangles) mesh.triangles.push_back({t[0] + 8, t[1] + 8, t[2] + 8});
  RepairReport report;
  const SurfaceCheck check = checkSurface(repaired(mesh, &report));
  EXPECT_NEAR(check.volume, 48, 1e-9);
  EXPECT_EQ(report.turned_triangles, 12u);
}

}  // namespace
}  // namespace palpa::anatomy
