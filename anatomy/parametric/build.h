#pragma once

#include "anatomy/parametric/parametric_patient.h"

namespace palpa::anatomy {

/// How this body differs in size from the one that the shapes are written for (1.70 m, clavicle
/// 149.4 mm). Around the sternoclavicular joint nothing is scaled: what decides the manoeuvre there
/// is solved for.
struct Build {
  double wide = 1;      ///< of what lies more than 20 mm from the midline
  double tall = 1;      ///< of what lies more than 30 mm above or below the notch
  double softness = 0;  ///< mm of fat beyond the body's that the shapes are written for
  bool female = true;
  Extent extent = Extent::torso;

  bool bust() const { return extent == Extent::bust; }
  /// z of the cuts through the body, and of the lowest that organs reach above the lower one.
  double lower() const { return place({0, 0, bust() ? -140.0 : -232.0}).z(); }
  double upper() const { return place({0, 0, bust() ? 112.0 : 340.0}).z(); }
  double floor(double margin) const { return lower() + margin; }

  /// A point of the shapes' body (B, mm) in this one; either side.
  Vec3 place(const Vec3& p) const {
    const double a = std::abs(p.x()), z = p.z();
    const double x = std::copysign(a <= 20 ? a : 20 + (a - 20) * wide, p.x());
    return {x, p.y(), std::abs(z) <= 30 ? z : std::copysign(30 + (std::abs(z) - 30) * tall, z)};
  }
  /// The other way.
  Vec3 unplace(const Vec3& p) const {
    const double a = std::abs(p.x()), z = p.z();
    const double x = std::copysign(a <= 20 ? a : 20 + (a - 20) / wide, p.x());
    return {x, p.y(), std::abs(z) <= 30 ? z : std::copysign(30 + (std::abs(z) - 30) / tall, z)};
  }
};

Build buildOf(const PatientParameters& parameters);

}  // namespace palpa::anatomy

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

/// How skin, fat and muscle together go with the vein's depth, mm. All [chosen]: the vein lies in
/// loose tissue behind the muscle, and from person to person the layers vary less at the entry,
/// where the muscle thins out, than at the window.
inline double softAtWindow(double vein_depth) { return 0.92 * vein_depth - 2; }
inline double softAtEntry(double at_window) { return 6.5 + 0.58 * at_window; }

}  // namespace palpa::anatomy
