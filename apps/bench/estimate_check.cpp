#include "apps/bench/estimate_check.h"

#include <Eigen/Dense>
#include <cmath>
#include <numbers>
#include <utility>

#include "apps/bench/estimator_studies.h"
#include "calibration/rotation.h"

namespace palpa::bench {
namespace {

template <class F>
MatrixX derivative(F f, Eigen::Index inputs, double step) {
  VectorX x = VectorX::Zero(inputs);
  MatrixX J;
  for (Eigen::Index k = 0; k < inputs; ++k) {
    x[k] = step;
    const VectorX plus = f(x);
    x[k] = -step;
    const VectorX minus = f(x);
    x[k] = 0;
    if (k == 0) J.resize(plus.size(), inputs);
    J.col(k) = (plus - minus) / (2 * step);
  }
  return J;
}

}  // namespace

MatrixX cramerRaoBound(const Measurement& m) {
  constexpr double kStep = 1e-6;
  MatrixX information = MatrixX::Zero(m.parameters, m.parameters);
  const VectorX no_dx = VectorX::Zero(m.parameters), no_e = VectorX::Zero(m.noise_sd.size());
  for (int i = 0; i < m.blocks; ++i) {
    const MatrixX J = derivative([&](const VectorX& dx) { return m.constraint(i, dx, no_e); },
                                 m.parameters, kStep);
    const MatrixX N = derivative([&](const VectorX& e) { return m.constraint(i, no_dx, e); },
                                 m.noise_sd.size(), kStep) *
                      m.noise_sd.asDiagonal();
    information += J.transpose() *
                   MatrixX(N * N.transpose()).completeOrthogonalDecomposition().pseudoInverse() * J;
  }
  return information.inverse();
}

}  // namespace palpa::bench

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
