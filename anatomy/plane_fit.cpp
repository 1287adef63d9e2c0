#include "anatomy/plane_fit.h"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>

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
  const Eigen::SelfAdjointEigenSolver<Mat3> eigen(covariance / weights);
  fit.n = eigen.eigenvectors().col(0);
  if (fit.n.dot(normal) < 0) fit.n = -fit.n;
  fit.rms = std::sqrt(std::max(eigen.eigenvalues()[0], 0.0));
  return fit;
}

}  // namespace palpa::anatomy
