#pragma once

#include "anatomy/surface_query.h"

namespace palpa::anatomy {

/// The surface point nearest to the segment a–b (least signed distance): the best of samples 8 mm
/// apart, then alternating projection between segment and surface.
SurfacePoint nearestToSegment(const SurfaceQuery& query, int surface, const Vec3& a_A,
                              const Vec3& b_A);

}  // namespace palpa::anatomy
