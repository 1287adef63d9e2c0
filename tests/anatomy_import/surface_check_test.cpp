#include "anatomy/import/surface_topology.h"

#include <gtest/gtest.h>

#include "anatomy/import/units_and_axes.h"
#include "sample_meshes.h"

namespace palpa::anatomy {
namespace {

using namespace test;

TEST(SurfaceCheck, AHoleIsOneRingOfOpenEdges) {
  RawMesh mesh = box();
  mesh.triangles.pop_back();  // one corner of a side
  SurfaceCheck check = checkSurface(mesh);
  EXPECT_EQ(check.open_edges, 3u);
  EXPECT_EQ(check.holes, 1u);
  mesh.triangles.erase(mesh.triangles.begin());  // and one of the opposite side
  check = checkSurface(mesh);
  EXPECT_EQ(check.open_edges, 6u);
  EXPECT_EQ(check.holes, 2u);
  EXPECT_FALSE(check.closed());
  EXPECT_EQ(findings(check).front(), "2 holes");
}

TEST(SurfaceCheck, ATurnedTriangleDisagreesWithItsThreeNeighbours) {
  RawMesh mesh = box();
  std::swap(mesh.triangles[4][0], mesh.triangles[4][1]);
  const SurfaceCheck check = checkSurface(mesh);
  EXPECT_EQ(check.turned_edges, 3u);
  EXPECT_TRUE(check.closed());
  EXPECT_FALSE(check.sound());
}

TEST(SurfaceCheck, InsideOutIsSeenByItsVolume) {
  RawMesh mesh = box();
  for (auto& t : mesh.triangles) std::swap(t[0], t[1]);
  const SurfaceCheck check = checkSurface(mesh);
  EXPECT_TRUE(check.inside_out);
  EXPECT_NEAR(check.volume, -24, 1e-9);
}

TEST(SurfaceCheck, RepeatedAndDegenerateThingsAreCountedAndDoNotHideTheRest) {
  RawMesh mesh = box();
  mesh.points.push_back(mesh.points[3]);  // again, used by a triangle that is there already
  mesh.triangles.push_back({mesh.triangles[0][0], mesh.triangles[0][1], 8});
  mesh.triangles.push_back({1, 1, 5});
  const SurfaceCheck check = checkSurface(mesh);
  EXPECT_EQ(check.repeated_points, 1u);
  EXPECT_EQ(check.repeated_triangles, 1u);
  EXPECT_EQ(check.degenerate, 1u);
  EXPECT_TRUE(check.closed());
}

TEST(SurfaceCheck, PiecesShareNoPoint) {
  RawMesh mesh = box();
  const RawMesh other = box();
  for (const Vec3& p : other.points) mesh.points.push_back(p + Vec3(10, 0, 0));
  for (const auto& t : other.triangles) mesh.triangles.push_back({t[0] + 8, t[1] + 8, t[2] + 8});
  EXPECT_EQ(checkSurface(mesh).pieces, 2u);
  EXPECT_NEAR(checkSurface(mesh).volume, 48, 1e-9);
}

TEST(Unit, AClavicleOfAKilometreWasMeantInMillimetres) {
  EXPECT_TRUE(plausibleLength(Organ::clavicle, 0.149));
  EXPECT_FALSE(plausibleLength(Organ::clavicle, 149));
  EXPECT_STREQ(likelyUnit(Organ::clavicle, 149)->name, "mm");
  EXPECT_STREQ(likelyUnit(Organ::clavicle, 14.9)->name, "cm");
  EXPECT_STREQ(likelyUnit(Organ::clavicle, 5.87)->name, "in");
  EXPECT_STREQ(likelyUnit(Organ::clavicle, 0.149)->name, "m");
  EXPECT_FALSE(likelyUnit(Organ::clavicle, 0).has_value());
  EXPECT_FALSE(likelyUnit(Organ::clavicle, 1e30).has_value());
}

TEST(Unit, LengthsAreSaidAsPeopleSayThem) {
  EXPECT_EQ(lengthText(1400), "1.4 km");
  EXPECT_EQ(lengthText(0.149), "149 mm");
  EXPECT_EQ(lengthText(1.75), "1.75 m");
}

}  // namespace
}  // namespace palpa::anatomy
