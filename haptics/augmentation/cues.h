#pragma once

#include <array>
#include <cstdint>
#include <type_traits>

namespace palpa::haptics {

/// What a task's parts are told by: one number each, computed in every tick. Names and units stand
/// in `cueName`.
enum class Cue : std::uint8_t {
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
  learned,  ///< the most probable state of a model learned from recordings, from 1 as they are
            ///< reported; 0: not known yet
  count
};
inline constexpr int kCues = static_cast<int>(Cue::count);

struct CueName {
  const char* name;
  const char* unit;  ///< as in a task's file; empty: a plain number
  double si;         ///< a unit, in SI
};
/// For every cue but `none`.
const CueName& cueName(Cue cue) noexcept;

struct CueValues {
  std::array<double, kCues> of{};
  double& operator[](Cue cue) noexcept { return of[static_cast<std::size_t>(cue)]; }
  double operator[](Cue cue) const noexcept { return of[static_cast<std::size_t>(cue)]; }
};

}  // namespace palpa::haptics
