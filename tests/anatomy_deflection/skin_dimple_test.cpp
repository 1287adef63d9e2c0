#include "anatomy/query/skin_dimple.h"

#include <gtest/gtest.h>

#include "anatomy/query/triangle_tree.h"
#include "tests/support/simple_patient.h"

namespace palpa::anatomy {
namespace {

TriangleMesh curvedSkin() {
  return test::sheet(
      0.15, [](double x, double z) { return 0.9 * x * x + 0.35 * z * z; }, 101);
}

TriangleMesh applied(const TriangleMesh& skin, std::span<const SkinDimple::Vertex> moved) {
  TriangleMesh now = skin;
  for (const SkinDimple::Vertex& v : moved) {
    now.points[v.index] = v.p_A;
    now.normals[v.index] = v.n_A;
  }
  return now;
}

TEST(SkinDimple, TheFacetItselfMeetsTheTip) {
  const TriangleMesh skin = curvedSkin();
  const TriangleTree tree(skin);
  SkinDimple dimple(skin);
  for (int i = 0; i < 40; ++i) {
    const TriangleTree::Closest foot = tree.closest({0.001 * i - 0.02, -0.01, 0.0007 * i});
    const double depth = i % 3 == 0 ? -0.001 : 0.003;
    const TriangleMesh now =
        applied(skin, dimple.press({foot.p, foot.normal, depth, Vec3::Zero()}));
    Vec3 carried = Vec3::Zero();
    for (int k = 0; k < 3; ++k) carried += foot.weights[k] * now.points[foot.corners[k]];
    EXPECT_LT((carried - (foot.p - depth * foot.normal)).norm(), 1e-9);
  }
}

TEST(SkinDimple, MovesOnlyThePatchAndAllOfItOneWay) {
  const TriangleMesh skin = curvedSkin();
  SkinDimple dimple(skin);
  const TriangleTree::Closest foot = TriangleTree(skin).closest({0.01, 0, 0.02});
  const auto moved = dimple.press({foot.p, foot.normal, 0.003, Vec3::Zero()});
  EXPECT_GT(moved.size(), 300u);
  EXPECT_LT(moved.size(), skin.points.size() / 2);
  for (const SkinDimple::Vertex& v : moved) {
    EXPECT_LT((skin.points[v.index] - foot.p).norm(), 0.060);
    EXPECT_GT((skin.points[v.index] - v.p_A).dot(foot.normal), 0);
    EXPECT_NEAR(v.n_A.norm(), 1, 1e-12);
  }
}

TEST(SkinDimple, NormalsAreThoseOfTheMovedFacets) {
  const TriangleMesh skin = test::sheet(
      0.1, [](double, double) { return 0.0; }, 401);
  SkinDimple dimple(skin);
  const TriangleMesh now =
      applied(skin, dimple.press({{0, 0, 0}, {0, -1, 0}, 0.002, Vec3::Zero()}));
  double worst = 1;
  for (const auto& t : now.triangles) {
    const Vec3 &a = now.points[t[0]], &b = now.points[t[1]], &c = now.points[t[2]];
    const double r = ((a + b + c) / 3).norm();
    if (r < 0.004 || r > 0.055) continue;
    const Vec3 mean = (now.normals[t[0]] + now.normals[t[1]] + now.normals[t[2]]).normalized();
    worst = std::min(worst, std::abs((b - a).cross(c - a).normalized().dot(mean)));
  }
  EXPECT_GT(worst, 0.9995);
}

TEST(SkinDimple, NoDepthMovesNothing) {
  SkinDimple dimple(curvedSkin());
  EXPECT_TRUE(dimple.press({Vec3::Zero(), -Vec3::UnitY(), 0, Vec3::Zero()}).empty());
  EXPECT_TRUE(dimple.press({Vec3::Constant(NAN), -Vec3::UnitY(), 0.001, Vec3::Zero()}).empty());
  EXPECT_TRUE(dimple.press({{0, 5, 0}, -Vec3::UnitY(), 0.001, Vec3::Zero()}).empty());
}

TEST(SkinDimple, TheOtherSheetStays) {
  TriangleMesh slab = test::sphere({0, 0.01, 0}, {0.1, 0.01, 0.1}, 80);
  SkinDimple dimple(slab);
  for (const SkinDimple::Vertex& v : dimple.press({{0, 0, 0}, -Vec3::UnitY(), 0.003, Vec3::Zero()}))
    EXPECT_LT(slab.points[v.index].y(), 0.0105);
}

}  // namespace
}  // namespace palpa::anatomy
