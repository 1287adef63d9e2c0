#pragma once

#include <string>
#include <vector>

#include "anatomy/import/mesh_file.h"

namespace palpa::anatomy {

/// What is right and wrong with a surface, after points at the same place (to the last bit) have
/// been taken for one.
struct SurfaceCheck {
  std::size_t points = 0, triangles = 0;
  std::size_t repeated_points = 0;     ///< stored more than once
  std::size_t degenerate = 0;          ///< triangles without an area: two corners are one
  std::size_t repeated_triangles = 0;  ///< the same three corners again
  std::size_t open_edges = 0;          ///< with one triangle only
  std::size_t holes = 0;               ///< closed rings of open edges, and what is left of them
  std::size_t crowded_edges = 0;       ///< with more than two triangles
  std::size_t turned_edges = 0;        ///< whose two triangles look to different sides
  std::size_t pieces = 0;              ///< parts that share no point
  bool inside_out = false;             ///< encloses a negative volume
  Vec3 low = Vec3::Zero(), high = Vec3::Zero();  ///< box, in the file's unit
  double volume = 0;                             ///< of a closed surface, in the file's unit cubed

  bool closed() const { return open_edges == 0 && crowded_edges == 0; }
  /// Closed, one way round, nothing twice.
  bool sound() const {
    return closed() && turned_edges == 0 && degenerate == 0 && repeated_triangles == 0 &&
           !inside_out;
  }
};

SurfaceCheck checkSurface(const RawMesh& mesh);

/// Every finding in plain words, worst first; empty for a sound surface.
std::vector<std::string> findings(const SurfaceCheck& check);

}  // namespace palpa::anatomy
