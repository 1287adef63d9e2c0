#include "apps/twin/phantom/brick_element.h"

#include <Eigen/LU>
#include <cmath>

namespace palpa::twin {
namespace {

constexpr int kCorner[8][3] = {{-1, -1, -1}, {1, -1, -1}, {1, 1, -1}, {-1, 1, -1},
                               {-1, -1, 1},  {1, -1, 1},  {1, 1, 1},  {-1, 1, 1}};

}  // namespace

Brick brickOf(const std::array<Eigen::Vector3d, 8>& nodes) {
  const double at = 1 / std::sqrt(3.0);
  Brick brick;
  for (int g = 0; g < 8; ++g) {
    const Eigen::Vector3d xi(at * kCorner[g][0], at * kCorner[g][1], at * kCorner[g][2]);
    Eigen::Matrix<double, 8, 3> slope;
    Brick::Point& point = brick.points[g];
    point.p.setZero();
    for (int a = 0; a < 8; ++a) {
      const Eigen::Vector3d c(kCorner[a][0], kCorner[a][1], kCorner[a][2]),
          one = Eigen::Vector3d::Ones() + c.cwiseProduct(xi);
      point.N[a] = one.prod() / 8;
      slope.row(a) = Eigen::RowVector3d(c.x() * one.y() * one.z(), one.x() * c.y() * one.z(),
                                        one.x() * one.y() * c.z()) /
                     8;
      point.p += point.N[a] * nodes[a];
    }
    Eigen::Matrix3d jacobian = Eigen::Matrix3d::Zero();  // dX/dxi
    for (int a = 0; a < 8; ++a) jacobian += nodes[a] * slope.row(a);
    point.volume = jacobian.determinant();
    const Eigen::Matrix<double, 8, 3> gradient = slope * jacobian.inverse();
    point.B.setZero();
    for (int a = 0; a < 8; ++a) {
      for (int i = 0; i < 3; ++i) {
        for (int j = 0; j < 3; ++j) point.B(3 * j + i, 3 * a + i) = gradient(a, j);
      }
    }
    brick.volume += point.volume;
  }
  return brick;
}

bool energyOf(const Brick& brick, double bulk, const Vec24& u, double* E, Vec24* gradient,
              Mat24* tangent) {
  const Vec9 identity = Eigen::Map<const Vec9>(Eigen::Matrix3d::Identity().eval().data());
  std::array<Eigen::Matrix3d, 8> F;
  std::array<VolumeChange, 8> volumes;
  double now = 0;
  for (int g = 0; g < 8; ++g) {
    const Vec9 f = identity + brick.points[g].B * u;
    F[g] = Eigen::Map<const Eigen::Matrix3d>(f.data());
    volumes[g] = changeOfVolume(F[g]);
    if (!(volumes[g].J > 0)) return false;
    now += volumes[g].J * brick.points[g].volume;
  }
  const double theta = now / brick.volume, pressure = bulk * (theta - 1);
  *E = 0.5 * bulk * (theta - 1) * (theta - 1) * brick.volume;
  gradient->setZero();
  if (tangent) tangent->setZero();
  Vec24 squeeze = Vec24::Zero();  // d(volume)/du
  for (int g = 0; g < 8; ++g) {
    const Brick::Point& point = brick.points[g];
    const ShapeChange shape = changeOfShape(point.shear, F[g]);
    *E += shape.W * point.volume;
    gradient->noalias() +=
        point.volume * (point.B.transpose() * (shape.P + pressure * volumes[g].dJ));
    squeeze.noalias() += point.volume * (point.B.transpose() * volumes[g].dJ);
    if (!tangent) continue;
    const Eigen::Matrix<double, 9, 24> AB =
        point.volume * (shape.A + pressure * volumes[g].d2J) * point.B;
    tangent->noalias() += point.B.transpose() * AB;
  }
  if (tangent) tangent->noalias() += bulk / brick.volume * squeeze * squeeze.transpose();
  return true;
}

}  // namespace palpa::twin
