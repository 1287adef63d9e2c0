#pragma once

#include "anatomy/geometry/surface_patch.h"
#include "anatomy/surface_query.h"

namespace palpa::anatomy {

/// Cubic height over the tangent plane at the surface's point nearest to `near_A`, by least squares
/// through 37 points of the rounded surface within `reach` (a centre and three rings), the inner
/// ones weighing more. With fewer than 20 usable points (a rim, a fold), or a reach of 0, it is the
/// tangent plane. Metres, frame A. A few closest-point queries a millimetre: 0.1 ms, logarithmic in
/// the mesh.
SurfacePatch fitSurfacePatch(const SurfaceQuery& query, int surface, const Vec3& near_A,
                             double reach);

}  // namespace palpa::anatomy
