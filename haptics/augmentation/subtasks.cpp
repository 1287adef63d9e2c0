#include "haptics/augmentation/subtasks.h"

#include <algorithm>
#include <cmath>

namespace palpa::haptics {
namespace {

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

std::uint32_t detect(const Subtasks& subtasks, const CueValues& cues, std::int64_t now_ns,
                     SubtaskState* state) noexcept {
  std::uint32_t began = 0;
  const std::uint32_t count = std::min<std::uint32_t>(subtasks.count, kMostSubtasks);
  for (std::uint32_t i = 0; i < count; ++i) {
    const Subtask& subtask = subtasks.each[i];
    const std::uint32_t bit = 1u << i;
    const bool before = state->on & bit;
    bool on = true;
    for (std::uint32_t k = 0; k < std::min<std::uint32_t>(subtask.count, kMostConditions); ++k)
      on = holds(subtask.conditions[k], cues[subtask.conditions[k].cue], before) && on;
    if (on == before) continue;
    state->on ^= bit;
    state->since_ns[i] = now_ns;
    if (on) began |= bit;
  }
  return began;
}

}  // namespace palpa::haptics
