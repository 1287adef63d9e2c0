#include "apps/bench/estimator_studies.h"

#include <cmath>
#include <numbers>

#include "anatomy/base/units.h"
#include "calibration/clock_offset.h"
#include "calibration/force_sensor.h"
#include "calibration/hand_eye.h"
#include "calibration/registration.h"
#include "calibration/rotation.h"
#include "calibration/tool_tip.h"

namespace palpa::bench {
namespace {

using namespace calibration;
using namespace study;

/// The six of a pose's noise: turned in its own frame, shifted.
Pose noisy(const Pose& X, const VectorX& e) { return moved(X, e); }

EstimateCheck pivot(std::uint64_t seed, double outliers) {
  constexpr int kSamples = 200;
  constexpr double kTurn = 0.05 * kDegree, kShift = 1e-4;
  Random random(seed, "study.pivot");
  const std::vector<bool> gross = grossErrors(random, kSamples, outliers);
  const Vec3 tip = Vec3(0.005, -0.003, 0.12), pivot_D = 0.1 * inBall(random);
  std::vector<Pose> truth, seen;
  for (int i = 0; i < kSamples; ++i) {
    const double azimuth = random.uniform(0, 2 * std::numbers::pi),
                 tilt = 35 * kDegree * std::sqrt(random.uniform()), spin = random.uniform(-1, 1);
    const Mat3 R = rotationOf(tilt * Vec3(std::cos(azimuth), std::sin(azimuth), 0)) *
                   rotationOf(spin * Vec3::UnitZ());
    truth.push_back(makePose(R, pivot_D - R * tip));
    VectorX e(6);
    e << kTurn * normal3(random), kShift * normal3(random);
    seen.push_back(noisy(truth.back(), e));
    if (gross[static_cast<std::size_t>(i)]) seen.back().translation() += 0.03 * inBall(random);
  }
  VectorX sd(6);
  sd << Vec3::Constant(kTurn), Vec3::Constant(kShift);
  const MatrixX bound =
      cramerRaoBound({kSamples, 6,
                      [&](int i, const VectorX& dx, const VectorX& e) -> VectorX {
                        const Pose X = noisy(truth[static_cast<std::size_t>(i)], e);
                        return X * Vec3(tip + dx.head<3>()) - (pivot_D + dx.tail<3>());
                      },
                      sd});
  const TipCalibration found = calibrateTip(seen);
  return {found.tip_E - tip, found.half95, sds(bound).head<3>()};
}

EstimateCheck spin(std::uint64_t seed, double outliers) {
  constexpr int kSamples = 100;
  constexpr double kTurn = 0.1 * kDegree;
  Random random(seed, "study.spin");
  const std::vector<bool> gross = grossErrors(random, kSamples, outliers);
  const Vec3 axis = (Vec3::UnitZ() + 0.1 * inBall(random)).normalized(), toward = direction(random);
  const Mat3 upright = rotationWithZ(toward) * rotationWithZ(axis).transpose();
  std::vector<Pose> truth, seen;
  for (int i = 0; i < kSamples; ++i) {
    truth.push_back(
        makePose(upright * rotationOf(random.uniform(0, 270 * kDegree) * axis), Vec3::Zero()));
    Mat3 R = truth.back().linear() * rotationOf(kTurn * normal3(random));
    if (gross[static_cast<std::size_t>(i)]) R = R * rotationOf(0.3 * inBall(random));
    seen.push_back(makePose(R, Vec3::Zero()));
  }
  const AxisCalibration found = calibrateAxis(seen, Vec3::UnitZ());
  const auto& across = found.across_E;  // where the estimate stands; as good a frame as any
  const Eigen::Matrix<double, 3, 2> across_D = rotationWithZ(toward).leftCols<2>();
  const MatrixX bound = cramerRaoBound(
      {kSamples, 4,
       [&](int i, const VectorX& dx, const VectorX& e) -> VectorX {
         const Vec3 a = (axis + across * dx.head<2>()).normalized(),
                    d = (toward + across_D * dx.tail<2>()).normalized();
         return across_D.transpose() *
                (truth[static_cast<std::size_t>(i)].linear() * rotationOf(e) * a - d);
       },
       VectorX::Constant(3, kTurn)});
  return {across.transpose() * (found.axis_E - axis), halves(found.fit).head<2>(),
          sds(bound).head<2>()};
}

EstimateCheck landmarks(std::uint64_t seed, double outliers) {
  constexpr int kLandmarks = 20;
  constexpr double kTouch = 5e-4;
  Random random(seed, "study.landmarks");
  const std::vector<bool> gross = grossErrors(random, kLandmarks, outliers);
  const Pose X_BA = makePose(anyRotation(random), 0.3 * inBall(random));
  std::vector<TouchedLandmark> touched;
  for (int i = 0; i < kLandmarks; ++i) {
    const Vec3 p = Vec3(0.1, 0.1, 0.04).cwiseProduct(inBall(random));
    Vec3 q = X_BA * p + kTouch * normal3(random);
    if (gross[static_cast<std::size_t>(i)]) q += 0.03 * direction(random);
    touched.push_back({p, q, kTouch});
  }
  const MatrixX bound =
      cramerRaoBound({kLandmarks, 6,
                      [&](int i, const VectorX& dx, const VectorX& e) -> VectorX {
                        return moved(X_BA, dx) * touched[static_cast<std::size_t>(i)].p_A -
                               (X_BA * touched[static_cast<std::size_t>(i)].p_A + e);
                      },
                      VectorX::Constant(3, kTouch)});
  const LandmarkRegistration found = registerLandmarks(touched);
  VectorX error(6), half(6);
  error << rotationVector(X_BA.linear().transpose() * found.X_BA.linear()),
      found.X_BA.translation() - X_BA.translation();
  Fit at_origin = found.fit;
  at_origin.covariance = found.covariance;
  return {error, halves(at_origin), sds(bound)};
}

EstimateCheck handEye(std::uint64_t seed, double outliers) {
  constexpr int kSamples = 40;
  Random random(seed, "study.hand_eye");
  const std::vector<bool> gross = grossErrors(random, kSamples, outliers);
  const Pose X_EM = makePose(anyRotation(random), 0.08 * inBall(random));
  const Pose X_DC = makePose(anyRotation(random), Vec3(0.2, -0.1, 0.5) + 0.1 * inBall(random));
  VectorX sd(12);  // of the device, then of the tag as a camera sees it at 0.6 m
  sd << Vec3::Constant(0.02 * kDegree), Vec3::Constant(5e-5), Vec3::Constant(0.2 * kDegree), 2e-4,
      2e-4, 8e-4;
  std::vector<HandEyeSample> truth, seen;
  for (int i = 0; i < kSamples; ++i) {
    // The tag where the camera sees it, turned by up to 40 degrees.
    const Pose X_CM = makePose(
        rotationOf(Vec3(std::numbers::pi, 0, 0)) * rotationOf(40 * kDegree * inBall(random)),
        Vec3(0, 0, 0.6) + 0.12 * inBall(random));
    const Pose X_DE = X_DC * X_CM * X_EM.inverse();
    truth.push_back({X_DE, X_CM});
    VectorX e(12);
    for (Eigen::Index k = 0; k < 12; ++k) e[k] = sd[k] * random.normal();
    seen.push_back({noisy(X_DE, e.head<6>()), noisy(X_CM, e.tail<6>())});
    if (gross[static_cast<std::size_t>(i)])
      seen.back().X_CM = makePose(seen.back().X_CM.linear() * rotationOf(0.5 * direction(random)),
                                  seen.back().X_CM.translation() + 0.05 * direction(random));
  }
  const MatrixX bound =
      cramerRaoBound({kSamples, 12,
                      [&](int i, const VectorX& dx, const VectorX& e) -> VectorX {
                        const HandEyeSample& s = truth[static_cast<std::size_t>(i)];
                        const Pose X_CM = noisy(s.X_CM, e.tail<6>()),
                                   predicted = moved(X_DC, dx.tail<6>()).inverse() *
                                               noisy(s.X_DE, e.head<6>()) *
                                               moved(X_EM, dx.head<6>());
                        VectorX r(6);
                        r << rotationVector(X_CM.linear().transpose() * predicted.linear()),
                            predicted.translation() - X_CM.translation();
                        return r;
                      },
                      sd});
  const HandEye found = calibrateHandEye(seen);
  VectorX error(12);
  error << rotationVector(X_EM.linear().transpose() * found.X_EM.linear()),
      found.X_EM.translation() - X_EM.translation(),
      rotationVector(X_DC.linear().transpose() * found.X_DC.linear()),
      found.X_DC.translation() - X_DC.translation();
  return {error, halves(found.fit), sds(bound)};
}

EstimateCheck clocks(std::uint64_t seed, double outliers) {
  constexpr double kSeconds = 20, kCamera = 5e-4, kDevice = 2e-5;
  Random random(seed, "study.clocks");
  const double offset = random.uniform(-0.2, 0.2), drift = random.uniform(-2e-5, 2e-5);
  const Pose X_CD = makePose(anyRotation(random), Vec3(0, 0, 0.6));
  Eigen::Matrix<double, 3, 4> size, pace, phase;
  for (int k = 0; k < 12; ++k) {
    size(k / 4, k % 4) = random.uniform(0.005, 0.02);
    pace(k / 4, k % 4) = 2 * std::numbers::pi * random.uniform(0.15, 1.3);
    phase(k / 4, k % 4) = random.uniform(0, 2 * std::numbers::pi);
  }
  const auto path = [&](double t) -> Vec3 {
    return (size.array() * (pace.array() * t + phase.array()).sin()).rowwise().sum().matrix();
  };
  std::vector<TimedPoint> device, camera;
  for (double t = -1; t < kSeconds + 1; t += 0.002)
    device.push_back({t, path(t) + kDevice * normal3(random)});
  std::vector<double> times;
  for (double t = 0.5; t < kSeconds - 0.5; t += 1 / 30.0) times.push_back(t);
  const double middle = (times.front() + times.back()) / 2;
  const std::vector<bool> gross = grossErrors(random, times.size(), outliers);
  for (std::size_t i = 0; i < times.size(); ++i) {
    const double t = times[i];
    Vec3 p = X_CD * path(t + offset + drift * (t - middle)) + kCamera * normal3(random);
    if (gross[i]) p += 0.04 * inBall(random);
    camera.push_back({t, p});
  }
  const MatrixX bound = cramerRaoBound(
      {static_cast<int>(times.size()), 8,
       [&](int i, const VectorX& dx, const VectorX& e) -> VectorX {
         const double t = times[static_cast<std::size_t>(i)], d = t - middle,
                      at = t + offset + drift * d;
         return moved(X_CD, dx.tail<6>()) * Vec3(path(at + dx[0] + dx[1] * d) + e.tail<3>()) -
                (X_CD * path(at) + e.head<3>());
       },
       (VectorX(6) << Vec3::Constant(kCamera), Vec3::Constant(kDevice)).finished()});
  const ClockOffset found = estimateClockOffset(camera, device);
  // The middle that was used may differ by the samples left out at the ends.
  const double true_there = offset + drift * (found.t_middle - middle);
  return {Eigen::Vector2d(found.offset - true_there, found.drift - drift),
          halves(found.fit).head<2>(), sds(bound).head<2>()};
}

EstimateCheck forceSensor(std::uint64_t seed, double outliers) {
  constexpr int kReadings = 30;
  constexpr double kForce = 0.02, kTorque = 0.001;
  Random random(seed, "study.force");
  const std::vector<bool> gross = grossErrors(random, kReadings, outliers);
  VectorX x(10);
  x << 0.5 * inBall(random), 0.02 * inBall(random), random.uniform(0.1, 0.2),
      Vec3(0, 0, 0.05) + 0.02 * inBall(random);
  const Vec3 down = -Vec3::UnitZ();
  const auto shown = [&](const Mat3& R, const VectorX& y) -> VectorX {
    const Vec3 w = y[6] * kGravity * R.transpose() * down;
    VectorX both(6);
    both << y.head<3>() + w, y.segment<3>(3) + Vec3(y.tail<3>()).cross(w);
    return both;
  };
  std::vector<StaticReading> readings;
  for (int i = 0; i < kReadings; ++i) {
    StaticReading r;
    r.R_DS = anyRotation(random);
    const VectorX both = shown(r.R_DS, x);
    r.f_S = both.head<3>() + kForce * normal3(random);
    r.m_S = both.tail<3>() + kTorque * normal3(random);
    if (gross[static_cast<std::size_t>(i)])
      r.f_S += 3 * direction(random), r.m_S += 0.1 * direction(random);
    readings.push_back(r);
  }
  const MatrixX bound =
      cramerRaoBound({kReadings, 10,
                      [&](int i, const VectorX& dx, const VectorX& e) -> VectorX {
                        const Mat3& R = readings[static_cast<std::size_t>(i)].R_DS;
                        return shown(R, x + dx) - shown(R, x) - e;
                      },
                      (VectorX(6) << Vec3::Constant(kForce), Vec3::Constant(kTorque)).finished()});
  const ForceSensorCalibration found = calibrateForceSensor(readings, down);
  VectorX y(10);
  y << found.bias_f, found.bias_m, found.mass, found.centre_S;
  return {y - x, halves(found.fit), sds(bound)};
}

/// What counts of a map is where it puts points: nine, in and between those touched.
EstimateCheck workspace(std::uint64_t seed, double outliers) {
  constexpr double kTouch = 2e-4;
  Random random(seed, "study.workspace");
  const std::vector<bool> gross = grossErrors(random, 100, outliers);
  const Pose X_GD = makePose(rotationOf(0.5 * inBall(random)), 0.1 * inBall(random));
  const Vec3 half(0.08, 0.06, 0.05);
  Eigen::Matrix<double, 10, 3> bend;
  for (int k = 0; k < 30; ++k) bend(k / 3, k % 3) = (k < 12 ? 5e-4 : 1e-3) * random.normal();
  const auto monomials = [](const Vec3& q) {
    return (Eigen::Matrix<double, 10, 1>() << 1, q.x(), q.y(), q.z(), q.x() * q.x(), q.x() * q.y(),
            q.x() * q.z(), q.y() * q.y(), q.y() * q.z(), q.z() * q.z())
        .finished();
  };
  const auto onGrid = [&](const Vec3& p, const VectorX& dx) -> Vec3 {
    const auto m = monomials(p.cwiseQuotient(half));
    Vec3 g = X_GD * Vec3(p + bend.transpose() * m);
    for (int k = 0; k < 10; ++k) g += m[k] * dx.segment<3>(3 * k);
    return g;
  };
  const VectorX none = VectorX::Zero(30);
  std::vector<Vec3> at;
  std::vector<TouchedPoint> points;
  for (int i = 0; i < 100; ++i) {
    const Vec3 p = half.cwiseProduct(Vec3(i % 5 / 2.0 - 1, i / 5 % 5 / 2.0 - 1, i / 25 / 1.5 - 1));
    at.push_back(p);
    Vec3 g = onGrid(p, none) + kTouch * normal3(random);
    if (gross[static_cast<std::size_t>(i)]) g += 0.02 * direction(random);
    points.push_back({g, p});
  }
  const MatrixX bound = cramerRaoBound({100, 30,
                                        [&](int i, const VectorX& dx, const VectorX& e) -> VectorX {
                                          const Vec3& p = at[static_cast<std::size_t>(i)];
                                          return onGrid(p, dx) - onGrid(p, none) - e;
                                        },
                                        VectorX::Constant(3, kTouch)});
  const WorkspaceMap found = mapWorkspace(points, 2);
  VectorX error(27), h(27), least(27);
  for (int k = 0; k < 9; ++k) {
    const Vec3 p = half.cwiseProduct(Vec3(k % 3 - 1, k / 3 - 1, 0.5));
    error.segment<3>(3 * k) = found.X_GD * found.corrected(p) - onGrid(p, none);
    const auto m = monomials(p.cwiseQuotient(half));
    MatrixX J(3, 30);
    for (int t = 0; t < 10; ++t) J.middleCols<3>(3 * t) = m[t] * Mat3::Identity();
    least.segment<3>(3 * k) = sds(J * bound * J.transpose());
    Fit there = found.fit;
    there.covariance = found.covarianceAt(p);
    h.segment<3>(3 * k) = halves(there);
  }
  return {error, h, least};
}

}  // namespace

std::vector<EstimatorStudy> estimatorStudies() {
  return {{"tool tip (pivot)", pivot},          {"needle axis (spin)", spin},
          {"landmark registration", landmarks}, {"hand-eye", handEye},
          {"clock offset and drift", clocks},   {"force sensor", forceSensor},
          {"workspace map", workspace},         {"camera", cameraStudy}};
}

}  // namespace palpa::bench
