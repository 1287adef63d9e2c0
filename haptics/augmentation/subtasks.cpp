#include "haptics/augmentation/subtasks.h"

#include <algorithm>
#include <cmath>

namespace palpa::haptics {

const SignalName& signalName(Signal signal) noexcept {
  static constexpr SignalName kNames[kSignals] = {
      {"none", "", 1},           {"speed", "mm/s", 1e-3},     {"advance", "mm/s", 1e-3},
      {"contact_force", "N", 1}, {"skin_force", "N", 1},      {"wall_force", "N", 1},
      {"bone_force", "N", 1},    {"indentation", "mm", 1e-3}, {"depth", "mm", 1e-3},
      {"phase", "", 1},          {"tissue", "", 1},           {"part", "", 1},
      {"lump_edge", "mm", 1e-3}, {"floor_contact", "", 1},    {"floor_texture", "", 1},
      {"floor_speed", "U/s", 1}, {"learned", "", 1},
  };
  const auto index = static_cast<std::size_t>(signal);
  return kNames[index < kSignals ? index : 0];
}

namespace {

constexpr std::int64_t kMillisecond = 1'000'000;  // ns

bool holds(const Condition& c, double value, bool before) noexcept {
  const double back = before ? c.hysteresis * std::abs(c.threshold) : 0;
  switch (c.compare) {
    case Condition::Compare::at_least:
      return value >= c.threshold - back;
    case Condition::Compare::below:
      return value < c.threshold + back;
    case Condition::Compare::equal:
      return std::abs(value - c.threshold) < 0.5;
  }
  return false;
}

}  // namespace

std::uint32_t detect(const Subtasks& subtasks, const SignalValues& signals, std::int64_t now_ns,
                     SubtaskState* state) noexcept {
  std::uint32_t began = 0;
  const std::uint32_t count = std::min<std::uint32_t>(subtasks.count, kMostSubtasks);
  for (std::uint32_t i = 0; i < count; ++i) {
    const Subtask& subtask = subtasks.each[i];
    const std::uint32_t bit = 1u << i;
    const bool before = state->on & bit;
    const std::int64_t ago_ns = now_ns - state->since_ns[i];
    bool held = true, on = true;
    for (std::uint32_t k = 0; k < std::min<std::uint32_t>(subtask.count, kMostConditions); ++k) {
      const Condition& c = subtask.conditions[k];
      const bool now = holds(c, signals[c.signal], before);
      std::int64_t& unheld_ns = state->unheld_ns[i][k];
      if (!now) unheld_ns = now_ns;
      held = held && now;
      on = on && (before ? now || ago_ns < c.hold_ms * kMillisecond
                         : now && now_ns - unheld_ns >= c.after_ms * kMillisecond);
    }
    if (held || on != before) state->since_ns[i] = now_ns;
    if (on == before) continue;
    state->on ^= bit;
    if (on) began |= bit;
  }
  return began;
}

}  // namespace palpa::haptics
