#pragma once

#include "anatomy/base/random.h"
#include "anatomy/geometry/pose.h"

namespace palpa {

/// Three independent standard normals.
inline Vec3 normal3(RandomStream& random) {
  const double x = random.normal(), y = random.normal(), z = random.normal();  // in this order
  return {x, y, z};
}

}  // namespace palpa
