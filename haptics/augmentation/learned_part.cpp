#include "haptics/augmentation/learned_part.h"

#include <algorithm>
#include <cmath>

#include "anatomy/base/pinned_math.h"

namespace palpa::haptics {
namespace {

using Belief = std::array<double, kMostLearnedStates>;

/// ln N(x; mean, variance), features independent; without the part that is the same for all states.
double logDensity(const LearnedModel& model, std::size_t state, const LearnedRow& x) noexcept {
  double sum = 0;
  for (std::size_t d = 0; d < x.size(); ++d) {
    const double away = x[d] - model.mean[state][d], variance = model.variance[state][d];
    sum -= 0.5 * (away * away / variance + pinned::log(variance));
  }
  return sum;
}

Belief predicted(const LearnedModel& model, const LearnedState& state, std::size_t count) noexcept {
  if (state.state < 0) return model.start;
  Belief next{};
  for (std::size_t i = 0; i < count; ++i)
    for (std::size_t j = 0; j < count; ++j) next[j] += state.belief[i] * model.transition[i][j];
  return next;
}

void believe(const LearnedModel& model, const LearnedRow& x, LearnedState* state) noexcept {
  const std::size_t count = std::min<std::size_t>(model.states, kMostLearnedStates);
  const Belief before = predicted(model, *state, count);
  Belief seen{};
  double most = -HUGE_VAL;
  for (std::size_t j = 0; j < count; ++j) most = std::max(most, seen[j] = logDensity(model, j, x));
  double sum = 0;
  Belief next{};
  for (std::size_t j = 0; j < count; ++j) sum += next[j] = before[j] * pinned::exp(seen[j] - most);
  if (!std::isfinite(sum) || sum <= 0)
    return;  // what no state can explain, or no number: as before
  for (std::size_t j = 0; j < count; ++j) state->belief[j] = next[j] / sum;
  state->state = static_cast<std::int32_t>(
      std::max_element(next.begin(), next.begin() + static_cast<std::ptrdiff_t>(count)) -
      next.begin());
}

}  // namespace

void StepSums::add(double tip_speed, const Vec3& f, double dt) noexcept {
  const Vec3 slow = unpack(slow_force) + (f - unpack(slow_force)) * (dt / (kShakingTau_s + dt));
  slow_force = pack(slow);
  const double force_N = f.norm();
  ++ticks;
  speed += tip_speed;
  force += force_N;
  contact += force_N >= kLeastForce_N;
  shaking2 += (f - slow).squaredNorm();
}

LearnedRow StepSums::close() noexcept {
  const double n = ticks;
  LearnedRow row{};
  row[kLogSpeed] = pinned::log(std::max(speed / n, kLeastSpeed));
  row[kLogForce] = pinned::log(std::max(force / n, kLeastForce_N));
  row[kInContact] = contact / n;
  row[kLogShaking] = pinned::log(std::max(std::sqrt(shaking2 / n), kLeastShaking_N));
  const Packed3 slow = slow_force;
  *this = {};
  slow_force = slow;
  return row;
}

int learnedState(const LearnedModel& model, double tip_speed, const Vec3& f,
                 std::int64_t elapsed_ns, LearnedState* state) noexcept {
  if (model.states == 0) return -1;
  if (elapsed_ns <= 0 || !std::isfinite(tip_speed) || !f.allFinite()) return state->state;
  const bool first = state->state < 0 && state->step_ns == 0;
  if (first) state->sums.slow_force = pack(f);
  state->sums.add(tip_speed, f, 1e-9 * static_cast<double>(elapsed_ns));
  state->step_ns += elapsed_ns;
  if (state->step_ns < kLearnedStep_ns) return state->state;
  state->step_ns = 0;
  believe(model, state->sums.close(), state);
  return state->state;
}

}  // namespace palpa::haptics
