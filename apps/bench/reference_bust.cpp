#include "apps/bench/reference_bust.h"

#include "anatomy/parametric_patient.h"
#include "apps/station/assets.h"

namespace palpa::bench {

anatomy::Patient referenceBust() {
  anatomy::PatientParameters parameters = anatomy::drawParameters(
      anatomy::readPopulation(station::assetFile("patients/reference.json").string()),
      anatomy::Side::right, 0);
  parameters.extent = anatomy::Extent::bust;
  return anatomy::buildPatient(parameters);
}

Pose lookAt(const Vec3& eye_A, const Vec3& target_A) {
  const Vec3 z = (target_A - eye_A).normalized(), x = z.cross(Vec3::UnitZ()).normalized();
  Mat3 R_AC;
  R_AC << x, z.cross(x), z;
  return makePose(R_AC, eye_A).inverse();
}

}  // namespace palpa::bench
