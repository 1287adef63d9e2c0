#include "anatomy/geometry/pose.h"

#include <gtest/gtest.h>

#include "anatomy/geometry/local_geometry.h"

namespace palpa {
namespace {

TEST(Pose, PackingRoundTripsToTheLastBits) {
  const Pose X = makePose(Quat(0.3, -0.2, 0.8, 0.1).normalized().toRotationMatrix(), {1, -2, 3});
  EXPECT_LT((unpack(pack(X)).matrix() - X.matrix()).norm(), 1e-15);  // one rounding a component
}

TEST(Pose, RotationWithZTakesZToTheVectorEvenWhenOpposite) {
  for (const Vec3& z : {Vec3(0, 0, 1), Vec3(0, 0, -1), Vec3(1, 2, -2).normalized()}) {
    const Mat3 R = rotationWithZ(z);
    EXPECT_LT((R * Vec3::UnitZ() - z).norm(), 1e-12);
    EXPECT_NEAR(R.determinant(), 1.0, 1e-12);
  }
}

TEST(Organ, NamesRoundTrip) {
  for (int i = 0; i < kOrganCount; ++i) {
    const Organ organ = static_cast<Organ>(i);
    EXPECT_EQ(organFromName(name(organ)), organ);
  }
  EXPECT_EQ(organFromName("spleen"), Organ::none);
}

}  // namespace
}  // namespace palpa
