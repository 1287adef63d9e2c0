#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "anatomy/patient.h"

namespace palpa::anatomy {

/// Bounding volume hierarchy over one mesh: exact closest point and all ray crossings, in the
/// mesh's unit. Flat array, median split of the longest axis, four triangles a leaf. Immutable;
/// queries use only the stack, so threads may share it.
class TriangleTree {
 public:
  explicit TriangleTree(const TriangleMesh& mesh);

  struct Closest {
    Vec3 p;       ///< on the surface
    Vec3 normal;  ///< interpolated from the vertices, unit
    double signed_distance;
  };
  /// The sign is that of the angle-weighted pseudonormal of the nearest face, edge or vertex
  /// (Baerentzen and Aanaes 2005): right for every closed mesh.
  Closest closest(const Vec3& p) const;

  /// The nearest facet rounded as its vertices' normals ask for: see `roundedPoint`.
  Closest rounded(const Vec3& p) const;

  struct Crossing {
    double s;
    Vec3 normal;
    bool entering;
  };
  /// Appends the crossings of start + s * direction (unit), 0 <= s <= length, unordered; one that
  /// runs through an edge or a vertex shared by several triangles counts once.
  void cast(const Vec3& start, const Vec3& direction, double length,
            std::vector<Crossing>* crossings) const;

  const std::vector<Vec3>& points() const { return points_; }
  const std::vector<Vec3>& normals() const { return normals_; }
  Eigen::AlignedBox3d bounds() const { return nodes_.front().box; }

 private:
  using Corners = std::array<std::uint32_t, 3>;
  struct Node {
    Eigen::AlignedBox3d box;
    std::uint32_t first = 0, count = 0;  ///< leaf: triangles first .. first + count
    std::uint32_t right = 0;             ///< inner: left child is the next node
  };
  struct Nearest {
    double squared;
    std::uint32_t triangle = 0;
    Vec3 weights = Vec3::Zero();  ///< barycentric
    Vec3 p = Vec3::Zero();
  };
  Nearest search(const Vec3& p) const;
  std::uint32_t split(std::uint32_t first, std::uint32_t count, std::vector<Vec3>* centres);
  void makePseudonormals();
  void searchLeaf(const Node& node, const Vec3& p, Nearest* best) const;
  Vec3 pseudonormal(const Nearest& nearest) const;
  Vec3 interpolated(std::uint32_t triangle, const Vec3& weights) const;

  std::vector<Vec3> points_, normals_;
  std::vector<Corners> triangles_;  ///< in leaf order
  std::vector<Node> nodes_;
  std::vector<Vec3> face_normals_, vertex_pseudonormals_;
  std::vector<std::array<Vec3, 3>> edge_pseudonormals_;  ///< edge k runs from corner k to k + 1
};

/// Point of the cubic Bezier triangle over a facet (Vlachos et al. 2001, "curved PN triangles"): it meets
/// the corners p with the normals n, so that a coarse mesh of a smooth shape errs with the fourth
/// power of its edges, not the second. `weights` barycentric.
Vec3 roundedPoint(const std::array<Vec3, 3>& p, const std::array<Vec3, 3>& n, const Vec3& weights);

/// Closest point of triangle abc to p as barycentric weights (Ericson, Real-Time Collision
/// Detection, 5.1.5: by Voronoi regions).
Vec3 closestWeights(const Vec3& p, const Vec3& a, const Vec3& b, const Vec3& c);

}  // namespace palpa::anatomy
