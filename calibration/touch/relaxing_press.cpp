#include "calibration/touch/relaxing_press.h"

#include <algorithm>
#include <cmath>

#include <Eigen/Cholesky>

#include "anatomy/base/error.h"

namespace palpa::calibration {
namespace {

constexpr const char* kRelaxingWhere = "identification of a press";
constexpr double kApart_s = 0.012;   // between samples that count: noise that the filter left
constexpr double kLightest_N = 0.1;  // of the largest force
constexpr double kBegins = 0.03;     // of the largest force: contact, roughly
constexpr std::size_t kFewestCounted = 10;
constexpr double kLeastShape = 0.7, kMostShape = 4;
constexpr double kLeastOutside = 1e-4;  // m: the surface may lie this far before the first contact

/// Samples, and which of them count.
struct Recorded {
  const std::vector<PressSample>* samples;
  double dt = 0, largest = 0;
  std::vector<std::size_t> counted;
};

Recorded recordedOf(const std::vector<PressSample>& press, double dt) {
  Recorded r{&press, dt, 0, {}};
  for (const PressSample& s : press) {
    if (!std::isfinite(s.x) || !std::isfinite(s.f))
      throw Error("holds figures that are none", kRelaxingWhere, "Record it again");
    r.largest = std::max(r.largest, s.f);
  }
  if (r.largest < kLightest_N)
    throw Error("the touch was too light", kRelaxingWhere, "Press a little deeper");
  const auto every = static_cast<std::size_t>(std::max(1.0, std::round(kApart_s / dt)));
  for (std::size_t i = 0; i < press.size(); i += every)
    if (press[i].f > kBegins * r.largest) r.counted.push_back(i);
  if (r.counted.size() < kFewestCounted)
    throw Error("the touch was too short", kRelaxingWhere, "Press for half a second");
  return r;
}

/// State of the fit: ln f_d, m, x0.
struct PressShape {
  Eigen::Vector3d p;
  double depth;
  inline static const Eigen::Vector3d kSteps{1, 1, 1e-3};  // of like size

  std::vector<double> elastic(const std::vector<PressSample>& samples,
                              const Eigen::Vector3d& at) const {
    std::vector<double> E;
    E.reserve(samples.size());
    for (const PressSample& s : samples) {
      const double x = s.x - at[2];
      E.push_back(x > 0 ? std::exp(at[0] + at[1] * std::log(x / depth)) : 0.0);
    }
    return E;
  }
  VectorX residuals(const Recorded& r, const Relaxation& law, const VectorX& dp) const {
    const Eigen::Vector3d at = p + Eigen::Vector3d(dp).cwiseProduct(kSteps);
    const std::vector<double> f = relaxed(law, elastic(*r.samples, at), r.dt);
    VectorX left(static_cast<Eigen::Index>(r.counted.size()));
    for (std::size_t i = 0; i < r.counted.size(); ++i)
      left[static_cast<Eigen::Index>(i)] = (*r.samples)[r.counted[i]].f - f[r.counted[i]];
    return left;
  }
};

/// From where contact roughly begins; a sphere's exponent.
PressShape startOf(const Recorded& r, double depth) {
  double begins = 1e9, deepest = -1e9;
  for (const std::size_t i : r.counted) {
    begins = std::min(begins, (*r.samples)[i].x);
    deepest = std::max(deepest, (*r.samples)[i].x);
  }
  const double x0 = begins - kLeastOutside, m = 1.5;
  const double deep = std::max(deepest - x0, kLeastOutside);
  return {{std::log(r.largest) + m * std::log(depth / deep), m, x0}, depth};
}

Fit fitShape(const Recorded& r, const Relaxation& law, PressShape* shape) {
  return robustFit({static_cast<int>(r.counted.size()), 1, 3,
                    [&](const VectorX& dp) { return shape->residuals(r, law, dp); },
                    [&](const VectorX& dp) {
                      shape->p += Eigen::Vector3d(dp).cwiseProduct(PressShape::kSteps);
                    }},
                   kRelaxingWhere, 0.4);
}

}  // namespace

std::vector<double> relaxed(const Relaxation& law, const std::vector<double>& E, double dt) {
  std::array<double, 3> q{}, stays{};
  for (std::size_t i = 0; i < q.size(); ++i) stays[i] = std::exp(-dt / Relaxation::kTimes[i]);
  std::vector<double> f;
  f.reserve(E.size());
  double before = 0;
  for (const double now : E) {
    double sum = now;
    for (std::size_t i = 0; i < q.size(); ++i) {
      // the rise spread evenly over dt, each part of it fading since
      const double time = Relaxation::kTimes[i] / dt;
      q[i] = stays[i] * q[i] + law.share[i] * (now - before) * time * (1 - stays[i]);
      sum += q[i];
    }
    before = now;
    f.push_back(sum);
  }
  return f;
}

ElasticPress identifyElastic(const std::vector<PressSample>& press, double dt,
                             const Relaxation& relaxation, double depth) {
  const Recorded r = recordedOf(press, dt);
  PressShape shape = startOf(r, depth);
  const Fit fit = fitShape(r, relaxation, &shape);
  ElasticPress found{std::exp(shape.p[0]), shape.p[1], shape.p[2], depth, 0, fit.rms, 0};
  for (const std::size_t i : r.counted)
    found.deepest = std::max(found.deepest, press[i].x - found.x0);
  found.sd = std::sqrt(fit.covariance(0, 0));
  if (!std::isfinite(found.sd) || !(found.m >= kLeastShape && found.m <= kMostShape))
    throw Error("the touch tells no shape", kRelaxingWhere, "Press along the normal, and deeper");
  return found;
}

TouchedPlace stiffnessOf(const ElasticPress& press, const Eigen::Vector2d& at) {
  return {at, std::log(press.f_d / press.depth), press.sd};
}

namespace {

/// What all presses together say of the shares, each press with its shape free to follow (Golub and
/// Pereyra 1973): N step = -g; and by how much ln f_d follows the shares, on average.
struct SharesProblem {
  Eigen::Matrix3d N = Eigen::Matrix3d::Zero();
  Eigen::Vector3d g = Eigen::Vector3d::Zero(), follows = Eigen::Vector3d::Zero();

  void add(const Recorded& press, const Relaxation& law, const PressShape& shape) {
    constexpr double kShareStep = 0.01, kShapeStep = 1e-4;
    const VectorX none = VectorX::Zero(3), left = shape.residuals(press, law, none);
    MatrixX by_share(left.size(), 3), by_shape(left.size(), 3);
    for (Eigen::Index i = 0; i < 3; ++i) {
      Relaxation more = law;
      more.share[static_cast<std::size_t>(i)] += kShareStep;
      by_share.col(i) = (shape.residuals(press, more, none) - left) / kShareStep;
      by_shape.col(i) =
          (shape.residuals(press, law, kShapeStep * VectorX::Unit(3, i)) - left) / kShapeStep;
    }
    const MatrixX moves =  // of the shape with the shares
        -(by_shape.transpose() * by_shape).ldlt().solve(by_shape.transpose() * by_share);
    const MatrixX J = by_share + by_shape * moves;
    const double variance = left.squaredNorm() / static_cast<double>(left.size() - 3);
    N += J.transpose() * J / variance;
    g += J.transpose() * left / variance;
    follows += moves.row(0).transpose();
  }
};

/// The shares after a step, none below 0. How far the farthest went.
double stepShares(const Eigen::Vector3d& step, Relaxation* law) {
  constexpr double kMostShare = 2;
  double moved = 0;
  for (std::size_t i = 0; i < law->share.size(); ++i) {
    const double before = law->share[i];
    law->share[i] = std::clamp(before + step[static_cast<Eigen::Index>(i)], 0.0, kMostShare);
    moved = std::max(moved, std::abs(law->share[i] - before));
  }
  return moved;
}

}  // namespace

FoundRelaxation identifyRelaxation(const std::vector<std::vector<PressSample>>& presses,
                                   double dt) {
  constexpr std::size_t kFewest = 3;
  constexpr int kRounds = 12;
  constexpr double kStill = 1e-4;
  if (presses.size() < kFewest)
    throw Error("rests on " + std::to_string(presses.size()) + " presses", kRelaxingWhere,
                "Press and hold at three places or more");
  std::vector<Recorded> all;
  std::vector<PressShape> shapes;
  for (const std::vector<PressSample>& press : presses) {
    all.push_back(recordedOf(press, dt));
    shapes.push_back(startOf(all.back(), 3e-3));
  }
  FoundRelaxation found;
  for (int round = 0; round < kRounds; ++round) {
    SharesProblem problem;
    for (std::size_t k = 0; k < all.size(); ++k) {
      fitShape(all[k], found.law, &shapes[k]);
      problem.add(all[k], found.law, shapes[k]);
    }
    problem.N.diagonal().array() += 1e-6 * problem.N.trace();
    const Eigen::LDLT<Eigen::Matrix3d> normal(problem.N);
    const Eigen::Vector3d follows = problem.follows / static_cast<double>(all.size());
    found.shared_sd = std::sqrt(follows.dot(normal.solve(follows)));
    if (stepShares(-normal.solve(problem.g), &found.law) < kStill) break;
  }
  return found;
}

}  // namespace palpa::calibration
