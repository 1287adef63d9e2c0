#include "anatomy/capsule_chain.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "test_shapes.h"

namespace palpa::anatomy {
namespace {

double distanceTo(const Capsule& capsule, const Vec3& p) {
  const Vec3 a = unpack(capsule.a), core = unpack(capsule.b) - a;
  const double length2 = core.squaredNorm();
  const double t = length2 > 0 ? std::clamp((p - a).dot(core) / length2, 0.0, 1.0) : 0;
  return (p - a - t * core).norm() - capsule.radius;
}

double distanceTo(const std::vector<Capsule>& chain, const Vec3& p) {
  double least = 1;
  for (const Capsule& capsule : chain) least = std::min(least, distanceTo(capsule, p));
  return least;
}

/// How far, rms, a surface's points within `reach` of `near` lie off the capsules.
double misfit(const TriangleMesh& mesh, const std::vector<Capsule>& chain, const Vec3& near, double reach) {
  double squares = 0;
  int count = 0;
  for (const Vec3& p : mesh.points) {
    if ((p - near).norm() > reach) continue;
    squares += std::pow(distanceTo(chain, p), 2);
    ++count;
  }
  return count ? std::sqrt(squares / count) : 1;
}

TEST(CapsuleChain, FollowsTheClavicleWhereOneCapsuleDoesNot) {
  const Patient& patient = referencePatient();
  const SurfaceQuery query(patient);
  const TriangleMesh& clavicle = patient.organs[1].mesh;
  ASSERT_EQ(patient.organs[1].organ, Organ::clavicle);
  double chains = 0, singles = 0;
  int places = 0;
  for (std::size_t i = 0; i < clavicle.points.size(); i += clavicle.points.size() / 60) {
    const SurfacePoint near = query.closest(1, clavicle.points[i]);
    const std::vector<Capsule> chain = capsuleChain(query, 1, near);
    ASSERT_FALSE(chain.empty());
    if (chain.size() < 3) continue;  // an end
    // The middle link touches the mesh where it was made for.
    EXPECT_NEAR(distanceTo(chain[0], near.p_A), 0, 1e-9);
    Capsule single = chain[0];  // the same, as long as the chain
    const Vec3 a = unpack(single.a), b = unpack(single.b), along = (b - a).normalized();
    single.a = pack(Vec3(a - 0.016 * along));
    single.b = pack(Vec3(b + 0.016 * along));
    chains += misfit(clavicle, chain, near.p_A, 0.024);
    singles += misfit(clavicle, {single}, near.p_A, 0.024);
    ++places;
  }
  ASSERT_GT(places, 20);
  RecordProperty("chain_um", static_cast<int>(1e6 * chains / places));
  RecordProperty("single_um", static_cast<int>(1e6 * singles / places));
  EXPECT_LT(chains / places, 1e-3);  // the bone is oval, its capsules are round: 0.4 to 0.9 mm at their middle alone
  EXPECT_LT(chains, 0.7 * singles);
}

TEST(CapsuleChain, IsOneStraightRowOnAStraightTube) {
  const Vec3 a(-0.05, 0, 0), b(0.05, 0, 0);
  const SurfaceQuery query(patientOf(capsuleMesh(a, b, 0.006, 101, 48), Organ::rib));
  const std::vector<Capsule> chain = capsuleChain(query, 0, query.closest(0, {0.003, 0.01, 0}));
  ASSERT_EQ(chain.size(), 3u);
  double low = 1, high = -1;
  for (const Capsule& capsule : chain)
    for (const Packed3& end : {capsule.a, capsule.b}) {
      EXPECT_LT(std::hypot(end[1], end[2]), 2e-5);
      low = std::min(low, end[0]);
      high = std::max(high, end[0]);
    }
  EXPECT_NEAR(high - low, 0.048, 1e-6);
  EXPECT_NEAR(0.5 * (high + low), 0.003, 1e-4);
}

TEST(CapsuleChain, EndsWhereTheBoneEnds) {
  const Vec3 a(-0.05, 0, 0), b(0.05, 0, 0);
  const SurfaceQuery query(patientOf(capsuleMesh(a, b, 0.006, 101, 48), Organ::rib));
  const std::vector<Capsule> chain = capsuleChain(query, 0, query.closest(0, {0.049, 0.01, 0}));
  ASSERT_FALSE(chain.empty());
  for (const Capsule& capsule : chain)
    for (const Packed3& end : {capsule.a, capsule.b}) EXPECT_LT(end[0] + capsule.radius, 0.0575);
}

TEST(CapsuleChain, ARoundBoneIsTouchedFromEverySide) {
  const Vec3 middle(0.01, 0.02, 0.03);
  const SurfaceQuery query(patientOf(capsuleMesh(middle, middle + Vec3(1e-5, 0, 0), 0.006, 2, 48), Organ::rib));
  for (const Vec3& way : {Vec3(1, 0, 0), Vec3(0, 1, 0), Vec3(0.6, 0, 0.8)}) {
    const std::vector<Capsule> chain = capsuleChain(query, 0, query.closest(0, middle + 0.01 * way));
    ASSERT_EQ(chain.size(), 1u);
    EXPECT_NEAR(distanceTo(chain[0], middle + 0.01 * way), 0.004, 2e-4);
  }
}

}  // namespace
}  // namespace palpa::anatomy
