#include "apps/twin/phantom/hyperelastic.h"

#include <Eigen/LU>
#include <cmath>

namespace palpa::twin {
namespace {

Vec9 flat(const Eigen::Matrix3d& m) { return Eigen::Map<const Vec9>(m.data()); }

/// The matrix of dF -> H dF^T H, H = F^-T.
Mat9 turnedByInverse(const Eigen::Matrix3d& H) {
  Mat9 T;
  for (int k = 0; k < 3; ++k) {
    for (int l = 0; l < 3; ++l) {  // dF = e_k e_l^T: H e_l e_k^T H
      const Eigen::Matrix3d image = H.col(l) * H.row(k);
      T.col(3 * l + k) = flat(image);
    }
  }
  return T;
}

}  // namespace

ShapeChange changeOfShape(double mu, const Eigen::Matrix3d& F) {
  const double J = F.determinant(), scale = mu * std::pow(J, -2.0 / 3.0), I1 = F.squaredNorm();
  const Eigen::Matrix3d H = F.inverse().transpose();
  const Vec9 f = flat(F), h = flat(H);
  ShapeChange s;
  s.W = 0.5 * (scale * I1 - 3 * mu);
  s.P = scale * (f - I1 / 3 * h);
  s.A = scale * (Mat9::Identity() - 2.0 / 3.0 * (f * h.transpose() + h * f.transpose()) +
                 2.0 / 9.0 * I1 * h * h.transpose() + I1 / 3 * turnedByInverse(H));
  return s;
}

VolumeChange changeOfVolume(const Eigen::Matrix3d& F) {
  VolumeChange v;
  v.J = F.determinant();
  const Eigen::Matrix3d H = F.inverse().transpose();
  const Vec9 h = flat(H);
  v.dJ = v.J * h;
  v.d2J = v.J * (h * h.transpose() - turnedByInverse(H));
  return v;
}

}  // namespace palpa::twin
