#pragma once

#include <array>
#include <cstdint>

#include "apps/runtime/random.h"
#include "haptics/sensors/force_sensor.h"

namespace palpa::twin {

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
  runtime::RandomStream noise_;
  std::array<Vec3, kPoints> p_S_, p_W_0_, p_W_1_;  // in the tool; one and two steps ago
  double dt_last_ = 0;
  int seen_ = 0;
  std::uint64_t sequence_ = 0;
};

}  // namespace palpa::twin
