#pragma once

#include "anatomy/parametric_patient.h"

/// The parametric shapes are written in frame B, in **millimetres**, as anatomy books give them:
/// +x = l lateral (toward the punctured side), +y posterior, +z superior, origin at the
/// suprasternal notch. For the left side B is A in millimetres; for the right side x is mirrored.
namespace palpa::anatomy {

inline Vec3 fromB(const Vec3& p_B_mm, Side side) {
  const double sign = side == Side::left ? 1 : -1;
  return 1e-3 * Vec3(sign * p_B_mm.x(), p_B_mm.y(), p_B_mm.z());
}

/// Mesh in B (mm) to A (m); a mirrored mesh is turned so that it still faces outward.
TriangleMesh fromB(const TriangleMesh& mesh_B_mm, Side side);

}  // namespace palpa::anatomy
