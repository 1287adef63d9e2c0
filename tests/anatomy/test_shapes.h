#pragma once

#include <cmath>
#include <filesystem>
#include <string>

#include "anatomy/base/random.h"
#include "anatomy/parametric/parametric_patient.h"
#include "anatomy/shapes/implicit_surface.h"
#include "anatomy/shapes/mesh_tools.h"
#include "tests/support/scratch_folder.h"

namespace palpa::anatomy {

inline const Population& reference() {
  static const Population population =
      readPopulation(PALPA_SOURCE_DIR "/assets/patients/reference.json");
  return population;
}

inline Patient referenceBust(Side side) {
  PatientParameters parameters = drawParameters(reference(), side, 0);
  parameters.extent = Extent::bust;
  return buildPatient(parameters);
}

/// The mean patient as a phantom; a side is built once a process, when it is asked for.
inline const Patient& referencePatient(Side side = Side::right) {
  if (side == Side::left) {
    static const Patient left = referenceBust(Side::left);
    return left;
  }
  static const Patient right = referenceBust(Side::right);
  return right;
}

inline TriangleMesh sphereMesh(double radius, double cell) {
  const auto field = [radius](const Vec3& p) { return p.norm() - radius; };
  const Vec3 corner = Vec3::Constant(radius + 2 * cell);
  return surfaceNets(field, {-corner, corner}, cell);
}

/// Straight tube with half-sphere ends around the segment a–b.
inline TriangleMesh capsuleMesh(const Vec3& a, const Vec3& b, double radius, int rings,
                                int around) {
  std::vector<Vec3> centres;
  for (int i = 0; i < rings; ++i) centres.push_back(a + (b - a) * i / (rings - 1));
  const Vec3 axis = (b - a).normalized();
  std::vector<Section> sections = sectionsAlong(centres, axis.unitOrthogonal());
  for (Section& s : sections) s.half_up = s.half_side = radius;
  return sweep(sections, around, 1.0);
}

inline Patient patientOf(const TriangleMesh& mesh, Organ organ) {
  Patient patient;
  patient.organs.push_back({"only", organ, mesh, {1, 1, 1, 1}});
  return patient;
}

inline Vec3 randomIn(RandomStream& random, double half) {
  const double x = random.openUniform(), y = random.openUniform(), z = random.openUniform();
  return 2 * half * (Vec3(x, y, z) - Vec3::Constant(0.5));
}

inline Vec3 randomDirection(RandomStream& random) {
  const double x = random.openNormal(), y = random.openNormal(), z = random.openNormal();
  return Vec3(x, y, z).normalized();
}

using test::ScratchFolder;

}  // namespace palpa::anatomy
