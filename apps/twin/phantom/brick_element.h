#pragma once

#include <Eigen/Core>
#include <array>

#include "apps/twin/phantom/hyperelastic.h"

namespace palpa::twin {

using Mat24 = Eigen::Matrix<double, 24, 24>;
using Vec24 = Eigen::Matrix<double, 24, 1>;

/// A hexahedron of eight nodes in its undeformed shape: at its eight Gauss points, how F follows
/// from the nodes' displacements.
struct Brick {
  struct Point {
    Eigen::Matrix<double, 9, 24> B;  ///< vec(F) = vec(I) + B u
    double volume = 0;               ///< m^3
    double shear = 0;                ///< Pa
    Eigen::Matrix<double, 8, 1> N;   ///< the nodes' shares here
    Eigen::Vector3d p;               ///< m, undeformed
  };
  std::array<Point, 8> points;
  double volume = 0;
};
Brick brickOf(const std::array<Eigen::Vector3d, 8>& nodes);

/// Energy, its gradient and its second derivative by the nodes' displacements u, with the mean
/// dilatation theta = (volume now) / (volume before):
///     E = sum W V + bulk/2 (theta - 1)^2 V
/// False where a point is turned inside out. `tangent` may be left out.
bool energyOf(const Brick& brick, double bulk, const Vec24& u, double* E, Vec24* gradient,
              Mat24* tangent);

}  // namespace palpa::twin
