#pragma once

#include <array>
#include <cstdint>
#include <optional>

#include "anatomy/geometry/pose.h"

/// Kinematics of the Novint Falcon: three legs of a thigh, driven by a motor at the base, and a
/// parallelogram that carries the grip without turning it (R. L. Stamper, A three degree of freedom
/// parallel manipulator with only translational degrees of freedom, University of Maryland 1997).
///
/// Frame D: origin on the device's axis in the plane of the legs' shafts; seen by the user who sits
/// in front of the ball: +x right, +y up, +z out of the device, toward the user. The azimuths of
/// the legs in falcon_kinematics.cpp say how the machine stands in D; no other place knows the
/// axes. Metres, radians, newtons, newton metres. A Vec3 of angles or torques holds one leg a
/// component.
///
/// In a leg's own frame p is (u, v, w) = Rz(azimuth)^T p_DE - (r, s, 0), and
///   v + f = b cos(theta3),  k = b sin(theta3)
///   u     = a cos(theta1) - c + (d + e + k) cos(theta2)
///   w     = a sin(theta1)     + (d + e + k) sin(theta2)
/// theta1 turns the thigh, theta2 the parallelogram in the leg's plane, theta3 is its swing
/// sideways.
namespace palpa::haptics {

struct FalconLegs {
  Vec3 theta1 = Vec3::Zero(), theta2 = Vec3::Zero(), theta3 = Vec3::Zero();
};

struct FalconPose {
  Vec3 p_DE = Vec3::Zero();
  FalconLegs legs;
};

/// Middle of the grip's travel along the axis.
inline const Vec3 kFalconCentre{0, 0, 0.1225};

/// Angles of the legs with the grip at `p_DE`; none where a leg does not reach.
std::optional<FalconLegs> falconInverse(const Vec3& p_DE) noexcept;

/// J = d theta1 / d p_DE, rad/m, a row a leg. With den = a sin(theta3) sin(theta2 - theta1) a row
/// is Rz(azimuth) (cos(theta2) sin(theta3), cos(theta3), sin(theta2) sin(theta3)) / den.
Mat3 falconJacobian(const FalconLegs& legs) noexcept;

/// Where the grip is: Newton's method on falconInverse() from `p_start_D`, to 1e-10 rad; none when
/// it does not get there (angles that no position has).
std::optional<FalconPose> falconForward(const Vec3& theta1, const Vec3& p_start_D) noexcept;

/// Torques about the thighs that push the grip with `f_D`: f.v = tau.(J v) for every v, so tau =
/// J^-T f. Zero where J cannot be inverted.
Vec3 falconTorque(const FalconLegs& legs, const Vec3& f_D) noexcept;

/// Motor counts for these torques: -10,000 counts per N m of the thigh (libnifalcon's figure, not
/// measured here). Beyond 4096 all three shrink together, which keeps the force's direction. What
/// is not finite gives zero.
std::array<std::int16_t, 3> falconCounts(const Vec3& torque) noexcept;

/// theta1 of homed encoders: 35 degrees at count zero (approximate), 1280 counts a turn of the
/// motor, whose shaft of 14.25 mm drives a drum of 110 mm.
Vec3 falconAngles(const std::array<std::int16_t, 3>& encoder) noexcept;

/// Longest step of the grip at the centre when one encoder counts one further: the longest column
/// of J^-1 times the angle of a count, m.
double falconResolution() noexcept;

}  // namespace palpa::haptics
