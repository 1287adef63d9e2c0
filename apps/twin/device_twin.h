#pragma once

#include <array>
#include <cstdint>

#include "anatomy/base/random.h"
#include "haptics/device.h"
#include "haptics/sensors/force_sensor.h"

namespace palpa::twin {

/// A mechanism that is not as its maker's equations have it: a smooth error of position, waves as
/// long as the workspace. Not a polynomial, for what corrects it is one.
struct PositionError {
  Vec3 amplitude = Vec3::Zero(), phase = Vec3::Zero();  ///< m, rad; of each coordinate
  Mat3 wave = Mat3::Zero();                             ///< rad/m; rows: of each coordinate
  Vec3 at(const Vec3& p_D) const {
    return amplitude.cwiseProduct((wave * p_D + phase).array().sin().matrix());
  }
};

/// The mechanical truth of a simulated haptic device. SI units.
struct DeviceTruth {
  double apparent_mass = 0.045;   ///< kg at the end effector
  double coulomb = 0.06;          ///< N, friction of the drives
  double viscous = 0.2;           ///< N s/m
  double encoder_step = 23e-6;    ///< m
  double encoder_angle = 0.0006;  ///< rad
  double max_force_N = 7.9;       ///< the drives saturate here
  double actuator_tau = 0.001;    ///< s, first-order lag of the drives
  PositionError position_error;   ///< what it says less what is
  double weight_N = 0;            ///< of the handle; 0: the mechanism carries it itself
};

/// How a hand holds the tool: a spring and a damper toward where it wants to be.
struct HandGrip {
  double stiffness = 500;  ///< N/m
  double damping = 6;      ///< N s/m
  double mass = 0.15;      ///< kg
};

/// What the electronics of a device show whose end effector truly is at X_DE: every coordinate in
/// whole encoder steps.
PackedPose encoderReading(const DeviceTruth& truth, const Pose& X_DE);

/// Point mass of device and hand, moved by grip, drives and friction; orientation follows the hand.
/// m dv/dt = K (p_hand - p) + B (v_hand - v) + f_drive + f_touch - f_c v/(|v| + v_0) - b v,
/// integrated semi-implicitly with four substeps a millisecond.
class DeviceTwin {
 public:
  DeviceTwin(const DeviceTruth& truth, const Pose& X_DE_start);

  /// Advances by dt toward the hand's wanted pose; `f_command_D` from the controller, `f_touch_D`
  /// of a real object on the tool.
  void advance(double dt, const Pose& X_DH, const HandGrip& grip, const Vec3& f_command_D,
               const Vec3& f_touch_D = Vec3::Zero());

  const Vec3& trueVelocity() const { return v_D_; }  ///< m/s, for accuracy reports only
  const Pose& truePose() const { return X_DE_; }     ///< for accuracy reports only
  /// What moves hand and tool: of the arm on both
  const Vec3& gripForce() const { return f_grip_D_; }
  /// Between hand and tool: of the fingers on the tool: f_grip - m_hand a
  const Vec3& fingerForce() const { return f_fingers_D_; }
  /// What force cells that average over the last `advance` see: the fingers' force on the tool, and
  /// the device's, drives and friction.
  const Vec3& meanFingerForce() const { return f_fingers_mean_D_; }
  const Vec3& meanDeviceForce() const { return f_device_mean_D_; }
  /// What the device's electronics say
  PackedPose encoderPose() const { return encoderReading(truth_, X_DE_); }

 private:
  DeviceTruth truth_;
  Pose X_DE_;
  Vec3 v_D_ = Vec3::Zero(), p_hand_last_D_, f_drive_D_ = Vec3::Zero(), f_grip_D_ = Vec3::Zero(),
       f_fingers_D_ = Vec3::Zero();
  Vec3 f_fingers_mean_D_ = Vec3::Zero(), f_device_mean_D_ = Vec3::Zero();
};

/// The truth of a simulated force sensor and of the tool that it carries. SI units, frame S.
struct SensorTruth {
  double tool_mass = 0.03;    ///< kg
  Packed3 p_SM{0, 0, 0.05};   ///< centre of mass, m
  double tool_length = 0.06;  ///< m along z of S: the mass is spread over it
  Packed3 bias_N{0, 0, 0};
  Packed3 bias_Nm{0, 0, 0};
  double noise_N = 0.005, noise_Nm = 0.0002;  ///< standard deviation of a sample
  Packed3 max_force_N{0, 0, 0};               ///< it shows no more; 0: any
};

/// What a sensor between a device's last link and a tool shows. The tool is three point masses,
/// each pulled by gravity and pushed along its true path (second differences of its positions):
/// what the sensor has to hold them with is Newton's law, point by point, without inertia tensor or
/// angular velocity.
class SensorTwin {
 public:
  SensorTwin(const SensorTruth& truth, std::uint64_t seed);

  /// One step of `dt`; X_WS: where the sensor truly is; `f_contact_W` at `p_W`: of a real object on
  /// the tool.
  haptics::WrenchSample measure(const Pose& X_WS, const Vec3& f_contact_W, const Vec3& p_W,
                                double dt, std::int64_t t_ns);

 private:
  static constexpr std::size_t kPoints = 3;
  SensorTruth truth_;
  RandomStream noise_;
  std::array<Vec3, kPoints> p_S_, p_W_0_, p_W_1_;  // in the tool; one and two steps ago
  double dt_last_ = 0;
  int seen_ = 0;
  std::uint64_t sequence_ = 0;
};

}  // namespace palpa::twin
