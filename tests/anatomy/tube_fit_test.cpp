#include <gtest/gtest.h>

#include "anatomy/query/surface_query.h"
#include "test_shapes.h"

namespace palpa::anatomy {
namespace {

double lineDistance(const Vec3& p, const Vec3& a, const Vec3& b) {
  return (p - a).cross((b - a).normalized()).norm();
}

TEST(TubeFit, FindsAxisAndRadiusOfATubeOfAnyDirection) {
  RandomStream random = RandomStream::ofSeed(11);
  for (int i = 0; i < 20; ++i) {
    const Vec3 axis = randomDirection(random), middle = randomIn(random, 0.1);
    const double radius = 0.004 + 0.006 * random.openUniform();
    const Vec3 a = middle - 0.05 * axis, b = middle + 0.05 * axis;
    const SurfaceQuery query(patientOf(capsuleMesh(a, b, radius, 101, 48), Organ::clavicle));
    const Vec3 across = axis.cross(randomDirection(random)).normalized();
    SurfaceQuery::Tube tube;
    ASSERT_TRUE(query.fitTube(0, middle + radius * across, 0.02, &tube));
    // The vertices lie on the tube: only the asymmetry of whole rings within reach remains.
    EXPECT_NEAR(tube.radius, radius, 1e-9);
    EXPECT_LT(tube.rms, 1e-9);
    EXPECT_LT(lineDistance(tube.a_A, a, b), 1e-9);
    EXPECT_LT(lineDistance(tube.b_A, a, b), 1e-9);
    const double half = (tube.b_A - tube.a_A).norm() / 2;
    EXPECT_LE(half, 0.02);
    EXPECT_GT(half, 0.018);  // two rings, 1 mm apart, short of the reach
  }
}

TEST(TubeFit, ClavicleIsATubeWithinItsStatedRms) {
  const Patient& patient = referencePatient();
  const SurfaceQuery query(patient);
  for (const char* third : {landmark::kMedialThird, landmark::kLateralThird}) {
    SurfaceQuery::Tube tube;
    ASSERT_TRUE(query.fitTube(1, patient.landmark(third), 0.02, &tube));
    RecordProperty(std::string("rms_um_") + third, static_cast<int>(1e6 * tube.rms));
    // The S bends by 0.2 / 66 mm over 20 mm of reach at the medial third: a sag of
    // 20^2 / (8 * 66) = 0.8 mm at its ends, weighted down; the lateral third bends twice as much
    // and is already oval.
    const bool medial = third == landmark::kMedialThird;
    EXPECT_LT(tube.rms, medial ? 0.4e-3 : 0.9e-3);
    EXPECT_NEAR(tube.radius, 0.006, medial ? 0.4e-3 : 1.2e-3);
  }
}

TEST(TubeFit, NothingWithinReachIsNoTube) {
  const SurfaceQuery query(
      patientOf(capsuleMesh({0, 0, 0}, {0.1, 0, 0}, 0.006, 50, 24), Organ::rib));
  SurfaceQuery::Tube tube;
  EXPECT_FALSE(query.fitTube(0, {0.05, 0.1, 0}, 0.02, &tube));
  EXPECT_FALSE(query.fitTube(0, {0.05, 0.00601, 0}, 1e-4, &tube));  // fewer than eight vertices
}

}  // namespace
}  // namespace palpa::anatomy
