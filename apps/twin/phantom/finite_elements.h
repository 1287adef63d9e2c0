#pragma once

#include <array>
#include <vector>

#include <Eigen/Core>

#include "anatomy/geometry/pose.h"
#include "apps/twin/phantom/finite_block.h"

/// The rubber of simulated phantoms: neo-Hookean, split into change of shape and change of volume
/// (Bonet and Wood 2008, section 6.5; Simo, Taylor and Pister 1985 for the mean dilatation).
namespace palpa::twin {

using Mat9 = Eigen::Matrix<double, 9, 9>;
using Vec9 = Eigen::Matrix<double, 9, 1>;  ///< a 3 x 3 matrix, column by column

/// At one point, for the deformation gradient F with J = det F > 0; per reference volume.
///     W = mu/2 (J^(-2/3) tr(F^T F) - 3),   P = dW/dF,   A = d2W/dF2
struct ShapeChange {
  double W = 0;  ///< J/m^3
  Vec9 P;        ///< Pa
  Mat9 A;        ///< Pa
};
ShapeChange changeOfShape(double mu, const Eigen::Matrix3d& F);

/// Of J itself: dJ/dF and d2J/dF2.
struct VolumeChange {
  double J = 1;
  Vec9 dJ;
  Mat9 d2J;
};
VolumeChange changeOfVolume(const Eigen::Matrix3d& F);

using Mat24 = Eigen::Matrix<double, 24, 24>;
using Vec24 = Eigen::Matrix<double, 24, 1>;

/// A hexahedron of eight nodes in its undeformed shape: at its eight Gauss points, how F follows
/// from the nodes' displacements.
struct Brick {
  struct IntegrationPoint {
    Eigen::Matrix<double, 9, 24> B;  ///< vec(F) = vec(I) + B u
    double volume = 0;               ///< m^3
    double shear = 0;                ///< Pa
    Eigen::Matrix<double, 8, 1> N;   ///< the nodes' shares here
    Eigen::Vector3d p;               ///< m, undeformed
  };
  std::array<IntegrationPoint, 8> points;
  double volume = 0;
};
Brick brickOf(const std::array<Eigen::Vector3d, 8>& nodes);

/// Energy, its gradient and its second derivative by the nodes' displacements u, with the mean
/// dilatation theta = (volume now) / (volume before):
///     E = sum W V + bulk/2 (theta - 1)^2 V
/// False where a point is turned inside out. `tangent` may be left out.
bool energyOf(const Brick& brick, double bulk, const Vec24& u, double* E, Vec24* gradient,
              Mat24* tangent);

/// A round tool tip's hold on a face of four nodes, which it may enter a little: energy e/2 g^2 per
/// undeformed area, g = |x - centre| - radius < 0.
struct RoundTip {
  Vec3 centre = Vec3::Zero();
  double radius = 0.008;  ///< m
};
struct FacePressure {
  double E = 0;  ///< J
  Eigen::Matrix<double, 12, 1> gradient = Eigen::Matrix<double, 12, 1>::Zero();
  Eigen::Matrix<double, 12, 12> tangent = Eigen::Matrix<double, 12, 12>::Zero();
  Vec3 f_tip = Vec3::Zero();  ///< N, on the tip
  bool touches = false;
};
/// `before`, `now`: the nodes undeformed and deformed; `stiffness` e in N/m^3.
FacePressure pressureOn(const std::array<Vec3, 4>& before, const std::array<Vec3, 4>& now,
                        const RoundTip& tip, double stiffness);

/// Hexahedra of half a block, y >= 0, or of the whole, on a grid of planes that are dense where
/// tools press and near the top.
struct BlockMesh {
  std::vector<Vec3> nodes;                 ///< m, undeformed
  std::vector<std::array<int, 8>> bricks;  ///< nodes counter-clockwise below, then above
  /// faces that tools may touch, counter-clockwise from above
  std::vector<std::array<int, 4>> top, bottom;
  /// of every coordinate of every node: glued below, or all round; of a half, in its plane at y = 0
  std::vector<bool> fixed;
};

/// Where elements are to be fine.
struct ToolPlaces {
  std::vector<double> x;  ///< m
  double y = 0;           ///< m, of all of them
  BlockPart part = BlockPart::half;
};

BlockMesh meshOf(const SoftBlock& block, const ToolPlaces& tools, double tool_radius,
                 const Fineness& fineness);

}  // namespace palpa::twin
