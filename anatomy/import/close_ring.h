#pragma once

#include <functional>

#include "anatomy/import/surface_topology.h"

namespace palpa::anatomy {

/// Triangles that close a ring of points, none added: of all ways the one of least area (Barequet
/// and Sharir 1995, dynamic programming, cubic in the ring's length), so that a narrow seam is
/// closed across and not along. A line between two points of the ring that `taken` says is an edge
/// already is not used. Empty where no way is left. The triangles run along the ring as it is
/// given.
std::vector<Triangle> closeRing(const std::vector<Vec3>& points, const std::vector<Corner>& ring,
                                const std::function<bool(Corner, Corner)>& taken);

}  // namespace palpa::anatomy
