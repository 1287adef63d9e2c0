#include "anatomy/geometry/pose.h"

namespace palpa {

Quat turnBetween(const Vec3& from, const Vec3& to) { return Quat::FromTwoVectors(from, to); }

Mat3 rotationWithZ(const Vec3& z) { return turnBetween(Vec3::UnitZ(), z).toRotationMatrix(); }

Mat3 rotationWithZ(const Vec3& z, const Vec3& y_toward) {
  const Vec3 y = y_toward - y_toward.dot(z) * z;
  if (y.norm() < 1e-6) return rotationWithZ(z);
  Mat3 R;
  R << y.normalized().cross(z), y.normalized(), z;
  return R;
}

}  // namespace palpa
