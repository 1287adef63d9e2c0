#include "apps/bench/estimator_studies.h"

#include <cmath>
#include <numbers>

#include "calibration/rotation.h"

namespace palpa::bench::study {

Vec3 inBall(Random& random) {
  for (;;) {
    const double x = random.uniform(-1, 1), y = random.uniform(-1, 1), z = random.uniform(-1, 1);
    if (x * x + y * y + z * z <= 1) return {x, y, z};
  }
}

Vec3 direction(Random& random) { return normal3(random).normalized(); }

Mat3 anyRotation(Random& random) {
  return calibration::rotationOf(std::numbers::pi * inBall(random));
}

std::vector<bool> grossErrors(Random& random, std::size_t n, double share) {
  std::vector<bool> gross(n);
  for (auto left = static_cast<int>(std::lround(share * static_cast<double>(n))); left > 0;) {
    const std::size_t i = random.bits() % n;
    if (gross[i]) continue;
    gross[i] = true;
    --left;
  }
  return gross;
}

VectorX halves(const calibration::Fit& fit) {
  VectorX h(fit.covariance.rows());
  for (Eigen::Index i = 0; i < h.size(); ++i) h[i] = fit.halfWidth95(static_cast<int>(i));
  return h;
}

VectorX sds(const MatrixX& covariance) { return covariance.diagonal().cwiseSqrt(); }

}  // namespace palpa::bench::study
