#include <gtest/gtest.h>

#include <unistd.h>
#include <Eigen/Geometry>

#include <numbers>

#include "anatomy/base/error.h"
#include "anatomy/shapes/implicit_surface.h"
#include "anatomy/shapes/mesh_tools.h"
#include "anatomy/volume/ct_patient.h"
#include "anatomy/volume/scan.h"
#include "anatomy/volume/seed_file.h"
#include "anatomy/volume/volume.h"
#include "sample_volumes.h"
#include "tests/support/test_data.h"

namespace palpa::anatomy {
namespace {

using namespace test;

/// A chest of known shapes in Hounsfield units: hollow bones of cortex and marrow, lungs, and on
/// the right a vein as bright as cortex that passes one voxel (2 mm) below the clavicle. A rib
/// touches the left clavicle.
struct SyntheticChest {
  TubeField right{{{{-0.022, -0.055, 0}, 0.007},
                   {{-0.06, -0.06, 0.008}, 0.006},
                   {{-0.12, -0.02, 0.02}, 0.006}}};
  TubeField left{
      {{{0.022, -0.055, 0}, 0.007}, {{0.06, -0.06, 0.008}, 0.006}, {{0.12, -0.02, 0.02}, 0.006}}};
  TubeField vein{{{{-0.10, -0.045, -0.014}, 0.0045},
                  {{-0.05, -0.050, -0.0065}, 0.0045},
                  {{-0.022, -0.035, -0.02}, 0.0045},
                  {{-0.018, -0.03, -0.11}, 0.006}}};
  TubeField rib{
      {{{0.055, -0.0605, -0.006}, 0.005}, {{0.10, 0, -0.02}, 0.005}, {{0.05, 0.05, -0.01}, 0.005}}};
  TubeField spine{{{{0, 0.055, -0.2}, 0.018}, {{0, 0.055, 0.06}, 0.018}}};
  TubeField sternum{{{{0, -0.067, -0.012}, 0.008}, {{0, -0.072, -0.12}, 0.008}}};

  float at(const Vec3& p) const {
    if (std::hypot(p.x() / 0.15, p.y() / 0.088) > 1) return -1000;
    if (vein(p) < 0) return 700;
    for (const TubeField* bone : {&right, &left, &rib, &spine, &sternum})
      if (const double d = (*bone)(p); d < 0) return d < -0.002 ? 260 : 700;
    for (const double side : {-1.0, 1.0})
      if (((p - Vec3(side * 0.065, 0, -0.1)).array() / Eigen::Array3d(0.045, 0.05, 0.08))
              .matrix()
              .norm() < 1)
        return -850;
    return 50;
  }
  Volume volume() const {
    return sampled({154, 94, 92}, Mat3(0.002 * Mat3::Identity()), {-0.153, -0.093, -0.15},
                   [this](const Vec3& p) { return at(p); });
  }
};

Mask truth(const Scan& scan, const TubeField& shape) {
  Mask mask(scan.body.size());
  for (std::size_t n = 0; n < mask.size(); ++n) mask[n] = shape(scan.place(n)) < 0;
  return mask;
}

double share(const Mask& of, const Mask& in) {
  double both = 0, all = 0;
  for (std::size_t n = 0; n < of.size(); ++n) all += of[n], both += of[n] && in[n];
  return all > 0 ? both / all : 0;
}

TEST(Segmentation, VeinAndClaviclesOfOneBrightnessArePartedByTheirShape) {
  const SyntheticChest chest;
  const Volume volume = chest.volume();
  EXPECT_EQ(probableFlip(volume, levelsOf(volume)), "");
  Volume turned = volume;
  overrideAxes("LAI", false, &turned);
  EXPECT_NE(probableFlip(turned, levelsOf(turned)).find("--ct-axes LPS"), std::string::npos);
  const Scan scan = prepareScan(volume, levelsOf(volume));
  const std::optional<Vein> vein = findVein(scan, {});
  ASSERT_TRUE(vein);
  EXPECT_EQ(vein->side, Side::right);
  EXPECT_EQ(piecesOf(scan.grid, vein->mask).voxels.size(), 2u)
      << "one piece from armpit to vena cava";
  const Clavicles clavicles = findClavicles(scan, dilated(scan.grid, vein->mask, 1e-3), {});
  ASSERT_TRUE(clavicles.right && clavicles.left);
  const Mask right = truth(scan, chest.right), left = truth(scan, chest.left),
             lumen = truth(scan, chest.vein), rib = truth(scan, chest.rib);
  EXPECT_LT(share(right, vein->mask), 0.02);
  EXPECT_LT(share(lumen, clavicles.right->mask), 0.02);
  EXPECT_GT(share(right, clavicles.right->mask), 0.85);  // a sleeve about the vein is nobody's
  EXPECT_GT(share(left, clavicles.left->mask), 0.90);
  EXPECT_LT(share(rib, clavicles.left->mask), 0.15);
  EXPECT_GT(share(vein->mask, lumen), 0.75);
  for (const auto* clavicle : {&clavicles.right, &clavicles.left}) {
    EXPECT_NEAR((*clavicle)->length, 0.111 + 0.013,
                0.012);  // the axis and its round ends; smoothing cuts its bend
    EXPECT_FALSE((*clavicle)->leaves_volume);
    EXPECT_LT(std::abs((*clavicle)->axis_S.front().x()), 0.03) << "begins at the sternum";
  }
}

TEST(LabelSurface, VolumeAndPlaceOfAnObliqueEllipsoid) {
  const Mat3 turn = Eigen::AngleAxisd(0.4, Vec3(1, -1, 2).normalized()).toRotationMatrix();
  Scan scan;
  const Vec3 centre(0.01, 0.02, -0.03), half(0.016, 0.011, 0.013);
  scan.volume = sampled({60, 56, 34}, turn * Vec3(0.9e-3, 1e-3, 1.8e-3).asDiagonal(),
                        centre - turn * Vec3(0.027, 0.028, 0.03), [](const Vec3&) { return 0.f; });
  scan.grid = gridOf(scan.volume);
  Mask mask(scan.volume.values.size());
  for (std::size_t n = 0; n < mask.size(); ++n)
    mask[n] = ((scan.place(n) - centre).array() / half.array()).matrix().norm() < 1;
  const TriangleMesh mesh = labelSurface(scan, mask, nullptr, 1.2e-3, 1.5e-3);
  EXPECT_TRUE(isClosed(mesh));
  const double wanted = 4.0 / 3 * std::numbers::pi * half.prod();
  EXPECT_NEAR(signedVolume(mesh), wanted,
              0.04 * wanted);  // a blur of 1.2 mm takes s^2/r of the radius
  Vec3 middle = Vec3::Zero();
  for (const Vec3& p : mesh.points) middle += p / static_cast<double>(mesh.points.size());
  EXPECT_LT((middle - centre).norm(), 0.4e-3);
}

TEST(Distance, AgreesWithEveryPair) {
  VoxelGrid grid{{7, 6, 5}, Vec3(1e-3, 1.5e-3, 2.5e-3)};
  Mask mask(grid.count(), 0);
  for (const std::size_t n : {3u, 100u, 177u}) mask[n] = 1;
  const Values distance = distanceTo(grid, mask);
  for (std::size_t n = 0; n < mask.size(); ++n) {
    double least = 1;
    for (const std::size_t m : {3u, 100u, 177u}) {
      const Index3 a = grid.cell(n), b = grid.cell(m);
      least = std::min(
          least, Vec3((a[0] - b[0]) * 1e-3, (a[1] - b[1]) * 1.5e-3, (a[2] - b[2]) * 2.5e-3).norm());
    }
    ASSERT_NEAR(distance[n], least, 1e-7);
  }
}

TEST(SeedFile, ComesBackAndRefusesTheUnknown) {
  const std::filesystem::path file = std::filesystem::temp_directory_path() /
                                     ("palpa_seeds_" + std::to_string(::getpid()) + ".json");
  Seeds seeds;
  addSeed("vein_svc=149.1,-201.1,-80", &seeds);
  writeSeeds(seeds, file);
  EXPECT_LT((readSeeds(file).at("vein_svc") - Vec3(0.1491, -0.2011, -0.08)).norm(), 1e-9);
  EXPECT_EQ(seedOption("vein_svc", seeds["vein_svc"]), "--seed-point vein_svc=149.1,-201.1,-80.0");
  for (const char* wrong :
       {"vein_svc", "vein_svc=1,2", "nose=1,2,3", "vein_svc=1,2,3,4", "vein_svc=nan,2,3"})
    EXPECT_THROW(addSeed(wrong, &seeds), UsageError) << wrong;
  std::filesystem::remove(file);
}

TEST(RealScan, BothClaviclesVeinAsOneTubeEverythingClosed) {
  const std::filesystem::path file = testData("ct/chest_contrast_lidc2.mha");
  PALPA_NEED_DATA(file);
  Volume volume = readVolume(file);
  EXPECT_NE(probableFlip(volume, levelsOf(volume)).find("--ct-axes LAI"), std::string::npos);
  overrideAxes("LAI", false, &volume);
  const CtPatient ct = buildCtPatient(volume, {});
  EXPECT_EQ(ct.patient.side, Side::right);
  std::size_t triangles = 0;
  int clavicles = 0, ribs = 0;
  for (const OrganSurface& organ : ct.patient.organs) {
    EXPECT_TRUE(isClosed(organ.mesh)) << organ.id;
    EXPECT_GT(signedVolume(organ.mesh), 0) << organ.id;
    triangles += organ.mesh.triangles.size();
    clavicles += organ.organ == Organ::clavicle, ribs += organ.organ == Organ::rib;
  }
  EXPECT_LE(triangles, 300'000u);
  EXPECT_EQ(clavicles, 2);
  EXPECT_GE(ribs, 10);
  EXPECT_NO_THROW(ct.patient.organ(Organ::vein));
  EXPECT_NO_THROW(ct.patient.organ(Organ::sternum));
  const Vec3 chord =
      ct.patient.landmark(landmark::kSternalEnd) - ct.patient.landmark(landmark::kAcromialEnd);
  EXPECT_GT(chord.norm(), 0.11);
  EXPECT_LT(chord.norm(), 0.18);
}

}  // namespace
}  // namespace palpa::anatomy
