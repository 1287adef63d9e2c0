#include "apps/assess/needle/teaching_line.h"

namespace palpa::assess {

calibration::TeachingLine teachingLineOf(const anatomy::Patient& patient,
                                         const anatomy::SurfaceQuery& query) {
  const anatomy::LandmarkFrame frame(patient);
  const Vec3& entry_A = patient.landmark(anatomy::landmark::kEntry);
  const auto skin = static_cast<int>(&patient.organ(Organ::skin) - patient.organs.data());
  return {frame.pointToLandmarks(entry_A),
          frame.vectorToLandmarks(-query.closest(skin, entry_A).n_A),
          frame.pointToLandmarks(patient.landmark(anatomy::landmark::kVeinTarget))};
}

}  // namespace palpa::assess
