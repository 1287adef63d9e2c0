#include "anatomy/patient.h"

#include "anatomy/geometry/error.h"

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

}  // namespace palpa::anatomy
