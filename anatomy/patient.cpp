#include "anatomy/patient.h"

#include "anatomy/base/error.h"

namespace palpa::anatomy {

const Vec3& Patient::landmark(const std::string& landmark_name) const {
  const auto found = landmarks.find(landmark_name);
  if (found == landmarks.end())
    throw Error("there is no landmark \"" + landmark_name + "\"", "patient " + name,
                "Build the patient again or add the landmark to its file");
  return found->second;
}

const OrganSurface& Patient::organ(Organ kind) const {
  for (const OrganSurface& surface : organs)
    if (surface.organ == kind) return surface;
  throw Error(std::string("there is no surface of the organ \"") + palpa::name(kind) + "\"",
              "patient " + name, "Build the patient again or add the surface to its file");
}

Tissue tissueInside(Organ organ) {
  if (isBone(organ)) return Tissue::bone;
  switch (organ) {
    case Organ::skin:
      return Tissue::skin;
    case Organ::muscle:
      return Tissue::muscle;
    case Organ::lung:
      return Tissue::lung;
    case Organ::vein:
      return Tissue::vein_lumen;
    case Organ::artery:
      return Tissue::artery_lumen;
    default:
      return Tissue::air;
  }
}

namespace {

constexpr double kShortestClavicle = 0.02;  // m: the chord must tell a direction

Vec3 landmarkOf(const Patient& patient, const char* key) {
  const auto found = patient.landmarks.find(key);
  if (found == patient.landmarks.end() || !found->second.allFinite())
    throw Error(std::string("landmark \"") + key + "\" is missing or not a point",
                "patient " + patient.name, "Build or import the patient again with this landmark");
  return found->second;
}

Vec3 chordToSternum(const Patient& patient) {
  const Vec3 chord =
      landmarkOf(patient, landmark::kSternalEnd) - landmarkOf(patient, landmark::kAcromialEnd);
  if (chord.norm() < kShortestClavicle)
    throw Error("the clavicle's two ends are less than 20 mm apart", "patient " + patient.name,
                "Check the landmarks of the sternal and acromial ends");
  return chord.normalized();
}

}  // namespace

LandmarkFrame::LandmarkFrame(const Patient& patient)
    : origin_(landmarkOf(patient, landmark::kMedialThird)) {
  const Vec3 medial = chordToSternum(patient);
  const Vec3 up = Vec3::UnitZ() - Vec3::UnitZ().dot(medial) * medial;
  Vec3 posterior = medial.cross(up.normalized());
  if (up.norm() < 0.1 || std::abs(posterior.y()) < 0.1)
    throw Error("the clavicle runs along the body or straight to the back",
                "patient " + patient.name,
                "Check axes (+x left, +y posterior, +z up) and landmarks");
  if (posterior.y() < 0) posterior = -posterior;
  basis_ << medial, posterior, up.normalized();
}

}  // namespace palpa::anatomy
