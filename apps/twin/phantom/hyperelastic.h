#pragma once

#include <Eigen/Core>

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

}  // namespace palpa::twin
