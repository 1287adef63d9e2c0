#include "anatomy/import/import_patient.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

#include "anatomy/base/error.h"
#include "anatomy/import/propose_landmarks.h"
#include "anatomy/patient/patient_check.h"
#include "anatomy/patient/patient_file.h"
#include "anatomy/shapes/mesh_tools.h"
#include "round_meshes.h"
#include "sample_meshes.h"
#include "tests/support/scratch_folder.h"

namespace palpa::anatomy {
namespace {

using namespace test;
using namespace palpa::test;
namespace fs = std::filesystem;

void put(const fs::path& file, const std::string& bytes) {
  std::ofstream(file, std::ios::binary) << bytes;
}

/// An ellipsoid; sizes are half axes.
RawMesh lump(const Vec3& half, const Vec3& centre, int rings = 24) {
  RawMesh mesh = ball(1, rings, 2 * rings);
  for (Vec3& p : mesh.points) p = p.cwiseProduct(half) + centre;
  return mesh;
}

/// Two clavicles, a sternum and a rib, each in another format, unit or set of axes. Frame LPS, the
/// notch at (0, 100, 1400) mm.
class Import : public testing::Test {
 protected:
  void SetUp() override {
    put(folder / "right.obj", asObj(lump({70, 6, 6}, {-90, 100, 1402})));
    put(folder / "left.stl", asStl(lump({7.0, 0.6, 0.6}, {9.0, 140.2, -10.0}), false));   // cm, LSA
    put(folder / "sternum.ply", asPly(lump({0.020, 0.004, 0.08}, {0, 0.1, 1.32}), 'l'));  // m
    RawMesh rib = lump({60, 40, 8}, {-60, 60, 1300});
    for (Vec3& p : rib.points)
      p = Vec3(p.x() / 2, -p.y() / 2, -p.z() / 2 - 5);  // what its nodes turn it back from
    put(folder / "rib.glb", asGlb(rib));
  }

  static std::string map(const std::string& right_unit = "mm") {
    return R"({"format":"palpa-import-map","version":1,"name":"small","side":"right","unit":"mm","axes":"LPS","licence":"CC0-1.0",)"
           R"("source":"made by a test","entries":[{"file":"right.obj","id":"clavicle_right","organ":"clavicle","unit":")" +
           right_unit +
           R"("},{"file":"left.stl","id":"clavicle_left","organ":"clavicle","unit":"cm","axes":"LSA","licence":"CC-BY-4.0","source":"somebody"},)"
           R"({"file":"sternum.ply","id":"sternum","organ":"sternum","unit":"m","colour":[1,0,0]},)"
           R"({"file":"rib.glb","id":"rib","organ":"rib","mesh":"box"}]})";
  }

  ScratchFolder folder{"import"};
  ImportReport report;
};

Vec3 middleOf(const OrganSurface& organ) {
  Eigen::AlignedBox3d box;
  for (const Vec3& p : organ.mesh.points) box.extend(p);
  return box.center();
}

TEST_F(Import, FilesOfEveryFormatBecomeOnePatient) {
  const Patient patient = importPatient(parseImportMap(map(), "map"), folder.path(), {}, &report);
  ASSERT_EQ(patient.organs.size(), 4u);
  for (const OrganSurface& organ : patient.organs) {
    EXPECT_TRUE(isClosed(organ.mesh)) << organ.id;
    EXPECT_GT(signedVolume(organ.mesh), 0) << organ.id;
    ASSERT_EQ(organ.mesh.normals.size(), organ.mesh.points.size());
  }
  // The sternum's upper end is the notch, and the origin.
  EXPECT_LT((report.origin - Vec3(0, 0.1, 1.4)).norm(), 1e-6);
  EXPECT_LT(patient.landmark(landmark::kNotch).norm(), 1e-6);
  EXPECT_LT((middleOf(patient.organs[0]) - Vec3(-0.09, 0, 0.002)).norm(), 1e-6);
  EXPECT_LT((middleOf(patient.organs[1]) - Vec3(0.09, 0, 0.002)).norm(), 1e-6);
  EXPECT_EQ(report.surfaces[0].longest, 0.14);
  const std::vector<std::string> lines = words(report);
  EXPECT_EQ(lines[0], "clavicle_right, clavicle, 140 mm long, from right.obj (in millimetres)");
}

TEST_F(Import, LandmarksComeFromTheClavicleOfThePuncturedSide) {
  const Patient patient = importPatient(parseImportMap(map(), "map"), folder.path(), {}, &report);
  const auto at = [&](const char* key) { return patient.landmark(key); };
  EXPECT_LT((at(landmark::kSternalEnd) - Vec3(-0.022, 0, 0.002)).norm(), 5e-4);
  EXPECT_LT((at(landmark::kAcromialEnd) - Vec3(-0.158, 0, 0.002)).norm(), 5e-4);
  EXPECT_LT((at(landmark::kMedialThird) - Vec3(-0.020 - 0.14 / 3, 0, 0.002)).norm(), 5e-4);
  EXPECT_LT((at(landmark::kLateralThird) - Vec3(-0.020 - 0.28 / 3, 0, 0.002)).norm(), 5e-4);
  EXPECT_GT(at(landmark::kSternalEndPosteriorSuperior).z(), at(landmark::kSternalEnd).z());
  EXPECT_NE(report.landmarks.back().find("entry_point, vein_target"), std::string::npos);
}

TEST_F(Import, WhatTheMapSaysIsNotProposed) {
  std::string text = map();
  text.insert(
      text.size() - 1,
      R"(,"landmarks":{"clavicle_sternal_end":{"at":[-20,100,1400]}},"origin":{"at":[0,100,1300]})");
  const Patient patient = importPatient(parseImportMap(text, "map"), folder.path(), {}, &report);
  EXPECT_LT((patient.landmark(landmark::kSternalEnd) - Vec3(-0.02, 0, 0.1)).norm(), 1e-12);
  EXPECT_LT((patient.landmark(landmark::kNotch) - Vec3(0, 0, 0.1)).norm(), 1e-6);
}

TEST_F(Import, AWrongUnitIsRefusedWithTheLikelyOne) {
  try {
    importPatient(parseImportMap(map("m"), "map"), folder.path(), {}, &report);
    FAIL() << "a clavicle of 140 m";
  } catch (const UsageError& error) {
    const std::string words = error.what();
    EXPECT_NE(words.find("would be a clavicle of 140 m, read in metres"), std::string::npos)
        << words;
    EXPECT_NE(words.find("--unit mm"), std::string::npos) << words;
  }
}

TEST_F(Import, AFileOrSurfaceThatIsNotThereIsNamed) {
  std::string text = map();
  text.replace(text.find("\"box\""), 5, "\"bag\"");
  try {
    importPatient(parseImportMap(text, "map"), folder.path(), {}, &report);
    FAIL();
  } catch (const UsageError& error) {
    EXPECT_NE(std::string(error.what()).find("\"bag\". It has box"), std::string::npos)
        << error.what();
  }
  fs::remove(folder / "left.stl");
  EXPECT_THROW(importPatient(parseImportMap(map(), "map"), folder.path(), {}, &report), Error);
}

TEST_F(Import, AMirroredPatientIsMirroredWholeAndStaysClosed) {
  std::string text = map();
  text.replace(text.find(R"("axes":"LPS")"), 12, R"("axes":"RPS","left_handed":true)");
  text.replace(text.find(R"("unit":"cm","axes":"LSA")"), 24,
               R"("unit":"cm","axes":"RSA","left_handed":true)");
  const Patient patient = importPatient(parseImportMap(text, "map"), folder.path(), {}, &report);
  EXPECT_GT(middleOf(patient.organs[0]).x(), 0);
  for (const OrganSurface& organ : patient.organs)
    EXPECT_GT(signedVolume(organ.mesh), 0) << organ.id;
}

TEST_F(Import, TheBudgetIsSharedAndKept) {
  const Patient patient =
      importPatient(parseImportMap(map(), "map"), folder.path(), {2000, kWeldTolerance}, &report);
  std::size_t count = 0;
  for (std::size_t i = 0; i < patient.organs.size(); ++i) {
    count += patient.organs[i].mesh.triangles.size();
    EXPECT_TRUE(isClosed(patient.organs[i].mesh));
    EXPECT_GT(report.surfaces[i].decimation.farthest, 0);
    EXPECT_LT(report.surfaces[i].decimation.farthest, 3e-3);
  }
  EXPECT_LE(count, 2000u);
  EXPECT_THROW(importPatient(parseImportMap(map(), "map"), folder.path(), {500, 0}, &report),
               UsageError);
}

TEST_F(Import, TheFileCarriesLicencesTissueAndSourceAndIsNotForTheNeedle) {
  const Patient patient = importPatient(parseImportMap(map(), "map"), folder.path(), {}, &report);
  writePatient(patient, folder / "p.glb");
  const Patient read = readPatient(folder / "p.glb");
  EXPECT_EQ(read.licence, "CC0-1.0");
  EXPECT_EQ(read.source, "made by a test");
  EXPECT_EQ(read.organs[1].licence, "CC-BY-4.0");
  EXPECT_EQ(read.organs[1].source, "somebody");
  EXPECT_EQ(read.organs[0].licence, "");
  EXPECT_EQ(read.landmarks.size(), patient.landmarks.size());
  const std::vector<std::string> missing = missingForNeedle(read);
  EXPECT_EQ(missing,
            (std::vector<std::string>{"the organ skin", "the organ vein", "the organ lung",
                                      "the landmark entry_point", "the landmark vein_target"}));
  EXPECT_THROW(requireForNeedle(read, "p.glb"), Error);
}

}  // namespace
}  // namespace palpa::anatomy
