#include "apps/twin/device_twin.h"

#include <algorithm>
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

namespace {

const Vec3 kGravity_W(0, 0, -9.80665);  // m/s^2, standard gravity (CGPM 1901)

}  // namespace

SensorTwin::SensorTwin(const SensorTruth& truth, std::uint64_t seed)
    : truth_(truth), noise_(seed, "bench.force_sensor") {
  // Ends and middle of a rod about its centre of mass.
  for (std::size_t i = 0; i < kPoints; ++i)
    p_S_[i] =
        unpack(truth.p_SM) + (static_cast<double>(i) - 1) * 0.5 * truth.tool_length * Vec3::UnitZ();
}

haptics::WrenchSample SensorTwin::measure(const Pose& X_WS, const Vec3& f_contact_W,
                                          const Vec3& p_W, double dt, std::int64_t t_ns) {
  const Mat3 R_SW = X_WS.linear().transpose();
  const Vec3 f_contact = R_SW * f_contact_W;
  Vec3 f = f_contact, tau = (X_WS.inverse() * p_W).cross(f_contact);
  for (std::size_t i = 0; i < kPoints; ++i) {
    const Vec3 p = X_WS * p_S_[i];
    Vec3 a_W = Vec3::Zero();
    if (seen_ >= 2)
      a_W = ((p - p_W_1_[i]) / dt - (p_W_1_[i] - p_W_0_[i]) / dt_last_) / (0.5 * (dt + dt_last_));
    p_W_0_[i] = p_W_1_[i];
    p_W_1_[i] = p;
    const Vec3 share = truth_.tool_mass / kPoints * (R_SW * (kGravity_W - a_W));
    f += share;
    tau += p_S_[i].cross(share);
  }
  seen_ = std::min(seen_ + 1, 2);
  dt_last_ = dt;
  haptics::WrenchSample sample;
  sample.t_ns = t_ns;
  sample.sequence = ++sequence_;
  sample.ft_sequence = static_cast<std::uint32_t>(sequence_);
  for (int i = 0; i < 3; ++i) {
    const auto k = static_cast<std::size_t>(i);
    const double most = truth_.max_force_N[k];
    const double shown = f[i] + truth_.bias_N[k] + truth_.noise_N * noise_.normal();
    sample.f_S[k] = most > 0 ? std::clamp(shown, -most, most) : shown;
    sample.tau_S[k] = tau[i] + truth_.bias_Nm[k] + truth_.noise_Nm * noise_.normal();
  }
  return sample;
}

}  // namespace palpa::twin
