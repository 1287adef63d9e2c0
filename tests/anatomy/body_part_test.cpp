#include "anatomy/parametric/body_part.h"

#include <gtest/gtest.h>

#include "anatomy/parametric/phantoms.h"

/// Parts of a body that are seen in a block's place.
namespace palpa::anatomy {
namespace {

constexpr double kHigh = 0.05;
const Eigen::Vector2d kHalf(0.030, 0.025);

TopShape domed() {
  TopShape top;
  top.arch_high = 0.012;
  top.arch_half_x = top.arch_half_y = 0.07;
  return onOrigin(top);
}

class BodyParts : public testing::TestWithParam<BodyPart> {};
INSTANTIATE_TEST_SUITE_P(Every, BodyParts,
                         testing::Values(BodyPart::breast, BodyPart::abdomen, BodyPart::prostate,
                                         BodyPart::neck));

TEST_P(BodyParts, AreTheBlocksTopWhereItIsFelt) {
  for (const TopShape& top : {TopShape(), domed()}) {
    int felt = 0;
    for (const Vec3& p_A : bodyPart(GetParam(), top, kHalf, kHigh).mesh.points) {
      const Vec3 p = X_AP().inverse() * p_A;
      EXPECT_GE(p.z(), -kHigh) << "under the table";
      if (std::abs(p.x()) > kHalf.x() || std::abs(p.y()) > kHalf.y()) continue;
      ++felt;
      EXPECT_NEAR(p.z(), heightOf(top, p.x(), p.y()).z, 1e-12);
    }
    EXPECT_GT(felt, 150);
  }
}

TEST_P(BodyParts, AreLargerThanTheBlockAndHaveAPicture) {
  const OrganSurface part = bodyPart(GetParam(), {}, kHalf, kHigh);
  EXPECT_EQ(part.organ, Organ::skin);
  double farthest = 0, lowest = 0;
  for (std::size_t i = 0; i < part.mesh.points.size(); ++i) {
    const Vec3 p = X_AP().inverse() * part.mesh.points[i];
    farthest = std::max(farthest, p.head<2>().norm());
    lowest = std::min(lowest, p.z());
    EXPECT_NEAR(part.mesh.normals[i].norm(), 1, 1e-9);
    EXPECT_GT((X_AP().linear().transpose() * part.mesh.normals[i]).z(), 0) << "looks up";
  }
  EXPECT_GT(farthest, 0.055);
  EXPECT_LT(lowest, -0.010);
  EXPECT_EQ(part.mesh.uvs.size(), part.mesh.points.size());
  EXPECT_EQ(part.texture.rgb.size(), std::size_t{3} * part.texture.width * part.texture.height);
}

/// Faces look up, as their normals do: else they would not be drawn.
TEST_P(BodyParts, FaceTheEye) {
  const TriangleMesh mesh = bodyPart(GetParam(), {}, kHalf, kHigh).mesh;
  for (const auto& t : mesh.triangles) {
    const Vec3 &a = mesh.points[t[0]], &b = mesh.points[t[1]], &c = mesh.points[t[2]];
    EXPECT_GT((X_AP().linear().transpose() * (b - a).cross(c - a)).z(), 0);
  }
}

TEST(BodyPartNames, AreThoseOfTheFile) {
  EXPECT_EQ(bodyPartNamed("breast"), BodyPart::breast);
  EXPECT_EQ(bodyPartNamed("neck"), BodyPart::neck);
  EXPECT_FALSE(bodyPartNamed("Breast"));
  EXPECT_FALSE(bodyPartNamed(""));
}

}  // namespace
}  // namespace palpa::anatomy
