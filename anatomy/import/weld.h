#pragma once

#include <functional>

#include "anatomy/import/mesh_file.h"
#include "anatomy/import/surface_topology.h"

namespace palpa::anatomy {

/// Triangles that close a ring of points, none added: of all ways the one of least area (Barequet
/// and Sharir 1995, dynamic programming, cubic in the ring's length), so that a narrow seam is
/// closed across and not along. A line between two points of the ring that `taken` says is an edge
/// already is not used. Empty where no way is left. The triangles run along the ring as it is
/// given.
std::vector<Triangle> closeRing(const std::vector<Vec3>& points, const std::vector<Corner>& ring,
                                const std::function<bool(Corner, Corner)>& taken);

/// What a weld has done.
struct WeldReport {
  std::size_t joined_points = 0;  ///< fewer than before
  double farthest = 0;            ///< by which a point was moved, in the file's unit
};

/// The surface with seams closed: points on open borders that are nearer to each other than
/// `tolerance` (file's unit) become one at their mean, but only where that closes an open edge. Not
/// joined are points of one edge, points whose cluster would be wider than the tolerance, and
/// borders whose triangles would then lie on each other (less than 20 degrees apart): two sheets
/// that run side by side stay two. Every place of `mesh` is stored once.
RawMesh welded(const RawMesh& mesh, double tolerance, WeldReport* report);

}  // namespace palpa::anatomy
