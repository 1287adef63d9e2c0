#pragma once

#include "haptics/augmentation/cues.h"

namespace palpa::haptics {

inline constexpr int kMostSubtasks = 8, kMostConditions = 4;

/// A cue against a figure. It begins to hold at its threshold and ceases a share of it beyond:
///   at_least   on: c >= t     off: c < t - h |t|
///   below      on: c < t      off: c >= t + h |t|
///   equal      |c - t| < 1/2, for what is counted
struct Condition {
  enum class Compare : std::uint8_t { at_least, below, equal };
  Cue cue = Cue::none;
  Compare compare = Compare::at_least;
  std::uint8_t reserved[6]{};
  double threshold = 0;      ///< t, SI (U/s for floor_speed)
  double hysteresis = 0.05;  ///< h
};

/// A part of a task: on while all its conditions hold. Several may be on at once.
struct Subtask {
  std::array<Condition, kMostConditions> conditions{};
  std::uint32_t count = 0;  ///< 0: always on
  std::uint32_t reserved = 0;
};

struct Subtasks {
  std::array<Subtask, kMostSubtasks> each{};
  std::uint32_t count = 0;
  std::uint32_t reserved = 0;
};

struct SubtaskState {
  std::array<std::int64_t, kMostSubtasks> since_ns{};  ///< when it came on, or went off
  std::uint32_t on = 0;                                ///< bit i: part i
  std::uint32_t reserved = 0;
};
static_assert(std::is_trivially_copyable_v<Subtasks> && std::is_trivially_copyable_v<SubtaskState>);

/// Which parts are on now; bits in `state->on`. Returns the bits of those that came on in this
/// tick. Never allocates, never throws.
std::uint32_t detect(const Subtasks& subtasks, const CueValues& cues, std::int64_t now_ns,
                     SubtaskState* state) noexcept;

}  // namespace palpa::haptics
