#pragma once

#include <cstdint>
#include <numeric>
#include <string>
#include <unordered_map>
#include <vector>

#include "anatomy/import/mesh_file.h"

/// What check and repair of a surface share: places, edges, pieces.
namespace palpa::anatomy {

using Corner = std::uint32_t;
using Triangle = std::array<Corner, 3>;

/// Points at one place (to the last bit) get one number, in order of first use; `different`: how
/// many there are.
std::vector<Corner> numberedPlaces(const std::vector<Vec3>& points, std::size_t* different);

/// Corners in ascending order: equal for the same triangle, however it is turned.
Triangle sortedCorners(const Triangle& triangle);

/// How often an edge is used in either direction, from the smaller number and from the larger.
struct EdgeUses {
  int forth = 0, back = 0;
};
using Edges = std::unordered_map<std::uint64_t, EdgeUses>;
std::uint64_t edgeKey(Corner a, Corner b);
Edges edgesOf(const std::vector<Triangle>& triangles);

/// The volume that triangles enclose (divergence theorem, about `middle`), negative inside out.
double enclosedVolume(const std::vector<Vec3>& points, const std::vector<Triangle>& triangles,
                      const Vec3& middle);

/// Union-find over corners.
class Pieces {
 public:
  explicit Pieces(std::size_t count) : parent_(count) {
    std::iota(parent_.begin(), parent_.end(), 0u);
  }
  Corner root(Corner i) {
    while (parent_[i] != i) i = parent_[i] = parent_[parent_[i]];
    return i;
  }
  void join(Corner a, Corner b) { parent_[root(a)] = root(b); }

 private:
  std::vector<Corner> parent_;
};
/// Corners of triangles that hang together have one root.
Pieces piecesOf(const std::vector<Triangle>& triangles, std::size_t points);

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
