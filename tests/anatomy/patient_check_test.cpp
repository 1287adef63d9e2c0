#include "anatomy/patient/patient_check.h"

#include <gtest/gtest.h>

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

}  // namespace
}  // namespace palpa::anatomy
