#include "apps/runtime/tool_state.h"

namespace palpa::runtime {

ToolState toolStateOf(const PackedPose& X_DT, const haptics::FlightRecord& record) {
  ToolState tool;
  tool.t_ns = record.t_ns;
  tool.X_DT = X_DT;
  tool.f_contact_D = record.f_contact_D;
  tool.f_command_D = record.f_command_D;
  tool.depth = record.depth;
  tool.plunger = record.reading.plunger;
  tool.bone_force = record.bone_force;
  tool.phase = record.phase;
  tool.tissue = record.tissue;
  tool.wall = record.wall;
  tool.bone = record.bone;
  tool.safety = record.safety;
  tool.homed = record.reading.homed;
  if (record.sensed.state == haptics::SensorState::valid) tool.f_sensed_D = record.sensed.f_D;
  return tool;
}

ToolState toolStateOf(const haptics::TickConfig& config, const haptics::TickState& state,
                      const haptics::FlightRecord& record, std::int64_t now_ns) {
  ToolState tool = toolStateOf(haptics::toolPose(config, state, record.reading), record);
  tool.t_ns = now_ns;
  tool.v_D =
      config.engine == haptics::Engine::probe ? state.probe.motion.v_D : state.contact.motion.v_D;
  tool.entry_D = state.contact.entry_D;
  return tool;
}

}  // namespace palpa::runtime
