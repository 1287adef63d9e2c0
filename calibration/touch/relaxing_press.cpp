#include "calibration/touch/relaxing_press.h"

#include <algorithm>
#include <cmath>

#include <Eigen/Cholesky>

#include "anatomy/base/error.h"

namespace palpa::calibration {
namespace {

constexpr const char* kRelaxingWhere = "identification of a press";
constexpr double kApart_s = 0.012;   // between samples that count: noise that the filter left
constexpr double kEvery_s = 0.004;   // between samples that the law follows
constexpr double kLightest_N = 0.1;  // of the largest force
constexpr double kBegins = 0.03;     // of the largest force: contact, roughly
constexpr double kBefore = 1.5e-3;   // m: so far above it, what is felt counts, too
// What the filter leaves [chosen]: of a place by the encoders' steps, m, which shift a whole press,
// and many presses alike; of the sensor's noise, N
constexpr double kPlaceNoise = 3e-5, kForceNoise_N = 2e-3;
constexpr double kNear = 3e-4;  // m: nearer to first contact the slope is taken as there
constexpr std::size_t kFewestCounted = 10, kFewestPresses = 3;
constexpr double kLeastNoise_N = 1e-3, kFirstNoise_N = 4e-3;
// What is known before a press, standard deviations: b and c [chosen: twice as stiff at twice the
// depth is a lot], e, a share; the surface, mm and mm over 50 mm; its unevenness, mm, at first and
// at least
constexpr double kB = 0.5, kC = 0.25, kE = 0.3, kShare = 0.3, kSurface = 2, kSlope = 2,
                 kUnevenFirst = 0.1, kUnevenLeast = 0.02, kSlopeOver = 0.05, kOffset = 2;
constexpr double kOffset_N = 0.01;  // unit

constexpr Eigen::Index kOwn = 4, kShares = 5, kSurfaceAt = kShares, kBendAt = kSurfaceAt + 3,
                       kOffsetAt = kBendAt + 1, kShared = kOffsetAt + 1;
using Own = Eigen::Vector4d;  ///< ln f_d, b, c, x0 in mm: of like size
using Shared = Eigen::Matrix<double, kShared, 1>;
using SharedSquare = Eigen::Matrix<double, kShared, kShared>;
constexpr double kMillimetre = 1e-3;

Relaxation relaxationOf(const Shared& shared) {
  Relaxation law;
  for (Eigen::Index i = 0; i < kShares; ++i) law.share[static_cast<std::size_t>(i)] = shared[i];
  return law;
}

/// What the surface's three figures count for x0, mm, at a place.
Eigen::Vector3d surfaceAt(const Eigen::Vector2d& p) {
  return {1, p.x() / kSlopeOver, p.y() / kSlopeOver};
}

/// One press in the joint problem.
struct OnePress {
  std::vector<double> x, f;  ///< m, N, `dt` apart
  double dt = 0;
  std::vector<std::size_t> counted;
  std::vector<double> weight;  ///< of those
  Eigen::Vector3d surface;     ///< surfaceAt
  Own own = Own::Zero();
  double depth = 0, noise_N = kFirstNoise_N;
  MatrixX covariance = MatrixX::Zero(kOwn, kOwn);

  std::vector<double> elastic(const Own& at, double bend) const {
    std::vector<double> E;
    E.reserve(x.size());
    for (const double depth_at : x) {
      const double u = (depth_at - kMillimetre * at[3]) / depth, v = u - 1;
      E.push_back(u > 0 ? u * std::sqrt(u) * std::exp(at[0] + v * (at[1] + v * (at[2] + v * bend)))
                        : 0.0);
    }
    return E;
  }
  /// N: of the samples that count, then of what is known before.
  VectorX residuals(const Shared& shared, double uneven_mm, const Own& at) const {
    const std::vector<double> told =
        relaxed(relaxationOf(shared), elastic(at, shared[kBendAt]), dt);
    const auto n = static_cast<Eigen::Index>(counted.size());
    VectorX left(n + 3);
    for (std::size_t i = 0; i < counted.size(); ++i)
      left[static_cast<Eigen::Index>(i)] =
          weight[i] * (f[counted[i]] - kOffset_N * shared[kOffsetAt] -
                       std::max(told[counted[i]], 0.0));  // it does not pull
    const double x0_mm = surface.dot(shared.segment<3>(kSurfaceAt));
    left.tail<3>() = noise_N * Eigen::Vector3d(at[1] / kB, at[2] / kC, (at[3] - x0_mm) / uneven_mm);
    return left;
  }
  void fit(const Shared& shared, double uneven_mm) {
    FitProblem problem{static_cast<int>(counted.size()) + 3, 1, static_cast<int>(kOwn),
                       [&](const VectorX& d) { return residuals(shared, uneven_mm, own + Own(d)); },
                       [&](const VectorX& d) { own += Own(d); }};
    problem.keep_all = true;
    const Fit found = robustFit(problem, kRelaxingWhere);
    covariance = found.covariance;
    noise_N = std::max(found.sigma, kLeastNoise_N);
  }
};

/// What the sensor shows at first, in the air, N.
double inTheAir(const std::vector<double>& f) {
  constexpr std::size_t kFirst = 8;
  const std::size_t count = std::min(kFirst, f.size());
  double sum = 0;
  for (std::size_t i = 0; i < count; ++i) sum += f[i];
  return count > 0 ? sum / static_cast<double>(count) : 0;
}

OnePress onePressOf(const Press& press, double dt, double depth) {
  OnePress one;
  const auto every = static_cast<std::size_t>(std::max(1.0, std::round(kEvery_s / dt)));
  one.dt = static_cast<double>(every) * dt;
  one.depth = depth;
  one.surface = surfaceAt(press.at);
  for (std::size_t i = 0; i < press.samples.size(); i += every) {
    const PressSample& s = press.samples[i];
    if (!std::isfinite(s.x) || !std::isfinite(s.f))
      throw Error("holds invalid figures", kRelaxingWhere, "Record it again");
    one.x.push_back(s.x);
    one.f.push_back(s.f);
  }
  const double air = inTheAir(one.f),
               largest = one.f.empty() ? 0 : *std::max_element(one.f.begin(), one.f.end()) - air;
  if (largest < kLightest_N)
    throw Error("the touch was too light", kRelaxingWhere, "Press a little deeper");
  double begins = 1e9, deepest = -1e9;
  for (std::size_t i = 0; i < one.f.size(); ++i) {
    if (one.f[i] - air > kBegins * largest) begins = std::min(begins, one.x[i]);
    deepest = std::max(deepest, one.x[i]);
  }
  const auto apart = static_cast<std::size_t>(std::max(1.0, std::round(kApart_s / one.dt)));
  std::size_t in_contact = 0;
  for (std::size_t i = 0; i < one.x.size(); i += apart) {
    if (one.x[i] < begins - kBefore) continue;
    one.counted.push_back(i);
    const double slope = 1.5 * std::max(one.f[i] - air, 0.0) / std::max(one.x[i] - begins, kNear);
    one.weight.push_back(1 / std::hypot(1, slope * kPlaceNoise / kForceNoise_N));
    in_contact += one.x[i] > begins;
  }
  if (in_contact < kFewestCounted)
    throw Error("the touch was too short", kRelaxingWhere, "Press for half a second");
  one.own = {std::log(largest) + 1.5 * std::log(depth / std::max(deepest - begins, 0.1 * depth)), 0,
             0, begins / kMillimetre};
  return one;
}

/// What all presses together say of what they share: N step = -g; and by how much ln f_d follows,
/// on average.
struct SharedProblem {
  SharedSquare N = SharedSquare::Zero();
  Shared g = Shared::Zero(), follows = Shared::Zero();

  explicit SharedProblem(const Shared& at) {
    Shared known;
    known << Shared::Constant(1 / kShare).head<kShares>(), 1 / kSurface, 1 / kSlope, 1 / kSlope,
        1 / kE, 1 / kOffset;
    N.diagonal() = known.cwiseAbs2();
    g = known.cwiseAbs2().cwiseProduct(at);
  }
  void add(const OnePress& press, const Shared& shared, double uneven_mm) {
    constexpr double kSharedStep = 1e-3, kOwnStep = 1e-4;
    const VectorX left = press.residuals(shared, uneven_mm, press.own);
    MatrixX by_shared(left.size(), kShared), by_own(left.size(), kOwn);
    for (Eigen::Index i = 0; i < kShared; ++i)
      by_shared.col(i) =
          (press.residuals(shared + kSharedStep * Shared::Unit(i), uneven_mm, press.own) - left) /
          kSharedStep;
    for (Eigen::Index i = 0; i < kOwn; ++i)
      by_own.col(i) =
          (press.residuals(shared, uneven_mm, press.own + kOwnStep * Own::Unit(i)) - left) /
          kOwnStep;
    const MatrixX moves =  // of its own figures with the shared ones
        -(by_own.transpose() * by_own).ldlt().solve(by_own.transpose() * by_shared);
    const MatrixX J = by_shared + by_own * moves;
    const double variance = press.noise_N * press.noise_N;
    N += J.transpose() * J / variance;
    g += J.transpose() * left / variance;
    follows += moves.row(0).transpose();
  }
};

/// The shared figures after a step, no share below 0. How far the farthest went.
double stepShared(const Shared& step, Shared* shared) {
  constexpr double kMostShare = 2, kFarthest = 0.1;
  const Shared before = *shared;
  const double shortened = std::min(1.0, kFarthest / step.head<kShares>().cwiseAbs().maxCoeff());
  *shared += shortened * step;
  shared->head<kShares>() = shared->head<kShares>().cwiseMax(0).cwiseMin(kMostShare);
  return (*shared - before).cwiseAbs().maxCoeff();
}

/// All presses at once.
struct Together {
  std::vector<OnePress> all;
  Shared shared = Shared::Zero();
  double uneven_mm = kUnevenFirst, shared_sd = 0;

  /// Each press by what is shared so far, then that by all presses. How far its farthest figure
  /// went.
  double refine() {
    SharedProblem problem(shared);
    for (OnePress& press : all) {
      press.fit(shared, uneven_mm);
      problem.add(press, shared, uneven_mm);
    }
    const Eigen::LDLT<SharedSquare> normal(problem.N);
    const Shared follows = problem.follows / static_cast<double>(all.size());
    const double by_place = 1.5 * kPlaceNoise / all.front().depth;  // d ln f_d = 1.5 dx / d
    shared_sd = std::hypot(std::sqrt(follows.dot(normal.solve(follows))), by_place);
    return stepShared(-normal.solve(problem.g), &shared);
  }
  double deviation_mm() const {
    double squares = 0;
    for (const OnePress& press : all) {
      const double off = press.own[3] - press.surface.dot(shared.segment<3>(kSurfaceAt));
      squares += off * off + press.covariance(3, 3);
    }
    return std::sqrt(squares / static_cast<double>(all.size()));
  }
  PressedThing told(double depth) const {
    PressedThing thing;
    thing.relaxation = relaxationOf(shared);
    thing.surface =
        kMillimetre * shared.segment<3>(kSurfaceAt)
                          .cwiseProduct(Eigen::Vector3d(1, 1 / kSlopeOver, 1 / kSlopeOver));
    thing.uneven = kMillimetre * uneven_mm;
    thing.bend = shared[kBendAt];
    thing.offset_N = kOffset_N * shared[kOffsetAt];
    thing.shared_sd = shared_sd;
    for (const OnePress& press : all)
      thing.presses.emplace_back(ElasticPress{std::exp(press.own[0]), press.own[1], press.own[2],
                                              kMillimetre * press.own[3], depth,
                                              std::sqrt(press.covariance(0, 0)), press.noise_N});
    return thing;
  }
};

}  // namespace

std::vector<double> relaxed(const Relaxation& law, const std::vector<double>& E, double dt) {
  std::array<double, Relaxation::kTimes.size()> q{}, stays{}, rises{};
  for (std::size_t i = 0; i < q.size(); ++i) {
    stays[i] = std::exp(-dt / Relaxation::kTimes[i]);
    // the rise spread evenly over dt, each part of it fading since
    rises[i] = law.share[i] * Relaxation::kTimes[i] / dt * (1 - stays[i]);
  }
  std::vector<double> f;
  f.reserve(E.size());
  double before = 0;
  for (const double now : E) {
    double sum = now;
    for (std::size_t i = 0; i < q.size(); ++i) {
      q[i] = stays[i] * q[i] + rises[i] * (now - before);
      sum += q[i];
    }
    before = now;
    f.push_back(sum);
  }
  return f;
}

TouchedPlace stiffnessOf(const ElasticPress& press, const Eigen::Vector2d& at) {
  return {at, std::log(press.f_d / press.depth), press.sd};
}

PressedThing identifyPresses(const std::vector<Press>& presses, double dt, double depth) {
  constexpr int kRounds = 30;
  constexpr double kStill = 3e-4, kStillUneven = 0.03;
  Together together;
  std::vector<bool> tells;
  std::string why;
  for (const Press& press : presses) {
    try {
      together.all.push_back(onePressOf(press, dt, depth));
      tells.push_back(true);
    } catch (const Error& e) {
      tells.push_back(false);
      why = e.what();
    }
  }
  if (together.all.size() < kFewestPresses)
    throw Error("rests on " + std::to_string(together.all.size()) + " presses" +
                    (why.empty() ? "" : "; others tell nothing: " + why),
                kRelaxingWhere, "Press and hold at three places or more");
  for (int round = 0; round < kRounds; ++round) {
    const double moved = together.refine(), before_mm = together.uneven_mm;
    together.uneven_mm = std::max(together.deviation_mm(), kUnevenLeast);
    if (moved < kStill && before_mm - together.uneven_mm < kStillUneven * before_mm) break;
  }
  PressedThing thing = together.told(depth);
  for (std::size_t k = 0; k < tells.size(); ++k)  // in the presses' order
    if (!tells[k])
      thing.presses.insert(thing.presses.begin() + static_cast<std::ptrdiff_t>(k), std::nullopt);
  thing.why = why;
  return thing;
}

}  // namespace palpa::calibration
