#include "anatomy/parametric/phantoms.h"

#include <gtest/gtest.h>

#include "anatomy/base/error.h"
#include "anatomy/patient/patient_file.h"
#include "anatomy/query/surface_query.h"
#include "anatomy/shapes/mesh_tools.h"
#include "test_shapes.h"

namespace palpa::anatomy {
namespace {

Eigen::AlignedBox3d boxOf(const TriangleMesh& mesh) {
  Eigen::AlignedBox3d box;
  for (const Vec3& p : mesh.points) box.extend(p);
  return box;
}

/// Over the inclusion, toward the front; the base does not count.
double thinnestSilicone(const Patient& patient) {
  const SurfaceQuery query(patient);
  double least = 1;
  for (const Vec3& p : patient.organs.at(1).mesh.points) {
    const SurfacePoint skin = query.closest(0, p);
    EXPECT_LT(skin.distance, 0);
    if (skin.p_A.y() < -0.001) least = std::min(least, -skin.distance);
  }
  return least;
}

void expectSound(const Patient& patient) {
  for (const OrganSurface& organ : patient.organs) {
    EXPECT_TRUE(isClosed(organ.mesh)) << organ.id;
    EXPECT_GT(signedVolume(organ.mesh), 0) << organ.id;
  }
}

TEST(BreastPhantom, HasTheSizeOfItsDomeAndAFlatBase) {
  const Patient patient = buildPhantom({PhantomKind::breast, {}});
  expectSound(patient);
  const auto box = boxOf(patient.organ(Organ::skin).mesh);
  EXPECT_NEAR(box.sizes().x(), 0.120, 1e-3);
  EXPECT_NEAR(box.sizes().z(), 0.120, 1e-3);
  EXPECT_NEAR(box.sizes().y(), 0.045, 1e-3);
  EXPECT_NEAR(box.max().y(), 0, 2e-4);
  // Half an ellipsoid, less its rounded edge.
  EXPECT_NEAR(signedVolume(patient.organ(Organ::skin).mesh),
              2.0 / 3 * std::numbers::pi * 0.06 * 0.06 * 0.045, 4e-6);
}

TEST(BreastPhantom, InclusionHasItsDiameterAndDepthOnTheMeshes) {
  const PhantomInclusion cases[] = {
      {0.020, 0.015, 0, 0}, {0.008, 0.004, 0.02, -0.015}, {0.012, 0.010, -0.025, 0.01}};
  for (const PhantomInclusion& inclusion : cases) {
    const Patient patient = buildPhantom({PhantomKind::breast, inclusion});
    expectSound(patient);
    ASSERT_EQ(patient.organs.size(), 2u);
    for (int axis = 0; axis < 3; ++axis)
      EXPECT_NEAR(boxOf(patient.organs[1].mesh).sizes()[axis], inclusion.diameter,
                  0.02 * inclusion.diameter);
    EXPECT_NEAR(thinnestSilicone(patient), inclusion.depth, 3e-4);
    const Vec3& over = patient.landmark(landmark::kInclusionSkin);
    EXPECT_NEAR(over.x(), inclusion.left, 1e-9);
    EXPECT_NEAR(over.z(), inclusion.up, 1e-9);
    EXPECT_LT(std::abs(SurfaceQuery(patient).closest(0, over).distance), 3e-4);
  }
}

TEST(BreastPhantom, RefusesWhatDoesNotFit) {
  const auto breast = [](const PhantomInclusion& inclusion) {
    return buildPhantom({PhantomKind::breast, inclusion});
  };
  EXPECT_NO_THROW(breast({0.020, 0.020}));
  EXPECT_THROW(breast({0.020, 0.024}), Error);  // through the base
  EXPECT_THROW(breast({0.040, 0.015}), Error);
  EXPECT_THROW(breast({0.010, 0.005, 0.09, 0}), Error);  // beside it
  EXPECT_THROW(breast({0.001, 0.005}), Error);
  EXPECT_THROW(breast({std::nan(""), 0.005}), Error);
  EXPECT_THROW(breast({0.010, std::nan("")}), Error);
  EXPECT_THROW(breast({0.010, 0.005, std::nan(""), 0}), Error);
}

TEST(AbdomenPhantom, HasItsSizeAndAnUmbilicus) {
  const Patient patient = buildPhantom({PhantomKind::abdomen, {}});
  expectSound(patient);
  const auto box = boxOf(patient.organ(Organ::skin).mesh);
  EXPECT_NEAR(box.sizes().x(), 0.260, 2e-3);
  EXPECT_NEAR(box.sizes().z(), 0.200, 2e-3);
  EXPECT_NEAR(box.sizes().y(), 0.080, 2e-3);
  const SurfaceQuery query(patient);
  const auto height = [&](double z) { return query.cast({0, -0.12, z}, {0, 1, 0}, 0.1).front().s; };
  EXPECT_GT(height(-0.025), height(-0.010) + 0.005);
  EXPECT_GT(height(-0.025), height(-0.040) + 0.005);
}

TEST(AbdomenPhantom, LiverEdgeLiesAtItsDepth) {
  for (const PhantomInclusion& inclusion :
       {PhantomInclusion{0.020, 0.015}, PhantomInclusion{0.016, 0.010}}) {
    const Patient patient = buildPhantom({PhantomKind::abdomen, inclusion});
    expectSound(patient);
    EXPECT_EQ(patient.organs.at(1).organ, Organ::inclusion);
    // From the skin inward: the liver begins at its depth; a diameter above its edge it is about
    // that thick.
    const Vec3 skin = patient.landmark(landmark::kInclusionSkin),
               inward = (patient.landmark(landmark::kInclusion) - skin).normalized();
    std::vector<double> liver;
    for (const RayHit& hit : SurfaceQuery(patient).cast(skin - 0.01 * inward, inward, 0.1))
      if (hit.surface == 1) liver.push_back(hit.s - 0.01);
    ASSERT_EQ(liver.size(), 2u);
    EXPECT_NEAR(liver[0], inclusion.depth, 1e-3);
    EXPECT_NEAR(liver[1] - liver[0], inclusion.diameter, 0.2 * inclusion.diameter);
    EXPECT_GT(thinnestSilicone(patient), inclusion.depth - 5e-4);
  }
  EXPECT_THROW(buildPhantom({PhantomKind::abdomen, PhantomInclusion{0.06, 0.03}}), Error);
}

TEST(Phantom, GoesThroughAFile) {
  const ScratchFolder folder("phantom");
  const Patient written = buildPhantom({PhantomKind::breast, PhantomInclusion{}});
  writePatient(written, folder / "b.glb");
  const Patient read = readPatient(folder / "b.glb");
  EXPECT_EQ(read.organs.at(1).organ, Organ::inclusion);
  EXPECT_EQ(read.organs.at(1).mesh.triangles, written.organs[1].mesh.triangles);
  EXPECT_TRUE(read.organs.at(0).texture.rgb.empty());
}

}  // namespace
}  // namespace palpa::anatomy
