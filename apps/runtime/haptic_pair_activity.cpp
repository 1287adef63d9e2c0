#include "apps/runtime/haptic_pair_activity.h"

#include <algorithm>

#include "apps/runtime/tool_state.h"

namespace palpa::runtime {

std::int64_t HapticPairActivity::step(std::int64_t now_ns) {
  std::array<haptics::DeviceReading, 2> readings;
  std::array<haptics::SensedForce, 2> sensed;
  for (std::size_t t = 0; t < 2; ++t) {
    readings[t] = tools_[t].device.read(now_ns);
    sensed[t] = tools_[t].sensing.sense(readings[t], now_ns);
  }
  const haptics::TickCommands* commands = bus_.task_to_haptic.read(now_ns);
  std::array<haptics::FlightRecord, 2> records = haptics::tickPair(
      config_, state_, readings, commands ? *commands : haptics::TickCommands{}, now_ns, sensed);
  for (std::size_t t = 0; t < 2; ++t) {
    tools_[t].device.command(now_ns, records[t].f_command_D);
    records[t].late_ns = due_ns_ < 0 ? 0 : now_ns - due_ns_;
    bus_.haptic_to_recorder.push(records[t]);
    bus_.haptic_to_task.push(records[t]);
  }
  const std::array<ToolState, 2> told{
      toolStateOf(config_.tools[0], state_.tools[0], records[0], now_ns),
      toolStateOf(config_.tools[1], state_.tools[1], records[1], now_ns)};
  bus_.haptic_to_scene.publish(told[0], now_ns);
  bus_.second_to_scene.publish(told[1], now_ns);
  bus_.haptic_to_link.publish(told[0], now_ns);
  bus_.second_to_link.publish(told[1], now_ns);
  due_ns_ = std::max((due_ns_ < 0 ? now_ns : due_ns_) + period_ns(), now_ns);
  return due_ns_;
}

}  // namespace palpa::runtime
