#pragma once

#include <array>
#include <vector>

#include "anatomy/geometry/pose.h"

namespace palpa::twin {

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

}  // namespace palpa::twin
