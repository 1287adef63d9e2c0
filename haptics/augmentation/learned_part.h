#pragma once

#include <array>
#include <cstdint>
#include <type_traits>

#include "anatomy/geometry/pose.h"

namespace palpa::haptics {

/// Columns of a step of what was done and felt.
enum LearnedFeature : int { kLogSpeed, kLogForce, kInContact, kLogShaking, kLearnedFeatures };
using LearnedRow = std::array<double, kLearnedFeatures>;

/// What lies below is alike: a hand's tremble, what a fingertip does not tell. Contact begins at
/// the least force. All [chosen].
inline constexpr double kLeastSpeed = 1e-3, kLeastForce_N = 0.02,
                        kLeastShaking_N = 0.005;  ///< m/s, N, N
/// what is faster than 1 / (2 pi tau) = 20 Hz is shaking: hands do not do it [chosen]
inline constexpr double kShakingTau_s = 0.008;
inline constexpr std::int64_t kLearnedStep_ns = 10'000'000;

/// Adds up the ticks of one step.
struct StepSums {
  std::uint32_t ticks = 0, reserved = 0;
  double speed = 0, force = 0, contact = 0, shaking2 = 0;
  Packed3 slow_force{};  ///< N; goes on from step to step
  /// Speed of the tip (m/s), force (N) of the thing on it, seconds since the last tick.
  void add(double tip_speed, const Vec3& f, double dt) noexcept;
  /// Of the step's mean speed v, mean force f, share c of the time in contact, root mean square s
  /// of the force less its low-pass:
  ///   ln max(v, 1 mm/s)   ln max(f, 0.02 N)   c   ln max(s, 0.005 N)
  /// The next step begins. At least one tick was added.
  LearnedRow close() noexcept;
};
static_assert(std::is_trivially_copyable_v<StepSums>);

inline constexpr int kMostLearnedStates = 8;

/// A hidden Markov model as `palpa calibrate subtasks` leaves it, in a tick's hands. No states:
/// none was learned.
struct LearnedModel {
  std::uint32_t states = 0, reserved = 0;
  std::array<double, kMostLearnedStates> start{};
  /// from row to column, for a step
  std::array<std::array<double, kMostLearnedStates>, kMostLearnedStates> transition{};
  std::array<LearnedRow, kMostLearnedStates> mean{}, variance{};
};
static_assert(std::is_trivially_copyable_v<LearnedModel>);

struct LearnedState {
  StepSums sums;
  std::array<double, kMostLearnedStates> belief{};
  std::int64_t step_ns = 0;  ///< of the step that is gathered: how long so far
  std::int32_t state = -1;   ///< the most probable one; -1: nothing is known yet
  std::uint32_t reserved = 0;
};
static_assert(std::is_trivially_copyable_v<LearnedState>);

/// The next tick; at a step's end the belief goes on by the forward recursion (Rabiner 1989):
///   b_j proportional to N(x; mean_j, variance_j) sum_i b_i A_ij
///   at first            N(x; mean_j, variance_j) start_j
/// Says the most probable state, of equals the lower; what is no number tells nothing. Never
/// allocates, never throws.
int learnedState(const LearnedModel& model, double tip_speed, const Vec3& f,
                 std::int64_t elapsed_ns, LearnedState* state) noexcept;

}  // namespace palpa::haptics
