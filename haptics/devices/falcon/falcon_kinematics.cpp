#include "haptics/devices/falcon/falcon_kinematics.h"

#include <cmath>
#include <numbers>

#include "anatomy/base/units.h"

namespace palpa::haptics {
namespace {

// Lengths in metres, as in Stamper's thesis; the Falcon's figures are libnifalcon's
// (FalconGeometry).
constexpr double kThigh = 0.060;         // a
constexpr double kShank = 0.1025;        // b, long side of the parallelogram
constexpr double kGripToKnee = 0.01443;  // c
constexpr double kLink = 0.01125;        // d = e, from the shank's ends to its joints
constexpr double kSideOffset = -0.025;   // f
constexpr double kBaseRadius = 0.040;    // r
constexpr double kBaseSide = -0.02309;   // s
constexpr std::array<double, 3> kAzimuth{105 * kDegree, -15 * kDegree, -135 * kDegree};

constexpr double kCount = 2 * std::numbers::pi / 1280 * (0.01425 / 0.110);  // rad of the thigh
constexpr double kAngleAtZero = 35 * kDegree;
constexpr double kCountsPerNm = -10'000;
constexpr double kMaxCounts = 4096;

constexpr double kAngleTolerance = 1e-10;  // rad; below 1e-11 m of the grip
constexpr int kNewtonSteps = 20, kHalvings = 10;
constexpr double kSingular = 1e-6;  // of den / a: the leg is stretched out or folded

struct Leg {
  double theta1, theta2, theta3;
};

std::optional<Leg> inverseLeg(const Vec3& p, double azimuth) {
  const double cos_az = std::cos(azimuth), sin_az = std::sin(azimuth);
  const double u = cos_az * p.x() + sin_az * p.y() - kBaseRadius;
  const double v = -sin_az * p.x() + cos_az * p.y() - kBaseSide;
  const double w = p.z();
  const double cos_theta3 = (v + kSideOffset) / kShank;
  if (!(std::abs(cos_theta3) < 1)) return std::nullopt;
  const double theta3 = std::acos(cos_theta3);
  const double reach = 2 * kLink + kShank * std::sin(theta3);
  // Eliminating theta2: w sin(theta1) + (u + c) cos(theta1) = m; of the two knees the outer one.
  const double x = u + kGripToKnee;
  const double m = (x * x + w * w + kThigh * kThigh - reach * reach) / (2 * kThigh);
  const double square = x * x + w * w - m * m;
  if (!(square >= 0)) return std::nullopt;
  const double theta1 = std::atan2(w, x) - std::atan2(std::sqrt(square), m);
  const double theta2 = std::atan2(w - kThigh * std::sin(theta1), x - kThigh * std::cos(theta1));
  return Leg{theta1, theta2, theta3};
}

/// One step toward `theta1`, halved until it brings the angles nearer.
bool approach(FalconPose& pose, const Vec3& theta1) {
  const Vec3 error = theta1 - pose.legs.theta1;
  Vec3 step = falconJacobian(pose.legs).inverse() * error;
  for (int i = 0; i < kHalvings; ++i, step /= 2) {
    const Vec3 p = pose.p_DE + step;
    const auto legs = falconInverse(p);
    if (!legs || !((theta1 - legs->theta1).norm() < error.norm())) continue;
    pose = {p, *legs};
    return true;
  }
  return false;
}

}  // namespace

std::optional<FalconLegs> falconInverse(const Vec3& p_DE) noexcept {
  FalconLegs legs;
  for (int i = 0; i < 3; ++i) {
    const auto leg = inverseLeg(p_DE, kAzimuth[static_cast<std::size_t>(i)]);
    if (!leg) return std::nullopt;
    legs.theta1[i] = leg->theta1;
    legs.theta2[i] = leg->theta2;
    legs.theta3[i] = leg->theta3;
  }
  return legs;
}

Mat3 falconJacobian(const FalconLegs& legs) noexcept {
  Mat3 J;
  for (int i = 0; i < 3; ++i) {
    const double azimuth = kAzimuth[static_cast<std::size_t>(i)];
    const double out = std::cos(legs.theta2[i]) * std::sin(legs.theta3[i]);
    const double side = std::cos(legs.theta3[i]);
    const double up = std::sin(legs.theta2[i]) * std::sin(legs.theta3[i]);
    const double den =
        kThigh * std::sin(legs.theta3[i]) * std::sin(legs.theta2[i] - legs.theta1[i]);
    J.row(i) << (std::cos(azimuth) * out - std::sin(azimuth) * side) / den,
        (std::sin(azimuth) * out + std::cos(azimuth) * side) / den, up / den;
  }
  return J;
}

std::optional<FalconPose> falconForward(const Vec3& theta1, const Vec3& p_start_D) noexcept {
  FalconPose pose{p_start_D, {}};
  const auto legs = falconInverse(p_start_D);
  if (!legs || !theta1.allFinite()) return std::nullopt;
  pose.legs = *legs;
  for (int i = 0; i < kNewtonSteps; ++i) {
    if ((theta1 - pose.legs.theta1).cwiseAbs().maxCoeff() < kAngleTolerance) return pose;
    if (!approach(pose, theta1)) break;
  }
  return std::nullopt;
}

Vec3 falconTorque(const FalconLegs& legs, const Vec3& f_D) noexcept {
  const auto flat = [&](int i) {
    return std::abs(std::sin(legs.theta3[i]) * std::sin(legs.theta2[i] - legs.theta1[i])) <
           kSingular;
  };
  if (flat(0) || flat(1) || flat(2)) return Vec3::Zero();
  const Vec3 torque = falconJacobian(legs).inverse().transpose() * f_D;
  return torque.allFinite() ? torque : Vec3(Vec3::Zero());
}

std::array<std::int16_t, 3> falconCounts(const Vec3& torque) noexcept {
  Vec3 counts = kCountsPerNm * torque;
  if (!counts.allFinite()) return {};
  const double largest = counts.cwiseAbs().maxCoeff();
  if (largest > kMaxCounts) counts *= kMaxCounts / largest;
  std::array<std::int16_t, 3> motor{};
  for (int i = 0; i < 3; ++i)
    motor[static_cast<std::size_t>(i)] = static_cast<std::int16_t>(std::lround(counts[i]));
  return motor;
}

Vec3 falconAngles(const std::array<std::int16_t, 3>& encoder) noexcept {
  return Vec3::Constant(kAngleAtZero) + kCount * Vec3(encoder[0], encoder[1], encoder[2]);
}

double falconResolution() noexcept {
  const Mat3 dp_dtheta = falconJacobian(*falconInverse(kFalconCentre)).inverse();
  return kCount * dp_dtheta.colwise().norm().maxCoeff();
}

}  // namespace palpa::haptics
