#pragma once

#include <array>
#include <cstdint>
#include <type_traits>

#include "haptics/sensors/force_sensor.h"
#include "haptics/sensors/tool_load.h"

namespace palpa::haptics {

/// What a Kalman filter has to know of sensor, tool and device to tell the reaction of the world.
struct ReactionSettings {
  double rate_Hz = 1000;        ///< of the samples and poses
  double noise_N = 0.005;       ///< standard deviation of a force sample
  double place_m = 7e-6;        ///< of a coordinate: an encoder's step / sqrt(12)
  ToolLoad tool;                ///< its mass as identified; the inertia tensor is not used
  Packed3 bias_N{};             ///< as identified, in S
  double mass_sd = 0.02;        ///< standard deviation of the identified mass, of itself
  double bias_sd_N = 0.01;      ///< of a component of the identified bias
  Packed3 p_SK{};               ///< m: the point that touches things
  Packed3 g_W{0, 0, -9.80665};  ///< m/s^2; standard gravity (CGPM 1901), W has +z up
};

/// The reaction of the world on the tool, by a Kalman filter that is not late.
///
/// State along each axis of W: place, velocity, acceleration and jerk of the tool's centre of mass
/// M, the reaction f, and the rate d of what nothing predicts of it; shown are M's place and
///
///   s = R_WS (f_meas - b) - m g = f - m a,          b the bias, m the mass (signs: tool_load.h)
///
/// Jerk and d are random walks. The law of what is touched predicts the rest:
///
///   f' = -c |f|^(1-1/M) v_u u - h v_t / (1 + |v_t|^2/v_s^2) + d,   u = f/|f|,  v_u = v . u,
///                                                                 v_t = v - v_u u,  M = 1.35
/// which for the force law f = k x^M of silicone is f' = (df/dx) x' with c = M k^(1/M), regressed
/// from force and motion, both without what is slow in them; and across it h = 500 N/m, where
/// silicone has 1500 before it slides, until it slides: v_s = 20 mm/s. Without h a tool that rings
/// on a surface to which it sticks is shown wrong: its inertia hides the spring.
/// v is the velocity of K, the point that touches, by a filter of its own (four states).
///
/// A gain is that of the settled filter, found once by iterating the Riccati equation, for a calm
/// hand and, with six hundred times the jerk, for one that is not; between them alert, by the
/// innovation e of M's place over its noise r: the larger of |e|^2/(3 r^2) - 3, by half, from 0 to
/// 1, and the last alert, which fades within 50 ms.
///
/// In the air the reaction is zero, and what is shown is the bias's and the mass's error: both are
/// states of a second filter, which only then learns, from the mean of s + m a over 50 ms, a from
/// M's change of velocity: the bias however the tool is held, the mass only where it is turned, and
/// by no more than a fifth. (The gains are of the identified mass: with half of it the first filter
/// is not stable.) The air is where for 0.1 s the mean of f over 20 ms is no more than 10 mN and
/// what these doubts explain.
///
/// Sources: Kalman, J. Basic Eng. 82, 1960; Simon, Optimal State Estimation, 2006, ch. 5 and 7;
/// Hunt, Crossley, J. Appl. Mech. 42, 1975 (the law). Its settings are [chosen]:
/// reaction_filter.cpp.
class ReactionFilter {
 public:
  ReactionFilter() : ReactionFilter(ReactionSettings{}) {}
  /// UsageError where rate, noise or place is not above zero, or the mass below.
  explicit ReactionFilter(const ReactionSettings& settings);
  const ReactionSettings& settings() const noexcept { return settings_; }

 private:
  friend struct ReactionStep;
  ReactionSettings settings_;
  std::array<double, 36> F_{};  ///< 6 x 6, of a tick; the first four are a place's, too
  /// 6 x 2: of M's place and of s, where places are as predicted and where they are not
  std::array<double, 12> calm_gain_{}, alert_gain_{};
  std::array<double, 4> place_gain_{};  ///< of K's place
};

/// Trivially copyable, all zero: nothing seen yet.
struct ReactionState {
  std::array<double, 18> x{};        ///< 6 x 3, a row a state: p v a j f d, a column an axis of W
  std::array<double, 12> k{};        ///< 4 x 3, p v a j: of K
  std::array<double, 4> load{};      ///< error of the bias in S, N, and of the mass, kg
  std::array<double, 16> load_P{};   ///< its covariance
  Packed3 f_slow{}, k_slow{};        ///< N and m: slow parts of reaction and of K's place
  Packed3 f_late{};                  ///< N, mean reaction of late
  double alert = 0;                  ///< 0: places are as predicted; 1: not at all
  double c = 0;                      ///< predicted rise; 0: not known
  double xy = 0, xx = 0;             ///< sums of its regression, over force and motion
  std::array<double, 9> turn_sum{};  ///< R_WS over the block of ticks in the air
  Packed3 shown_sum{}, v_first{};    ///< s over it, N; M's velocity at its beginning, m/s
  std::int64_t t_ns = 0;
  std::int32_t block = 0;  ///< ticks in it
  std::int32_t reserved = 0;
  std::int32_t seen = 0;   ///< poses without a gap, at most as many as settle it
  std::int32_t quiet = 0;  ///< ticks in the air
};
static_assert(std::is_trivially_copyable_v<ReactionState>);

/// What the world does to the tool now.
struct Reaction {
  Packed3 f_W{};       ///< N
  Packed3 p_WK{};      ///< m: the point that touches
  bool valid = false;  ///< false: sample unusable, or motion not known yet; force zero
};

/// One tick: `sample` and the pose of S in W, both of time `t_ns`. After an unusable or not finite
/// input, or a gap of over ten periods, it begins anew. No allocation, no exception.
Reaction step(const ReactionFilter& filter, ReactionState& state, const WrenchSample& sample,
              const PackedPose& X_WS, std::int64_t t_ns) noexcept;

/// Between two ticks: what is predicted `dt` seconds after the last one, at most one tick ahead.
Reaction ahead(const ReactionFilter& filter, const ReactionState& state, double dt) noexcept;

}  // namespace palpa::haptics
