#include "anatomy/parametric/phantoms.h"

#include <gtest/gtest.h>

#include <limits>

#include "anatomy/base/error.h"
#include "anatomy/patient/patient_file.h"
#include "anatomy/query/surface_query.h"
#include "anatomy/shapes/mesh_tools.h"
#include "test_shapes.h"

namespace palpa::anatomy {
namespace {

const Vec3 kSize(0.120, 0.100, 0.050);

TEST(PhantomBlock, IsClosedWithUnitNormalsThatLookOut) {
  const Patient block = phantomBlock(kSize, "block");
  ASSERT_EQ(block.organs.size(), 1u);
  EXPECT_EQ(block.organs[0].organ, Organ::skin);
  EXPECT_EQ(block.name, "block");
  const TriangleMesh& mesh = block.organs[0].mesh;
  EXPECT_TRUE(isClosed(mesh));
  ASSERT_EQ(mesh.normals.size(), mesh.points.size());
  for (const auto& t : mesh.triangles) {
    const Vec3 n =
        (mesh.points[t[1]] - mesh.points[t[0]]).cross(mesh.points[t[2]] - mesh.points[t[0]]);
    ASSERT_GT(n.norm(), 1e-9) << "a triangle without area";
    for (const std::uint32_t corner : t) {
      ASSERT_NEAR(mesh.normals[corner].norm(), 1, 1e-12);
      ASSERT_GT(mesh.normals[corner].dot(n.normalized()),
                0.9);  // cos of half an arc's step is 0.99
    }
  }
}

TEST(PhantomBlock, HasItsSizeAndRoundEdges) {
  const Patient block = phantomBlock(kSize, "block");
  Eigen::AlignedBox3d box;
  for (const Vec3& p : block.organs[0].mesh.points) box.extend(p);
  EXPECT_LT((box.min() - Vec3(-0.060, 0, -0.050)).norm(), 1e-12);
  EXPECT_LT((box.max() - Vec3(0.060, 0.050, 0.050)).norm(), 1e-12);
  // A box of flat parts grown by a ball (Steiner): V = abc + 2 (ab + bc + ca) r + pi (a + b + c)
  // r^2 + 4/3 pi r^3. Facets of t = 15 degrees cut 3 (t - sin t) r^2 off along each of the twelve
  // edges: 2.4e-4 of the whole.
  const double r = kBlockEdge;
  const Vec3 f = kSize - Vec3::Constant(2 * r);
  const double faces = f.x() * f.y() + f.y() * f.z() + f.z() * f.x();
  const double whole = f.prod() + 2 * faces * r + std::numbers::pi * f.sum() * r * r +
                       4.0 / 3 * std::numbers::pi * r * r * r;
  EXPECT_NEAR(signedVolume(block.organs[0].mesh), whole, 3e-4 * whole);
  EXPECT_LT(signedVolume(block.organs[0].mesh), whole);
  EXPECT_NEAR(SurfaceQuery(block).closest(0, Vec3(0.060, 0, 0)).distance, (std::sqrt(2.0) - 1) * r,
              5e-5)
      << "the edge is cut";
}

TEST(PhantomBlock, LiesOnItsBackWithTheMiddleOfItsTopAsEntry) {
  const Patient block = phantomBlock(kSize, "block");
  const Vec3& entry = block.landmark(landmark::kEntry);
  EXPECT_LT((X_AP() * Vec3::Zero() - entry).norm(), 1e-12);
  EXPECT_LT((X_AP() * Vec3(1, 2, 3) - Vec3(1, -3, 2)).norm(), 1e-12);
  EXPECT_NEAR(X_AP().linear().determinant(), 1, 1e-12);
  const SurfaceQuery query(block);
  EXPECT_NEAR(query.closest(0, entry).distance, 0, 1e-9);
  EXPECT_NEAR(query.closest(0, X_AP() * Vec3(0.01, 0.02, -0.005)).distance, -0.005, 1e-9)
      << "under the top is inside";
  EXPECT_NEAR(query.closest(0, X_AP() * Vec3(0.01, 0.02, 0.005)).distance, 0.005, 1e-9);
  EXPECT_LT(block.landmark(landmark::kNearEdge).z(), entry.z());
}

TEST(PhantomBlock, RefusesWhatIsNoBlockAndMakesTheSmallest) {
  const double none = std::numeric_limits<double>::quiet_NaN();
  for (const Vec3& size : {Vec3(0.009, 0.1, 0.05), Vec3(0.1, 0.1, -0.05), Vec3(0.1, 2.1, 0.05),
                           Vec3(0.1, none, 0.05), Vec3(none, 0.1, 0.05)})
    EXPECT_THROW(phantomBlock(size, "none"), Error) << size.transpose();
  const Patient least = phantomBlock(Vec3::Constant(0.010), "die");
  EXPECT_TRUE(isClosed(least.organs[0].mesh));
  EXPECT_LT(phantomBlock(Vec3::Constant(2), "large").organs[0].mesh.points.size(), 120'000u);
}

TopShape hill() {
  TopShape top;
  top.arch_high = 0.02;
  top.arch_half_x = 0.05;
  top.arch_half_y = 0.04;
  top.mound_count = 1;
  top.mounds[0] = {0.02, 0.01, 0.003, 0.01, 0.008, 0.8, 0.6};
  return onOrigin(top);
}

TEST(PhantomBlock, HasTheTopThatItIsGiven) {
  const TopShape top = hill();
  const Patient block = phantomBlock(kSize, "block", top);
  const TriangleMesh& mesh = block.organs[0].mesh;
  EXPECT_TRUE(isClosed(mesh));
  int on_top = 0;
  for (std::size_t i = 0; i < mesh.points.size(); ++i) {
    const Vec3 p = X_AP().inverse() * mesh.points[i],
               n = X_AP().linear().transpose() * mesh.normals[i];
    ASSERT_NEAR(n.norm(), 1, 1e-12);
    ASSERT_GE(p.z(), -kSize.z() - 1e-12) << "nothing below its base";
    if (std::abs(p.z() - heightOf(top, p.x(), p.y()).z) > 1e-12) continue;
    ++on_top;
    ASSERT_LT((n - normalOf(top, p.x(), p.y())).norm(), 1e-9);
  }
  EXPECT_GT(on_top, 1000);
  const SurfaceQuery query(block);
  for (const Vec3& along : {Vec3(0.01, 0.02, 0.005), Vec3(-0.03, 0, -0.004)})
    EXPECT_NEAR(query.closest(0, X_AP() * fromTop(top, along)).distance, along.z(), 1e-4)
        << "a mesh of 2.5 mm";
  TopShape low = hill();
  low.arch_high = 0.06;
  EXPECT_THROW(phantomBlock(kSize, "block", onOrigin(low)), Error);
}

TEST(PhantomBlock, GoesThroughAFile) {
  const ScratchFolder folder("block");
  const Patient written = phantomBlock(kSize, "block");
  writePatient(written, folder / "b.glb");
  const Patient read = readPatient(folder / "b.glb");
  EXPECT_EQ(read.organ(Organ::skin).mesh.triangles, written.organs[0].mesh.triangles);
  EXPECT_LT((read.landmark(landmark::kNearEdge) - written.landmark(landmark::kNearEdge)).norm(),
            1e-6);
}

}  // namespace
}  // namespace palpa::anatomy
