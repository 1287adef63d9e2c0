#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "anatomy/import/import_patient.h"
#include "anatomy/query/bone_capsules.h"
#include "anatomy/query/surface_query.h"
#include "anatomy/shapes/mesh_tools.h"
#include "tests/support/capsule_distance.h"
#include "tests/support/counts.h"
#include "tests/support/test_data.h"

/// Bones and skins that were not made here: what the program says of them against what is measured
/// on their points.
namespace palpa::anatomy {
namespace {

const char* const kClavicle = "FJ688_BP62325_FMA13322_Right_clavicle.glb";

std::string mapOf(const std::string& entries) {
  return R"({"format":"palpa-import-map","version":1,"name":"real","side":"right","unit":"mm","axes":"LPS","licence":"see its files","source":"see its files","entries":[)" +
         entries + "]}";
}

Patient imported(const std::filesystem::path& folder, const std::string& entries,
                 ImportReport* report) {
  return importPatient(parseImportMap(mapOf(entries), "map"), folder, {}, report);
}

Patient realClavicle(const std::filesystem::path& folder, ImportReport* report) {
  return imported(
      folder,
      R"({"file":")" + std::string(kClavicle) + R"(","id":"clavicle_right","organ":"clavicle"})",
      report);
}

/// The largest distance between two of the points.
double widest(const std::vector<Vec3>& points) {
  double squared = 0;
  for (const Vec3& a : points)
    for (const Vec3& b : points) squared = std::max(squared, (a - b).squaredNorm());
  return std::sqrt(squared);
}

TEST(RealAnatomy, TheClavicleIsAsLongAsItsPointsSay) {
  const auto folder = testData("anatomy/bodyparts3d_glb");
  PALPA_NEED_DATA(folder / kClavicle);
  ImportReport report;
  const Patient patient = realClavicle(folder, &report);
  const double direct = 1e-3 * widest(readMeshFile(folder / kClavicle)[0].points);
  EXPECT_NEAR(widest(patient.organs[0].mesh.points), direct, 1e-6);
  // The landmarks lie in sections 2 mm inside the ends of the long axis.
  const double between =
      (patient.landmark(landmark::kSternalEnd) - patient.landmark(landmark::kAcromialEnd)).norm();
  RecordProperty("widest_um", static_cast<int>(1e6 * direct));
  RecordProperty("landmarks_um", static_cast<int>(1e6 * between));
  EXPECT_NEAR(between + 0.004, direct, 1e-3);
  EXPECT_GT(direct, 0.12);
  EXPECT_LT(direct, 0.18);
}

struct Misfits {
  double sum_6_mm = 0, worst_48_mm = 0,
         sum_48_mm = 0;          // rms at a place: within 6 mm, along 48 mm of the bone
  int places = 0, vertices = 0;  // the vertices are some of the places
};

/// At the bone's vertices and the middles of its facets, every `step`-th.
Misfits misfitsOf(const Patient& patient, const BoneCapsules& bone, std::size_t step) {
  const SurfaceQuery query(patient);
  const TriangleMesh& mesh = patient.organs[0].mesh;
  std::vector<Vec3> at = mesh.points;
  for (const auto& t : mesh.triangles)
    at.push_back((mesh.points[t[0]] + mesh.points[t[1]] + mesh.points[t[2]]) / 3);
  Misfits misfits;
  for (std::size_t i = 0; i < at.size(); i += step) {
    const SurfacePoint near = query.closest(0, at[i]);
    const std::vector<Capsule> chain = bone.near(near, LocalGeometry::kMaxBones);
    EXPECT_FALSE(chain.empty());
    EXPECT_NEAR(measure::distanceTo(chain, near.p_A), 0, 1e-9);
    const double along = measure::misfit(mesh, chain, near.p_A, 0.024);
    misfits.worst_48_mm = std::max(misfits.worst_48_mm, along);
    misfits.sum_48_mm += along;
    ++misfits.places;
    if (i >= mesh.points.size()) continue;  // a large facet has no vertex within 6 mm of its middle
    misfits.sum_6_mm += measure::misfit(mesh, chain, near.p_A, 0.006);
    ++misfits.vertices;
  }
  return misfits;
}

TEST(RealAnatomy, CapsulesFitTheClavicleAndWhatIsNearAnyTouchedPlace) {
  const auto folder = testData("anatomy/bodyparts3d_glb");
  PALPA_NEED_DATA(folder / kClavicle);
  ImportReport report;
  const Patient patient = realClavicle(folder, &report);
  const TriangleMesh& mesh = patient.organs[0].mesh;
  const BoneCapsules bone(mesh);
  const double whole = measure::misfit(mesh, measure::capsulesOf(bone.rods()));
  RecordProperty("whole_um", static_cast<int>(1e6 * whole));
  RecordProperty("rods", static_cast<int>(bone.rods().size()));
  EXPECT_LT(whole, 1e-3);
  const Misfits misfits = misfitsOf(patient, bone, palpa::test::counted(8, 1));
  ASSERT_GT(misfits.places, 200);
  ASSERT_GT(misfits.vertices, 50);
  RecordProperty("along_48_mm_mean_um", static_cast<int>(1e6 * misfits.sum_48_mm / misfits.places));
  RecordProperty("along_48_mm_worst_um", static_cast<int>(1e6 * misfits.worst_48_mm));
  RecordProperty("within_6_mm_mean_um",
                 static_cast<int>(1e6 * misfits.sum_6_mm / misfits.vertices));
  EXPECT_LT(misfits.worst_48_mm, 1e-3);
  EXPECT_LT(misfits.sum_6_mm / misfits.vertices, 1e-3);
}

TEST(RealAnatomy, TheShippedMapsMakeAClosedSkeletonInsideItsSkin) {
  const auto folder = testData("anatomy");
  PALPA_NEED_DATA(folder / "hra_glb/VH_M_Skin.glb");
  const std::filesystem::path assets = std::filesystem::path(PALPA_SOURCE_DIR) / "assets/patients";
  ImportReport report;
  const Patient bones = importPatient(readImportMap(assets / "bodyparts3d_hra.json"), folder,
                                      {0, kWeldTolerance}, &report);
  EXPECT_EQ(bones.organs.size(), 53u);
  for (const OrganSurface& organ : bones.organs)
    EXPECT_TRUE(isClosed(organ.mesh) && signedVolume(organ.mesh) > 0) << organ.id;
  const Patient whole = importPatient(readImportMap(assets / "bodyparts3d_hra_skin.json"), folder,
                                      {0, kWeldTolerance}, &report);
  const SurfaceQuery query(whole);
  const int skin = static_cast<int>(whole.organs.size()) - 1;
  ASSERT_EQ(whole.organs.back().organ, Organ::skin);
  double shallowest = 1;
  for (const OrganSurface& organ : whole.organs)
    if (isBone(organ.organ))
      for (const Vec3& p : organ.mesh.points)
        shallowest = std::min(shallowest, -query.closest(skin, p).distance);
  RecordProperty("shallowest_bone_um", static_cast<int>(1e6 * shallowest));
  EXPECT_GT(shallowest, 5e-3);
}

/// Over the upper chest in front, where a needle goes in.
bool infraclavicular(const Vec3& p, const Vec3& n, double height) {
  return p.z() < height && p.z() > height - 0.12 && std::abs(p.x()) < 0.12 &&
         std::abs(p.x()) > 0.02 && n.y() < -0.3;
}

struct PatchErrors {
  double rounded = 0, facets = 0;  // largest, m
  int asked = 0;
};

/// Points within 5 mm of the place that a patch was made for: what the patch says, what the surface
/// says.
void comparePatch(const SurfaceQuery& query, const Vec3& p, PatchErrors* errors) {
  constexpr double kReach = 0.008, kAsked = 0.005;
  const SurfacePatch patch = fitSurfacePatch(query, 0, p, kReach);
  const Vec3 n = unpack(patch.n), x = unpack(patch.x), y = n.cross(x);
  for (int k = 0; k < 40; ++k) {
    const double angle = 2.4 * k, across = kAsked * std::sqrt(k / 40.0);
    Vec3 off =
        across * (std::cos(angle) * x + std::sin(angle) * y) + kAsked * std::sin(7.0 * k) * n;
    if (off.norm() > kAsked) off *= kAsked / off.norm();
    const double told = nearestOn(patch, p + off).distance;
    errors->rounded =
        std::max(errors->rounded, std::abs(told - query.rounded(0, p + off).distance));
    errors->facets = std::max(errors->facets, std::abs(told - query.closest(0, p + off).distance));
    ++errors->asked;
  }
}

TEST(RealAnatomy, ThePatchTellsTheDistanceToARealSkin) {
  const auto folder = testData("anatomy/hra_glb");
  PALPA_NEED_DATA(folder / "VH_M_Skin.glb");
  for (const auto& [file, height] :
       {std::pair{"VH_M_Skin.glb", 0.56}, std::pair{"VH_F_Skin.glb", 0.53}}) {
    ImportReport report;
    const std::string entry = R"({"file":")" + std::string(file) +
                              R"(","id":"skin","organ":"skin","unit":"m","axes":"LSA"})";
    const Patient patient =
        importPatient(parseImportMap(mapOf(entry), "map"), folder, {0, 0}, &report);
    const SurfaceQuery query(patient);
    const TriangleMesh& skin = patient.organs[0].mesh;
    PatchErrors errors;
    for (std::size_t i = 0; i < skin.points.size(); i += 5)
      if (infraclavicular(skin.points[i], skin.normals[i], height))
        comparePatch(query, skin.points[i], &errors);
    ASSERT_GT(errors.asked, 2000);
    RecordProperty(std::string(file) + "_rounded_um", static_cast<int>(1e6 * errors.rounded));
    RecordProperty(std::string(file) + "_facets_um", static_cast<int>(1e6 * errors.facets));
    EXPECT_LT(errors.rounded, 1e-4) << file;
  }
}

}  // namespace
}  // namespace palpa::anatomy
