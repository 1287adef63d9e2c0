#pragma once

#include "anatomy/patient.h"

namespace palpa::bench {

/// A piece of chest known in closed form, to measure against:
///   z(x, y) = -x^2 / (2 R_x) - y^2 / (2 R_y) + (H/2) cos(2 pi x / L) cos(2 pi y / L)
/// on |x| <= 110 mm, |y| <= 85 mm: 1000 flat triangles miss the bumps by 0.3 mm; R_x = 0.18 m,
/// R_y = 0.9 m; bumps H = 2 mm high, L = 40 mm long. +z is outside.
struct TorsoPoint {
  Vec3 p, n;
};
TorsoPoint torsoAt(double x, double y);

/// Nearest point of the surface to `p`, by Newton's method to 1e-12 m; p within some millimetres of
/// it.
TorsoPoint nearestOnTorso(const Vec3& p);

/// A patient that is only this skin, of about `triangles` triangles; corners and normals are exact.
anatomy::Patient torsoPatient(int triangles);

/// The reference patient, as much of him as a session shows.
anatomy::Patient referenceBust();

/// Pose of A in a camera at `eye_A` that looks at `target_A`, upright.
Pose lookAt(const Vec3& eye_A, const Vec3& target_A);

}  // namespace palpa::bench
