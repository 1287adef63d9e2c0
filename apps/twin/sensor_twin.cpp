#include "apps/twin/sensor_twin.h"

#include <algorithm>
#include <cmath>

namespace palpa::twin {
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
