#pragma once

#include <optional>

#include "anatomy/geometry/error.h"
#include "apps/runtime/rig.h"

/// What every collector does with a station's moments.
namespace palpa::calibrate {

inline constexpr double kPatience = 60;  ///< s without an answer: the person has left

inline runtime::Moment need(runtime::Rig& rig, const char* what) {
  std::optional<runtime::Moment> moment = rig.next();
  if (!moment) throw Error("the station ended while it was set up", what, "Begin again");
  return *moment;
}

inline Pose poseOf(const haptics::DeviceReading& reading) {
  return unpack(PackedPose{reading.p_DE, reading.q_DE});
}

inline bool pressed(const haptics::DeviceReading& reading) {
  return (reading.buttons & runtime::kMarkButton) != 0;
}

}  // namespace palpa::calibrate
