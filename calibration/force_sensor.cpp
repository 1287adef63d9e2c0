#include "calibration/force_sensor.h"

#include <Eigen/LU>
#include <cmath>

#include "anatomy/base/error.h"
#include "anatomy/base/units.h"
#include "anatomy/geometry/dense_solvers.h"
#include "calibration/rotation.h"

namespace palpa::calibration {
namespace {

const char kForceSensor[] = "force sensor";
constexpr double kNoMass = 1e-3;  // kg
using Vec10 = Eigen::Matrix<double, 10, 1>;

Vec3 weightOf(const StaticReading& reading, const Vec3& down_D) {
  return kGravity * reading.R_DS.transpose() * down_D;
}  // of 1 kg, in S

/// bias_f and mass from the forces alone, then bias_m and mass * centre from the torques.
Vec10 linearStart(const std::vector<StaticReading>& readings, const Vec3& down_D) {
  Eigen::Matrix4d A = Eigen::Matrix4d::Zero();
  Eigen::Vector4d b = Eigen::Vector4d::Zero();
  Eigen::Matrix<double, 6, 6> C = Eigen::Matrix<double, 6, 6>::Zero();
  Eigen::Matrix<double, 6, 1> d = Eigen::Matrix<double, 6, 1>::Zero();
  for (const StaticReading& reading : readings) {
    const Vec3 g = weightOf(reading, down_D);
    Eigen::Matrix<double, 3, 4> force;
    force << Mat3::Identity(), g;
    A += force.transpose() * force;
    b += force.transpose() * reading.f_S;
    Eigen::Matrix<double, 3, 6> torque;
    torque << Mat3::Identity(), -crossMatrix(g);
    C += torque.transpose() * torque;
    d += torque.transpose() * reading.m_S;
  }
  const Eigen::Vector4d f = solveSymmetric(A, b);
  const Eigen::Matrix<double, 6, 1> m = minimumNorm(C, d);
  Vec10 x;
  x << f.head<3>(), m.head<3>(), f[3], m.tail<3>() / (std::abs(f[3]) > 1e-6 ? f[3] : 1e-6);
  return x;
}

void requireTurning(const std::vector<StaticReading>& readings, const Vec3& down_D) {
  Vec3 mean = Vec3::Zero();
  for (const StaticReading& reading : readings)
    mean += reading.R_DS.transpose() * down_D / static_cast<double>(readings.size());
  Mat3 spread = Mat3::Zero();
  for (const StaticReading& reading : readings) {
    const Vec3 off = reading.R_DS.transpose() * down_D - mean;
    spread += off * off.transpose() / static_cast<double>(readings.size());
  }
  const Vec3 sizes = symmetricEigen(spread).values.cwiseMax(0).cwiseSqrt();
  if (sizes[2] < 0.2)
    throw Error(
        "the sensor was hardly turned against the vertical: its tool's weight and its bias look "
        "alike",
        kForceSensor, "Hold it upright, lying and upside down");
  if (sizes[1] < 0.1)
    throw Error(
        "the sensor was turned through a small arc only: its tool's weight and its bias are hardly "
        "told apart",
        kForceSensor, "Turn it by a quarter and more, about two axes");
}

void checkCrossTalk(const std::vector<StaticReading>& readings, const Vec3& down_D,
                    ForceSensorCalibration* result) {
  // f - bias = M w: three rows alike, one least squares.
  Mat3 ww = Mat3::Zero(), fw = Mat3::Zero();
  int count = 0;
  for (std::size_t i = 0; i < readings.size(); ++i) {
    if (!result->fit.good[i]) continue;
    const Vec3 w = result->mass * weightOf(readings[i], down_D);
    ww += w * w.transpose();
    fw += (readings[i].f_S - result->bias_f) * w.transpose();
    ++count;
  }
  result->cross_talk = fw * ww.inverse();
  result->cross_talk_sd = result->rms_f * std::sqrt(ww.inverse().diagonal().maxCoeff());
  const double off = (result->cross_talk - Mat3::Identity()).cwiseAbs().maxCoeff();
  result->cross_talk_found = off > 0.02 && off > 4 * result->cross_talk_sd;
}

}  // namespace

ForceSensorCalibration calibrateForceSensor(const std::vector<StaticReading>& readings,
                                            const Vec3& down_D) {
  if (readings.size() < 6)
    throw Error(std::to_string(readings.size()) + " readings are too few", kForceSensor,
                "Take six at least, upright, lying and upside down");
  for (const StaticReading& reading : readings)
    if (!reading.R_DS.allFinite() || !reading.f_S.allFinite() || !reading.m_S.allFinite())
      throw Error("a reading is not a number", kForceSensor, "Take it again");
  requireTurning(readings, down_D);
  Vec10 x = linearStart(readings, down_D);
  if (x[6] < -kNoMass)
    throw Error(
        "the tool would weigh less than nothing", kForceSensor,
        "Down is up, or the poses are of the base in the sensor instead of the sensor in the base");
  if (x[6] < kNoMass)
    throw Error("the sensor feels no weight of its tool", kForceSensor,
                "Is it switched on, and the tool mounted? Forces are newtons");
  double sd_f = 1, sd_m = 0.05;  // a lever of 50 mm until the residuals tell
  const auto residuals = [&](const VectorX& dx) {
    const Vec10 y = x + Vec10(dx);
    VectorX r(6 * readings.size());
    for (std::size_t i = 0; i < readings.size(); ++i) {
      const Vec3 w = y[6] * weightOf(readings[i], down_D);
      const auto at = static_cast<Eigen::Index>(6 * i);
      r.segment<3>(at) = (readings[i].f_S - y.head<3>() - w) / sd_f;
      r.segment<3>(at + 3) = (readings[i].m_S - y.segment<3>(3) - y.tail<3>().cross(w)) / sd_m;
    }
    return r;
  };
  const FitProblem problem{static_cast<int>(readings.size()), 6, 10, residuals,
                           [&](const VectorX& dx) { x += dx; }};
  ForceSensorCalibration result;
  for (int round = 0; round < 3; ++round) {
    result.fit = robustFit(problem, kForceSensor);
    double f = 0, m = 0;
    int good = 0;
    for (std::size_t i = 0; i < readings.size(); ++i) {
      if (!result.fit.good[i]) continue;
      f += result.fit.r.segment<3>(static_cast<Eigen::Index>(6 * i)).squaredNorm() * sd_f * sd_f;
      m +=
          result.fit.r.segment<3>(static_cast<Eigen::Index>(6 * i + 3)).squaredNorm() * sd_m * sd_m;
      ++good;
    }
    result.rms_f = std::sqrt(f / (3 * good));
    result.rms_m = std::sqrt(m / (3 * good));
    if (round == 2) break;
    sd_f = std::max(result.rms_f, 1e-6);
    sd_m = std::max(result.rms_m, 1e-8);
  }
  result.bias_f = x.head<3>();
  result.bias_m = x.segment<3>(3);
  result.mass = x[6];
  result.centre_S = x.tail<3>();
  result.covariance = result.fit.covariance;
  if (result.mass < 4 * std::sqrt(result.covariance(6, 6)))
    throw Error("the tool's weight is lost in the sensor's noise", kForceSensor,
                "Take more readings, or hang a known weight on the tool");
  checkCrossTalk(readings, down_D, &result);
  return result;
}

}  // namespace palpa::calibration
