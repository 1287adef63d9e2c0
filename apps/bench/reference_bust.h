#pragma once

#include "anatomy/patient.h"

namespace palpa::bench {

/// The reference patient, as much of him as a session shows.
anatomy::Patient referenceBust();

/// Pose of A in a camera at `eye_A` that looks at `target_A`, upright.
Pose lookAt(const Vec3& eye_A, const Vec3& target_A);

}  // namespace palpa::bench
