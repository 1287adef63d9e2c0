#include "anatomy/query/primitive_fit.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>

#include <Eigen/LU>

#include "anatomy/geometry/dense_solvers.h"

namespace palpa::anatomy {

PlaneFit fitPlaneTo(const TriangleTree& tree, const Vec3& centre, const Vec3& normal,
                    double reach) {
  PlaneFit fit{normal, 0};
  if (!(reach > 0)) return fit;
  const auto each = [&](auto f) {
    tree.forVerticesWithin(centre, reach, [&](std::uint32_t i) {
      const Vec3 q = tree.points()[i] - centre;
      const double w = std::max(1 - q.squaredNorm() / (reach * reach), 0.0);
      f(q, w * w);
    });
  };
  int used = 0;
  double weights = 0;
  Vec3 mean = Vec3::Zero();
  each([&](const Vec3& q, double w) {
    mean += w * q;
    weights += w;
    ++used;
  });
  if (used < 3 || !(weights > 0)) return fit;
  mean /= weights;
  Mat3 covariance = Mat3::Zero();
  each([&](const Vec3& q, double w) { covariance += w * (q - mean) * (q - mean).transpose(); });
  const SymmetricEigen<3> eigen = symmetricEigen(Mat3(covariance / weights));
  fit.n = eigen.vectors.col(0);
  if (fit.n.dot(normal) < 0) fit.n = -fit.n;
  fit.rms = std::sqrt(std::max(eigen.values[0], 0.0));
  return fit;
}

namespace {

double weight(double squared_distance, double reach) {
  const double w = 1 - squared_distance / (reach * reach);
  return w > 0 ? w * w : 0;
}

struct Circle {
  bool ok;
  Eigen::Vector2d centre;
  double radius;
};

// Coordinates are divided by `reach` so that the normal equations are well scaled.
Circle kasaCircle(const Mat3& sums, const Vec3& right) {
  const Eigen::FullPivLU<Mat3> lu(sums);
  if (lu.rank() < 3) return {false, {0, 0}, 0};
  const Vec3 x = lu.solve(right);
  const Eigen::Vector2d c = x.head<2>() / 2;
  const double squared = x[2] + c.squaredNorm();
  return {squared > 0, c, squared > 0 ? std::sqrt(squared) : 0};
}

}  // namespace

TubeFit fitTubeTo(const TriangleTree& tree, const Vec3& centre, double reach) {
  TubeFit fit;
  const auto& points = tree.points();
  const auto& normals = tree.normals();
  const auto each = [&](auto f) {
    tree.forVerticesWithin(centre, reach, [&](std::uint32_t i) {
      const double w = weight((points[i] - centre).squaredNorm(), reach);
      if (w > 0) f(i, w);
    });
  };
  int used = 0;
  Mat3 covariance = Mat3::Zero();
  each([&](std::uint32_t i, double w) {
    covariance += w * normals[i] * normals[i].transpose();
    ++used;
  });
  if (used < 8) return fit;
  const SymmetricEigen<3> eigen = symmetricEigen(covariance);
  Mat3 R;  // third column: the axis
  R << eigen.vectors.col(1), eigen.vectors.col(2), eigen.vectors.col(0);
  if (R(0, 2) < 0) R.col(2) = -R.col(2);
  const auto local = [&](std::uint32_t i) {
    return Vec3(R.transpose() * (points[i] - centre) / reach);
  };

  Mat3 sums = Mat3::Zero();
  Vec3 right = Vec3::Zero();
  double low = std::numeric_limits<double>::infinity(), high = -low;
  each([&](std::uint32_t i, double w) {
    const Vec3 q = local(i);
    const Vec3 row(q.x(), q.y(), 1);
    sums += w * row * row.transpose();
    right += w * q.head<2>().squaredNorm() * row;
    low = std::min(low, q.z());
    high = std::max(high, q.z());
  });
  const Circle circle = kasaCircle(sums, right);
  if (!circle.ok) return fit;

  double squares = 0, weights = 0;
  each([&](std::uint32_t i, double w) {
    const double residual = (local(i).head<2>() - circle.centre).norm() - circle.radius;
    squares += w * residual * residual;
    weights += w;
  });
  const auto back = [&](double z) {
    return Vec3(centre + reach * (R * Vec3(circle.centre.x(), circle.centre.y(), z)));
  };
  return {true, back(low), back(high), circle.radius * reach, reach * std::sqrt(squares / weights)};
}

}  // namespace palpa::anatomy
