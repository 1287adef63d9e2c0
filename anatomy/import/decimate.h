#pragma once

#include <string>

#include "anatomy/patient.h"

namespace palpa::anatomy {

/// What a decimation has done, and what it costs.
struct DecimationReport {
  std::size_t before = 0, after = 0;  ///< triangles
  double farthest = 0,
         rms = 0;  ///< distance of the original's points to the decimated surface, the mesh's unit
  /// "quadrics", "quadrics, mended", "edges kept manifold"; "none": few enough, or nothing closed
  /// was found
  std::string way = "none";
};

/// The surface with about `triangles` triangles: VTK's quadric decimation (Garland and Heckbert
/// 1997) or, where its result is not closed though the original was, the same with its folds taken
/// out and mended (repair.h), or VTK's topology-preserving one (Schroeder et al. 1992), which may
/// stop early. A result that is not closed is never given: then the original comes back. Normals
/// are computed.
TriangleMesh decimated(const TriangleMesh& mesh, std::size_t triangles, DecimationReport* report);

/// Area-weighted normals, of length one even where triangles have no area.
void computeUnitNormals(TriangleMesh* mesh);

}  // namespace palpa::anatomy
