#include "anatomy/patient/patient_check.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>

#include "anatomy/base/error.h"
#include "test_shapes.h"

namespace palpa::anatomy {
namespace {

bool ok(const Patient& patient, const std::string& what) {
  for (const PatientFinding& f : checkPatient(patient))
    if (f.name == what) return f.ok;
  ADD_FAILURE() << "no finding " << what;
  return false;
}

std::size_t indexOf(const Patient& patient, Organ organ) {
  for (std::size_t i = 0; i < patient.organs.size(); ++i)
    if (patient.organs[i].organ == organ) return i;
  return patient.organs.size();
}

TEST(PatientCheck, NoticesAnEntryThatIsTooSteepAndAWrongTarget) {
  Patient patient = referencePatient();
  patient.landmarks[landmark::kEntry] += Vec3(0.012, 0, 0);  // over the needle's way: steeper
  EXPECT_FALSE(ok(patient, "entry point off the skin") && ok(patient, "needle to skin"));
  patient = referencePatient();
  patient.landmarks[landmark::kVeinTarget] += Vec3(0, 0.012, 0);
  EXPECT_FALSE(ok(patient, "target inside the vein"));
}

TEST(PatientCheck, NoticesAVesselInTheBone) {
  Patient patient = referencePatient();
  const Vec3 into =
      patient.landmark(landmark::kMedialThird) - patient.landmark(landmark::kVeinTarget);
  for (Vec3& p : patient.organs[indexOf(patient, Organ::artery)].mesh.points) p += into;
  bool noticed = false;
  for (const PatientFinding& f : checkPatient(patient))
    noticed |= f.name.starts_with("gap") && f.name.find("arteries") != std::string::npos && !f.ok;
  EXPECT_TRUE(noticed);
}

TEST(PatientCheck, NoticesAnOpenSurface) {
  Patient patient = referencePatient();
  EXPECT_TRUE(ok(patient, "surfaces open or inside out"));
  patient.organs[indexOf(patient, Organ::rib)].mesh.triangles.pop_back();
  EXPECT_FALSE(ok(patient, "surfaces open or inside out"));
}

TEST(PatientCheck, NeedsItsLandmarksAndOrgans) {
  Patient patient = referencePatient();
  patient.landmarks.erase(landmark::kVeinTarget);
  EXPECT_THROW(checkPatient(patient), Error);
  patient = referencePatient();
  std::erase_if(patient.organs, [](const OrganSurface& o) { return o.organ == Organ::lung; });
  EXPECT_THROW(checkPatient(patient), Error);
}

/// Everything of the patient, or only what `which` names, moved.
template <class Which>
Patient moved(Patient patient, const Pose& X, Which which) {
  for (OrganSurface& organ : patient.organs) {
    if (!which(name(organ.organ))) continue;
    for (Vec3& p : organ.mesh.points) p = X * p;
    for (Vec3& n : organ.mesh.normals) n = X.rotation() * n;
  }
  for (auto& [landmark, p] : patient.landmarks)
    if (which(landmark)) p = X * p;
  return patient;
}

bool everything(const std::string&) { return true; }

Pose turnedAbout(const Vec3& centre, double degrees, const Vec3& axis) {
  const Mat3 R = Eigen::AngleAxisd(degrees * M_PI / 180, axis).toRotationMatrix();
  return makePose(R, centre - R * centre);
}

/// Left and right exchanged, and nobody is told which side it is now.
Patient mirrored(Patient patient) {
  const auto flip = [](Vec3& v) { v.x() = -v.x(); };
  for (OrganSurface& organ : patient.organs) {
    for (Vec3& p : organ.mesh.points) flip(p);
    for (Vec3& n : organ.mesh.normals) flip(n);
    for (auto& t : organ.mesh.triangles) std::swap(t[1], t[2]);
  }
  for (auto& [landmark, p] : patient.landmarks) flip(p);
  return patient;
}

Patient onTheOtherSide(Patient patient) {
  patient.side = patient.side == Side::right ? Side::left : Side::right;
  return patient;
}

Patient exchanged(Patient patient, Organ a, Organ b) {
  for (OrganSurface& organ : patient.organs)
    organ.organ = organ.organ == a ? b : organ.organ == b ? a : organ.organ;
  return patient;
}

/// The clavicle with its landmarks about its sternal end, as a raised arm takes it along.
Patient withArmRaised(const Patient& patient, double degrees) {
  const Vec3 chord =
      patient.landmark(landmark::kAcromialEnd) - patient.landmark(landmark::kSternalEnd);
  const Pose up = turnedAbout(patient.landmark(landmark::kSternalEnd), degrees,
                              chord.cross(Vec3::UnitZ()).normalized());
  return moved(patient, up, [](const std::string& what) { return what.starts_with("clavicle"); });
}

/// Who can be scored, and with what clause who cannot; printed as a table.
TEST(WhoIsScored, ByTheTaughtLineOfEachBody) {
  const Patient reference = referencePatient();
  struct Row {
    const char* what;
    Patient patient;
    const char* refused;  ///< part of the clause; empty: scored
  };
  const Row rows[] = {
      {"the reference patient", reference, ""},
      {"mirrored, as the other side", onTheOtherSide(mirrored(reference)), ""},
      {"mirrored, the side not changed", mirrored(reference), "medial part of the direction"},
      {"table tilted head down by 15 degrees",
       moved(reference, turnedAbout(Vec3::Zero(), 15, Vec3::UnitX()), everything), ""},
      {"table tilted head up by 15 degrees",
       moved(reference, turnedAbout(Vec3::Zero(), -15, Vec3::UnitX()), everything), ""},
      {"table tilted to the side by 15 degrees",
       moved(reference, turnedAbout(Vec3::Zero(), 15, Vec3::UnitZ()), everything), ""},
      {"artery and vein exchanged", exchanged(reference, Organ::artery, Organ::vein),
       "what the needle meets first (artery)"},
      {"lung and vein exchanged", exchanged(reference, Organ::lung, Organ::vein),
       "what the needle meets first (lung)"},
      {"arm raised by 30 degrees", withArmRaised(reference, 30), "needle axis to clavicle"},
      {"arm raised by 60 degrees", withArmRaised(reference, 60), "this patient's taught line"}};
  for (const Row& row : rows) {
    const std::string why = whyNotScored(row.patient, SurfaceQuery(row.patient));
    std::printf("| %s | %s |\n", row.what, why.empty() ? "scored" : ("not scored: " + why).c_str());
    if (*row.refused == 0)
      EXPECT_EQ(why, "") << row.what;
    else
      EXPECT_NE(why.find(row.refused), std::string::npos) << row.what << ": " << why;
  }
}

}  // namespace
}  // namespace palpa::anatomy
