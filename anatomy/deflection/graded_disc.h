#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "anatomy/geometry/pose.h"

namespace palpa::anatomy {

using Vec2 = Eigen::Vector2d;

/// A disc of triangles about the origin, finer the nearer to it: `per_ring` nodes on every ring;
/// inside the contact the rings are even, outside each is larger than the one before by the factor
/// that keeps the triangles' shape, so that the number of nodes grows with the logarithm of patch /
/// contact. Metres.
struct GradedDisc {
  int per_ring = 0;
  int contact_rings = 0;      ///< the last of them is the contact's rim
  std::vector<double> radii;  ///< of the rings, from the innermost to the rim
  std::vector<Vec2> nodes;    ///< the centre, then ring by ring, counter-clockwise from +x
  std::vector<std::array<std::uint32_t, 3>>
      triangles;  ///< counter-clockwise, from the centre outward

  std::uint32_t node(int ring, int k) const {
    return 1 + static_cast<std::uint32_t>(ring * per_ring + k % per_ring);
  }
  int contactTriangles() const { return per_ring * (2 * contact_rings - 1); }

  /// Nodes and weights that interpolate at x: linear across a sector and between two rings. False
  /// beyond the rim.
  struct Place {
    std::array<std::uint32_t, 4> node{};
    std::array<double, 4> weight{};
  };
  bool find(const Vec2& x, Place* place) const;
};

/// `contact` < `patch`: radii; 8 nodes a ring or more.
GradedDisc gradedDisc(double contact, double patch, int per_ring);

}  // namespace palpa::anatomy
