#pragma once

#include <cstdint>
#include <numeric>
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

}  // namespace palpa::anatomy
