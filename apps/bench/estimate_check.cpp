#include "apps/bench/estimate_check.h"

#include <Eigen/Dense>
#include <utility>

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
