#include "apps/runtime/haptic_activity.h"

#include <algorithm>

#include "apps/runtime/tool_state.h"

namespace palpa::runtime {
std::int64_t HapticActivity::step(std::int64_t now_ns) {
  const haptics::DeviceReading reading = device_.read(now_ns);
  const LocalGeometry* latest = geometryFor(reading, now_ns);
  const haptics::SensedForce sensed =
      sensing_ ? sensing_->sense(reading, now_ns) : haptics::SensedForce{};
  const haptics::TickCommands* commands = bus_.task_to_haptic.read(now_ns);
  if (state_.tick % kKeyframeTicks == 0)
    bus_.keyframes_to_recorder.push(Keyframe{state_.tick, state_});
  const haptics::TickCommands told = commands ? *commands : haptics::TickCommands{};
  const haptics::Floor* floor = floors_ && told.floor ? floors_->floor(told.floor) : nullptr;
  haptics::FlightRecord record =
      haptics::tick(config_, state_, reading, latest, told, now_ns, sensed, floor);
  device_.command(now_ns, record.f_command_D);
  record.late_ns = due_ns_ < 0 ? 0 : now_ns - due_ns_;
  tell(record, now_ns);
  // Ticks stay on the grid; a tick that is late by more than a period does not cause a burst.
  due_ns_ = std::max((due_ns_ < 0 ? now_ns : due_ns_) + config_.period_ns, now_ns);
  return due_ns_;
}

const LocalGeometry* HapticActivity::geometryFor(const haptics::DeviceReading& reading,
                                                 std::int64_t now_ns) {
  if (!exact_) return bus_.geometry_to_haptic.read(now_ns);
  haptics::FlightRecord record;
  record.reading = reading;
  record.phase = state_.contact.phase;
  ToolState tool = toolStateOf(config_, state_, record, now_ns);
  tool.v_D = {0, 0, 0};
  if (unpack(tool.X_DT).matrix().allFinite()) made_ = exact_->make(tool, now_ns);
  return &made_;
}

void HapticActivity::tell(const haptics::FlightRecord& record, std::int64_t now_ns) {
  bus_.haptic_to_recorder.push(record);
  bus_.haptic_to_task.push(record);
  const ToolState tool = toolStateOf(config_, state_, record, now_ns);
  if (!exact_) bus_.haptic_to_geometry.publish(tool, now_ns);
  bus_.haptic_to_scene.publish(tool, now_ns);
  bus_.haptic_to_link.publish(tool, now_ns);
}

}  // namespace palpa::runtime
