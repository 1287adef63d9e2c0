#include "anatomy/tube_fit.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>

namespace palpa::anatomy {
namespace {

double weight(double squared_distance, double reach) {
  const double w = 1 - squared_distance / (reach * reach);
  return w > 0 ? w * w : 0;
}

struct Weighted {
  std::uint32_t vertex;
  double weight;
};

std::vector<Weighted> near(const std::vector<Vec3>& points, const Vec3& centre, double reach) {
  std::vector<Weighted> found;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const double w = weight((points[i] - centre).squaredNorm(), reach);
    if (w > 0) found.push_back({static_cast<std::uint32_t>(i), w});
  }
  return found;
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

TubeFit fitTubeTo(const std::vector<Vec3>& points, const std::vector<Vec3>& normals,
                  const Vec3& centre, double reach) {
  TubeFit fit;
  const std::vector<Weighted> used = near(points, centre, reach);
  if (used.size() < 8) return fit;
  Mat3 covariance = Mat3::Zero();
  for (const auto& [i, w] : used) covariance += w * normals[i] * normals[i].transpose();
  const Eigen::SelfAdjointEigenSolver<Mat3> eigen(covariance);
  Mat3 R;  // third column: the axis
  R << eigen.eigenvectors().col(1), eigen.eigenvectors().col(2), eigen.eigenvectors().col(0);
  if (R(0, 2) < 0) R.col(2) = -R.col(2);

  Mat3 sums = Mat3::Zero();
  Vec3 right = Vec3::Zero();
  double low = std::numeric_limits<double>::infinity(), high = -low;
  std::vector<Vec3> local;
  local.reserve(used.size());
  for (const auto& [i, w] : used) {
    const Vec3 q = R.transpose() * (points[i] - centre) / reach;
    const Vec3 row(q.x(), q.y(), 1);
    sums += w * row * row.transpose();
    right += w * q.head<2>().squaredNorm() * row;
    low = std::min(low, q.z());
    high = std::max(high, q.z());
    local.push_back(q);
  }
  const Circle circle = kasaCircle(sums, right);
  if (!circle.ok) return fit;

  double squares = 0, weights = 0;
  for (std::size_t k = 0; k < used.size(); ++k) {
    const double residual = (local[k].head<2>() - circle.centre).norm() - circle.radius;
    squares += used[k].weight * residual * residual;
    weights += used[k].weight;
  }
  const auto back = [&](double z) {
    return Vec3(centre + reach * (R * Vec3(circle.centre.x(), circle.centre.y(), z)));
  };
  return {true, back(low), back(high), circle.radius * reach, reach * std::sqrt(squares / weights)};
}

}  // namespace palpa::anatomy
