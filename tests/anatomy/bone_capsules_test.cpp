#include "anatomy/query/bone_capsules.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "test_shapes.h"
#include "tests/support/capsule_distance.h"

namespace palpa::anatomy {
namespace {

constexpr int kMost = LocalGeometry::kMaxBones;

int surfaceOf(const Patient& patient, Organ organ) {
  for (std::size_t i = 0; i < patient.organs.size(); ++i)
    if (patient.organs[i].organ == organ) return static_cast<int>(i);
  throw std::runtime_error("no such organ");
}

/// The middles of some facets: places where the mesh is touched, and that no fit has seen.
std::vector<SurfacePoint> places(const SurfaceQuery& query, const Patient& patient, int surface,
                                 std::size_t count) {
  const TriangleMesh& mesh = patient.organs[surface].mesh;
  std::vector<SurfacePoint> found;
  for (std::size_t i = 0; i < mesh.triangles.size();
       i += std::max<std::size_t>(mesh.triangles.size() / count, 1)) {
    Vec3 middle = Vec3::Zero();
    for (const std::uint32_t corner : mesh.triangles[i]) middle += mesh.points[corner] / 3;
    found.push_back(query.closest(surface, middle));
  }
  return found;
}

TEST(BoneCapsules, FitTheWholeOfEveryClavicleAndRib) {
  const Patient& patient = referencePatient();
  double worst_rib = 0;
  int clavicles = 0, ribs = 0;
  for (const OrganSurface& bone : patient.organs) {
    if (bone.organ != Organ::clavicle && bone.organ != Organ::rib) continue;
    const BoneCapsules capsules(bone.mesh);
    ASSERT_FALSE(capsules.rods().empty());
    EXPECT_LE(capsules.rods().size(), 48u);
    const double off = measure::misfit(bone.mesh, measure::capsulesOf(capsules.rods()));
    EXPECT_LT(off, 1e-3) << bone.id;
    if (bone.organ == Organ::clavicle) {
      ++clavicles;
      RecordProperty("whole_clavicle_um", static_cast<int>(1e6 * off));
    } else {
      ++ribs;
      worst_rib = std::max(worst_rib, off);
    }
  }
  EXPECT_GT(clavicles, 0);
  EXPECT_GT(ribs, 0);
  RecordProperty("worst_rib_um", static_cast<int>(1e6 * worst_rib));
}

TEST(BoneCapsules, FitRoundEveryTouchedPlace) {
  const Patient& patient = referencePatient();
  const SurfaceQuery query(patient);
  for (const Organ organ : {Organ::clavicle, Organ::rib}) {
    const int surface = surfaceOf(patient, organ);
    const TriangleMesh& mesh = patient.organs[surface].mesh;
    const BoneCapsules bone(mesh);
    double chains = 0, singles = 0, worst = 0;
    for (const SurfacePoint& at : places(query, patient, surface, 60)) {
      const std::vector<Capsule> chain = bone.near(at, kMost);
      ASSERT_FALSE(chain.empty());
      ASSERT_LE(chain.size(), static_cast<std::size_t>(kMost));
      const double off = measure::misfit(mesh, chain, at.p_A, 0.024);
      EXPECT_LT(off, 1e-3);
      worst = std::max(worst, off);
      chains += off;
      singles += measure::misfit(mesh, {measure::lengthened(chain[0], 0.016)}, at.p_A, 0.024);
    }
    RecordProperty(std::string(name(organ)) + "_worst_um", static_cast<int>(1e6 * worst));
    EXPECT_LT(chains, 0.7 * singles);
  }
}

/// The force is right where the tool is: the first capsule touches with the mesh's normal, no other
/// one covers the place.
TEST(BoneCapsules, TouchTheMeshWhereItIsTouched) {
  const Patient& patient = referencePatient();
  const SurfaceQuery query(patient);
  const int surface = surfaceOf(patient, Organ::clavicle);
  const BoneCapsules bone(patient.organs[surface].mesh);
  for (const SurfacePoint& at : places(query, patient, surface, 60)) {
    const std::vector<Capsule> chain = bone.near(at, kMost);
    Vec3 n = Vec3::Zero();
    EXPECT_NEAR(measure::distanceTo(chain[0], at.p_A, &n), 0, 1e-9);
    EXPECT_LT((n - at.n_A).norm(), 1e-6);
    EXPECT_NEAR(measure::distanceTo(chain, at.p_A), 0, 1e-9);
    // Pressed in, it is still the deepest.
    const Vec3 pressed = at.p_A - 1e-3 * at.n_A;
    EXPECT_NEAR(measure::distanceTo(chain, pressed), -1e-3, 1e-9);
  }
}

/// A hand slides along the bone at 50 mm/s, 1 mm deep, with snapshots at 60 Hz; each takes over in
/// 10 ticks.
TEST(BoneCapsules, ANewSnapshotHardlyMovesTheForce) {
  constexpr double kSlide = 0.05 / 60, kDeep = 1e-3, kStiffness = 1000, kBlend = 10;
  const Patient& patient = referencePatient();
  const SurfaceQuery query(patient);
  const int surface = surfaceOf(patient, Organ::clavicle);
  const BoneCapsules bone(patient.organs[surface].mesh);
  double squares = 0, most = 0;
  int count = 0;
  for (const SurfacePoint& at : places(query, patient, surface, 100)) {
    const Vec3 east = at.n_A.cross(Vec3(0.3, 0.5, 0.8)).normalized(), north = at.n_A.cross(east);
    const std::vector<Capsule> old = bone.near(at, kMost);
    for (const double way : {0.3, 1.9, 3.4, 5.0}) {
      const Vec3 moved = at.p_A + kSlide * (std::cos(way) * east + std::sin(way) * north);
      const SurfacePoint next = query.closest(surface, moved);
      const Vec3 tool = next.p_A - kDeep * next.n_A;
      Vec3 n_old = Vec3::Zero(), n_new = Vec3::Zero();
      const double d_old = measure::distanceTo(old, tool, &n_old);
      const double d_new = measure::distanceTo(bone.near(next, kMost), tool, &n_new);
      const double jump = kStiffness / kBlend *
                          (std::min(d_old, 0.0) * n_old - std::min(d_new, 0.0) * n_new).norm();
      squares += jump * jump;
      most = std::max(most, jump);
      ++count;
    }
  }
  RecordProperty("jump_rms_mN", static_cast<int>(1e3 * std::sqrt(squares / count)));
  RecordProperty("jump_most_mN", static_cast<int>(1e3 * most));
  EXPECT_LT(std::sqrt(squares / count), 0.02);
}

TEST(BoneCapsules, AreOneStraightRowOnAStraightTube) {
  const Vec3 a(-0.05, 0, 0), b(0.05, 0, 0);
  const Patient patient = patientOf(capsuleMesh(a, b, 0.006, 101, 48), Organ::rib);
  const SurfaceQuery query(patient);
  const SurfacePoint at = query.closest(0, {0.003, 0.01, 0});
  const std::vector<Capsule> row = BoneCapsules(patient.organs[0].mesh).near(at, kMost);
  double low = 1, high = -1;
  for (const Capsule& capsule : row)
    for (const Packed3& end : {capsule.a, capsule.b}) {
      EXPECT_LT(std::hypot(end[1], end[2]), 5e-4);
      low = std::min(low, end[0] - capsule.radius);
      high = std::max(high, end[0] + capsule.radius);
    }
  EXPECT_LT(low, at.p_A.x() - 0.024);
  EXPECT_GT(high, at.p_A.x() + 0.024);
  EXPECT_LT(measure::misfit(patient.organs[0].mesh, row, at.p_A, 0.024), 2e-4);
}

TEST(BoneCapsules, EndWhereTheBoneEnds) {
  const Vec3 a(-0.05, 0, 0), b(0.05, 0, 0);
  const Patient patient = patientOf(capsuleMesh(a, b, 0.006, 101, 48), Organ::rib);
  const SurfaceQuery query(patient);
  const std::vector<Capsule> chain =
      BoneCapsules(patient.organs[0].mesh).near(query.closest(0, {0.049, 0.01, 0}), kMost);
  ASSERT_FALSE(chain.empty());
  for (const Capsule& capsule : chain)
    for (const Packed3& end : {capsule.a, capsule.b}) EXPECT_LT(end[0] + capsule.radius, 0.0575);
}

TEST(BoneCapsules, ARoundBoneIsTouchedFromEverySide) {
  const Vec3 middle(0.01, 0.02, 0.03);
  const Patient patient =
      patientOf(capsuleMesh(middle, middle + Vec3(1e-5, 0, 0), 0.006, 2, 48), Organ::rib);
  const SurfaceQuery query(patient);
  const BoneCapsules bone(patient.organs[0].mesh);
  for (const Vec3& way : {Vec3(1, 0, 0), Vec3(0, 1, 0), Vec3(0.6, 0, 0.8)}) {
    const std::vector<Capsule> chain = bone.near(query.closest(0, middle + 0.01 * way), kMost);
    ASSERT_FALSE(chain.empty());
    EXPECT_NEAR(measure::distanceTo(chain, middle + 0.01 * way), 0.004, 2e-4);
  }
}

TEST(BoneCapsules, ALargePlateHasNone) {
  const auto plate = [](const Vec3& p) {
    return (p.cwiseAbs() - Vec3(0.1, 0.1, 0.003)).maxCoeff();
  };
  const Vec3 corner(0.104, 0.104, 0.007);
  const Patient patient = patientOf(surfaceNets(plate, {-corner, corner}, 0.003), Organ::scapula);
  const SurfaceQuery query(patient);
  const BoneCapsules bone(patient.organs[0].mesh);
  EXPECT_GT(bone.rms(), 1e-3);
  EXPECT_TRUE(bone.near(query.closest(0, {0.01, 0.02, 0.01}), kMost).empty());
}

TEST(BoneCapsules, SameMeshSameBits) {
  const Patient& patient = referencePatient();
  const TriangleMesh& mesh = patient.organs[surfaceOf(patient, Organ::clavicle)].mesh;
  const BoneCapsules one(mesh), two(mesh);
  ASSERT_EQ(one.rods().size(), two.rods().size());
  for (std::size_t i = 0; i < one.rods().size(); ++i) {
    EXPECT_EQ(one.rods()[i].a, two.rods()[i].a);
    EXPECT_EQ(one.rods()[i].b, two.rods()[i].b);
    EXPECT_EQ(one.rods()[i].radius, two.rods()[i].radius);
  }
}

}  // namespace
}  // namespace palpa::anatomy
