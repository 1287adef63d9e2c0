#pragma once

#include <array>
#include <cstdint>
#include <type_traits>

namespace palpa::haptics {

/// What a task's parts are told by ("cue" in its file): one number each, computed in every tick.
/// Names and units stand in `signalName`.
enum class Signal : std::uint8_t {
  none,
  speed,          ///< of the tip
  advance,        ///< of the tip into the tissue, along the needle
  contact_force,  ///< computed, or sensed of a real thing
  skin_force,
  wall_force,
  bone_force,
  indentation,
  depth,
  phase,          ///< 0 outside, 1 indenting, 2 inserted
  tissue,         ///< at the tip, as its number
  part,           ///< the number of the part that the task itself says is on
  lump_edge,      ///< across the skin from the nearest lump's edge; negative above the lump
  floor_contact,  ///< 1: the probe is in contact with a floor
  floor_texture,  ///< 1: over a textured disc
  floor_speed,    ///< of the probe along the floor, in U a second
  /// The most probable state of a model learned from recordings, from 1 as they are reported; 0:
  /// not known yet
  learned,
  count
};
inline constexpr int kSignals = static_cast<int>(Signal::count);

struct SignalName {
  const char* name;
  const char* unit;  ///< as in a task's file; empty: a plain number
  double si;         ///< a unit, in SI
};
/// For every signal but `none`.
const SignalName& signalName(Signal signal) noexcept;

struct SignalValues {
  std::array<double, kSignals> of{};
  double& operator[](Signal signal) noexcept { return of[static_cast<std::size_t>(signal)]; }
  double operator[](Signal signal) const noexcept { return of[static_cast<std::size_t>(signal)]; }
};

inline constexpr int kMostSubtasks = 8, kMostConditions = 4;

/// A signal against a figure. It begins to hold at its threshold and ceases a share of it beyond:
///   at_least   on: c >= t     off: c < t - h |t|
///   below      on: c < t      off: c >= t + h |t|
///   equal      |c - t| < 1/2, for what is counted
/// Of a part that is on, it is taken to hold for `hold_ms` more: a hand that trembles about a
/// threshold, or a probe that bounces, does not switch the part off and on. Of a part that is off,
/// it begins to hold once it has held for `after_ms`: a hand that turns round is slow, too.
struct Condition {
  enum class Compare : std::uint8_t { at_least, below, equal };
  Signal signal = Signal::none;
  Compare compare = Compare::at_least;
  std::uint16_t hold_ms = 0;
  std::uint32_t after_ms = 0;
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
  std::array<std::int64_t, kMostSubtasks>
      since_ns{};  ///< of a part that is on: when its conditions last held; else when it went off
  /// When each condition last did not hold.
  std::array<std::array<std::int64_t, kMostConditions>, kMostSubtasks> unheld_ns{};
  std::uint32_t on = 0;  ///< bit i: part i
  std::uint32_t reserved = 0;
};
static_assert(std::is_trivially_copyable_v<Subtasks> && std::is_trivially_copyable_v<SubtaskState>);

/// Which parts are on now; bits in `state->on`. Returns the bits of those that came on in this
/// tick. Never allocates, never throws.
std::uint32_t detect(const Subtasks& subtasks, const SignalValues& signals, std::int64_t now_ns,
                     SubtaskState* state) noexcept;

}  // namespace palpa::haptics
