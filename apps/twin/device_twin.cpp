#include "apps/twin/device_twin.h"

#include <cmath>

namespace palpa::twin {
namespace {

constexpr int kSubsteps = 4;
constexpr double kSlidingSpeed = 0.002;  // m/s, below which friction fades (regularised Coulomb)
constexpr double kTurnTau = 0.020;       // s, the wrist turns the tool with this lag

double quantised(double value, double step) { return std::round(value / step) * step; }

}  // namespace

DeviceTwin::DeviceTwin(const DeviceTruth& truth, const Pose& X_DE_start)
    : truth_(truth), X_DE_(X_DE_start), p_hand_last_D_(X_DE_start.translation()) {}

void DeviceTwin::advance(double dt, const Pose& X_DH, const HandGrip& grip, const Vec3& f_command_D,
                         const Vec3& f_touch_D) {
  const double h = dt / kSubsteps;
  const double mass = truth_.apparent_mass + grip.mass;
  const double size = f_command_D.norm();
  const Vec3 f_target =
      size > truth_.max_force_N ? Vec3(f_command_D * (truth_.max_force_N / size)) : f_command_D;
  const Vec3 p_hand = X_DH.translation();
  const Vec3 v_hand = (p_hand - p_hand_last_D_) / dt;
  Vec3 p = X_DE_.translation();
  f_fingers_mean_D_ = f_device_mean_D_ = Vec3::Zero();
  for (int i = 0; i < kSubsteps; ++i) {
    f_drive_D_ += (f_target - f_drive_D_) * (h / (truth_.actuator_tau + h));
    const Vec3 p_now = p_hand_last_D_ + (p_hand - p_hand_last_D_) * ((i + 1.0) / kSubsteps);
    f_grip_D_ = grip.stiffness * (p_now - p) + grip.damping * (v_hand - v_D_);
    const Vec3 friction = -v_D_ * (truth_.coulomb / (v_D_.norm() + kSlidingSpeed) + truth_.viscous);
    const Vec3 a_D = (f_grip_D_ + f_drive_D_ + f_touch_D + friction) / mass;
    f_fingers_D_ = f_grip_D_ - grip.mass * a_D;
    f_fingers_mean_D_ += f_fingers_D_ / kSubsteps;
    f_device_mean_D_ += (f_drive_D_ + friction) / kSubsteps;
    v_D_ += a_D * h;
    p += v_D_ * h;
  }
  p_hand_last_D_ = p_hand;
  const Quat q = Quat(X_DE_.rotation()).slerp(dt / (kTurnTau + dt), Quat(X_DH.rotation()));
  X_DE_ = makePose(q.normalized().toRotationMatrix(), p);
}

PackedPose encoderReading(const DeviceTruth& truth, const Pose& X_DE) {
  Vec3 p = X_DE.translation() + truth.position_error.at(X_DE.translation());
  Eigen::AngleAxisd turn(X_DE.rotation());
  Vec3 r = turn.angle() * turn.axis();
  for (int i = 0; i < 3; ++i) {
    p[i] = quantised(p[i], truth.encoder_step);
    r[i] = quantised(r[i], truth.encoder_angle);
  }
  const double angle = r.norm();
  const Quat q = angle > 0 ? Quat(Eigen::AngleAxisd(angle, r / angle)) : Quat::Identity();
  return {pack(p), pack(q)};
}

}  // namespace palpa::twin
