#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <numbers>
#include <vector>

#include "anatomy/base/error.h"
#include "anatomy/geometry/dense_solvers.h"
#include "apps/bench/bench.h"
#include "apps/bench/estimator_studies.h"
#include "apps/bench/timing.h"
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
    information += J.transpose() * pseudoInverse(N * N.transpose()) * J;
  }
  return inverseOf(information);
}

StudyFigures figuresOf(const EstimatorStudy& study, int sets, double outliers) {
  VectorX errors, bounds;
  double inside = 0, all = 0;
  StudyFigures figures;
  for (int seed = 1; seed <= sets; ++seed) {
    try {
      const EstimateCheck check = study.run(static_cast<std::uint64_t>(seed), outliers);
      if (errors.size() == 0) errors = bounds = VectorX::Zero(check.error.size());
      errors += check.error.cwiseAbs2();
      bounds += check.bound.cwiseAbs2();
      inside += (check.error.cwiseAbs().array() <= check.half95.array()).count();
      all += static_cast<double>(check.error.size());
    } catch (const Error& error) {
      std::fprintf(stderr, "%s, set %d: %s\n", study.name.c_str(), seed, error.what());
      ++figures.refused;
    }
  }
  std::vector<double> ratios;
  for (Eigen::Index k = 0; k < errors.size(); ++k)
    ratios.push_back(std::sqrt(errors[k] / bounds[k]));
  std::sort(ratios.begin(), ratios.end());
  if (ratios.empty()) return figures;
  const std::size_t n = ratios.size();
  figures.ratio = (ratios[n / 2] + ratios[(n - 1) / 2]) / 2;
  figures.worst_ratio = ratios.back();
  figures.coverage = inside / all;
  return figures;
}

void benchCalibration(const CalibrationBenchOptions& options) {
  for (const EstimatorStudy& estimator : estimatorStudies())
    for (const double outliers : {0.0, 0.1}) {
      const StudyFigures figures = figuresOf(estimator, options.sets, outliers);
      const nlohmann::json params{{"estimator", estimator.name},
                                  {"sets", options.sets},
                                  {"outliers", outliers},
                                  {"data", "simulated"}};
      print("rmse_over_crlb", figures.ratio, "1", params);
      print("rmse_over_crlb_worst_parameter", figures.worst_ratio, "1", params);
      print("coverage95", figures.coverage, "1", params);
      print("refused", figures.refused, "sets", params);
    }
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
