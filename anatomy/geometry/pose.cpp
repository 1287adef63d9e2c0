#include "anatomy/geometry/pose.h"

namespace palpa {

Quat turnBetween(const Vec3& from, const Vec3& to) { return Quat::FromTwoVectors(from, to); }

Mat3 rotationWithZ(const Vec3& z) { return turnBetween(Vec3::UnitZ(), z).toRotationMatrix(); }

}  // namespace palpa
