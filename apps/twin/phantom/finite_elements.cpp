#include "apps/twin/phantom/finite_elements.h"

#include <algorithm>
#include <cmath>

#include <Eigen/Geometry>
#include <Eigen/LU>

#include "anatomy/base/error.h"

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
    Brick::IntegrationPoint& point = brick.points[g];
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
    const Brick::IntegrationPoint& point = brick.points[g];
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

namespace {

constexpr int kPoints = 4;  // Gauss points each way: the edge of contact runs through faces
constexpr double kAt[kPoints] = {-0.861136311594053, -0.339981043584856, 0.339981043584856,
                                 0.861136311594053};
constexpr double kWeight[kPoints] = {0.347854845137454, 0.652145154862546, 0.652145154862546,
                                     0.347854845137454};
constexpr int kFaceCorner[4][2] = {{-1, -1}, {1, -1}, {1, 1}, {-1, 1}};

}  // namespace

FacePressure pressureOn(const std::array<Vec3, 4>& before, const std::array<Vec3, 4>& now,
                        const RoundTip& tip, double stiffness) {
  FacePressure face;
  for (int gu = 0; gu < kPoints; ++gu) {
    for (int gv = 0; gv < kPoints; ++gv) {
      Eigen::Vector4d N;
      Vec3 x = Vec3::Zero(), along_u = Vec3::Zero(), along_v = Vec3::Zero();
      for (int a = 0; a < 4; ++a) {
        const double u = 1 + kFaceCorner[a][0] * kAt[gu], v = 1 + kFaceCorner[a][1] * kAt[gv];
        N[a] = u * v / 4;
        x += N[a] * now[a];
        along_u += kFaceCorner[a][0] * v / 4 * before[a];
        along_v += kFaceCorner[a][1] * u / 4 * before[a];
      }
      const Vec3 away = x - tip.centre;
      const double distance = away.norm(), g = distance - tip.radius;
      if (g >= 0) continue;
      face.touches = true;
      const double e = stiffness * kWeight[gu] * kWeight[gv] * along_u.cross(along_v).norm();
      const Vec3 n = away / distance;
      face.E += 0.5 * e * g * g;
      face.f_tip += e * g * n;
      const Mat3 T =
          e * n *
          n.transpose();  // without the turn of n, which is small and would make it indefinite
      for (int a = 0; a < 4; ++a) {
        face.gradient.segment<3>(3 * a) += N[a] * e * g * n;
        for (int b = 0; b < 4; ++b) face.tangent.block<3, 3>(3 * a, 3 * b) += N[a] * N[b] * T;
      }
    }
  }
  return face;
}

namespace {

/// Planes from `from` to `to`, about as far apart as wanted there.
template <class Spacing>
std::vector<double> planes(double from, double to, Spacing wanted) {
  constexpr int kSteps = 4000;
  std::vector<double> elements(kSteps + 1, 0.0);  // how many there are up to here
  const double step = (to - from) / kSteps;
  for (int i = 0; i < kSteps; ++i)
    elements[i + 1] = elements[i] + step / wanted(from + (i + 0.5) * step);
  const int count = std::max(2, static_cast<int>(std::lround(elements.back())));
  std::vector<double> at(count + 1, from);
  for (int k = 1, i = 0; k < count; ++k) {
    const double target = elements.back() * k / count;
    while (elements[i + 1] < target) ++i;
    at[k] = from + step * (i + (target - elements[i]) / (elements[i + 1] - elements[i]));
  }
  at[count] = to;
  return at;
}

double spacing(const Fineness& fineness, double away) {
  return std::min(fineness.coarsest, fineness.finest + fineness.growth * std::max(0.0, away));
}

/// A lump is seen by some six elements across, a rib, too, whatever is above them.
double spacingAtInside(const SoftBlock& block, const Fineness& fineness, int axis, double at) {
  double wanted = fineness.coarsest;
  const auto fineAt = [&](double middle, double radius) {
    const double away = std::max(0.0, std::abs(at - middle) - radius);
    wanted = std::min(wanted, radius / 3 + fineness.growth * away);
  };
  if (block.lump) fineAt(block.lump->centre[axis], block.lump->radius);
  for (const SoftBlock::Rib& rib : block.ribs)
    if (axis != 1) fineAt(axis == 0 ? rib.x : rib.z, rib.radius);
  return wanted;
}

struct Grid {
  std::vector<double> x, y, z;
  int node(std::size_t i, std::size_t j, std::size_t k) const {
    return static_cast<int>((k * y.size() + j) * x.size() + i);
  }
};

Grid gridOf(const SoftBlock& block, const ToolPlaces& tools, double reach,
            const Fineness& fineness) {
  Grid grid;
  grid.x = planes(-block.length / 2, block.length / 2, [&](double x) {
    double nearest = block.length;
    for (const double tool : tools.x) nearest = std::min(nearest, std::abs(x - tool));
    return std::min(spacing(fineness, nearest - reach), spacingAtInside(block, fineness, 0, x));
  });
  const double side = tools.part == BlockPart::half ? 0 : -block.width / 2;
  grid.y = planes(side, block.width / 2, [&](double y) {
    return std::min(spacing(fineness, std::abs(y - tools.y) - reach),
                    spacingAtInside(block, fineness, 1, y));
  });
  grid.z = planes(-block.height, 0, [&](double z) {
    const double deep = block.framed ? std::min(-z, z + block.height) : -z;
    return std::min(spacing(fineness, 0.5 * deep), spacingAtInside(block, fineness, 2, z));
  });
  return grid;
}

}  // namespace

BlockMesh meshOf(const SoftBlock& block, const ToolPlaces& tools, double tool_radius,
                 const Fineness& fineness) {
  constexpr std::size_t kMostNodes = 100'000;
  const Grid g = gridOf(block, tools, 0.8 * tool_radius, fineness);
  if (const std::size_t nodes = g.x.size() * g.y.size() * g.z.size(); nodes > kMostNodes)
    throw UsageError("would be solved at " + std::to_string(nodes) + " points, more than " +
                         std::to_string(kMostNodes),
                     "the soft block",
                     "Make it smaller, or table/finest_mm or table/growth larger");
  BlockMesh mesh;
  for (const double z : g.z) {
    for (const double y : g.y) {
      for (const double x : g.x) {
        mesh.nodes.emplace_back(x, y, z);
        const bool mirror = tools.part == BlockPart::half && y == 0,
                   side = x == g.x.front() || x == g.x.back() || y == g.y.back() ||
                          (y == g.y.front() && !mirror),
                   glued = block.framed ? side : z == g.z.front();
        mesh.fixed.insert(mesh.fixed.end(), {glued, glued || mirror, glued});
      }
    }
  }
  for (std::size_t k = 0; k + 1 < g.z.size(); ++k) {
    for (std::size_t j = 0; j + 1 < g.y.size(); ++j) {
      for (std::size_t i = 0; i + 1 < g.x.size(); ++i) {
        const auto ring = [&](std::size_t at) {
          return std::array<int, 4>{g.node(i, j, at), g.node(i + 1, j, at),
                                    g.node(i + 1, j + 1, at), g.node(i, j + 1, at)};
        };
        const auto below = ring(k), above = ring(k + 1);
        mesh.bricks.push_back(
            {below[0], below[1], below[2], below[3], above[0], above[1], above[2], above[3]});
        if (k == 0) mesh.bottom.push_back(below);
        if (k + 2 == g.z.size()) mesh.top.push_back(above);
      }
    }
  }
  return mesh;
}

}  // namespace palpa::twin
