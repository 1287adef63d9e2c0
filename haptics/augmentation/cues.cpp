#include "haptics/augmentation/cues.h"

namespace palpa::haptics {

const CueName& cueName(Cue cue) noexcept {
  static constexpr CueName kNames[kCues] = {
      {"none", "", 1},           {"speed", "mm/s", 1e-3},     {"advance", "mm/s", 1e-3},
      {"contact_force", "N", 1}, {"skin_force", "N", 1},      {"wall_force", "N", 1},
      {"bone_force", "N", 1},    {"indentation", "mm", 1e-3}, {"depth", "mm", 1e-3},
      {"phase", "", 1},          {"tissue", "", 1},           {"part", "", 1},
      {"lump_edge", "mm", 1e-3}, {"floor_contact", "", 1},    {"floor_texture", "", 1},
      {"floor_speed", "U/s", 1}, {"learned", "", 1},
  };
  const auto index = static_cast<std::size_t>(cue);
  return kNames[index < kCues ? index : 0];
}

}  // namespace palpa::haptics
