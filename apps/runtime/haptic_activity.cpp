#include "apps/runtime/haptic_activity.h"
#include "haptics/loop/tick.h"

#include <algorithm>

namespace palpa::runtime {

ForceSensing::Touch ForceSensing::touched(const haptics::WrenchFilter& filter,
                                          const haptics::WrenchSample& sample, const Pose& X_WS,
                                          std::int64_t t_ns, std::int64_t) noexcept {
  const haptics::ContactWrench told = haptics::step(filter, low_passed_, sample, pack(X_WS), t_ns);
  return {X_WS.linear() * unpack(told.contact.f_S), told.p_WK, told.valid, low_passed_.held != 0};
}

/// A step is a reading's: the loop may ask more often than the device speaks. What is silent for
/// longer than a tick is no reading any more: the last word holds.
ForceSensing::Touch ForceSensing::touched(const haptics::ReactionFilter& filter,
                                          const haptics::WrenchSample& sample, const Pose& X_WS,
                                          std::int64_t t_ns, std::int64_t now_ns) noexcept {
  const bool well = !(sample.flags & haptics::kUnusable) && haptics::finite(sample.f_S);
  const bool again = well && predicted_.seen > 0 && t_ns == predicted_.t_ns;
  const double since = 1e-9 * static_cast<double>(now_ns - stepped_ns_);
  if (again && since * filter.settings().rate_Hz > 1) return {Vec3::Zero(), {}, false, true};
  if (!again) stepped_ns_ = now_ns;
  const haptics::Reaction told = again
                                     ? haptics::ahead(filter, predicted_, since)
                                     : haptics::step(filter, predicted_, sample, pack(X_WS), t_ns);
  return {unpack(told.f_W), told.p_WK, told.valid, well};
}

haptics::SensedForce ForceSensing::sense(const haptics::DeviceReading& reading,
                                         std::int64_t now_ns) noexcept {
  haptics::SensedForce sensed;
  sensed.state = haptics::SensorState::unusable;
  const haptics::WrenchSample sample = sensor_.read(now_ns);
  if (!reading.homed) {  // nobody knows which way is down
    low_passed_ = {};
    predicted_ = {};
    last_ns_ = -kGoodFor_ns - 1;
    return sensed;
  }
  const Quat q_DE = unpack(reading.q_DE).normalized();
  const Pose X_DS = makePose(q_DE.toRotationMatrix(), unpack(reading.p_DE)) * setup_.X_ES;
  const Pose X_WS = setup_.X_WD * X_DS;
  const auto told_by = [&](const auto& filter) {
    return touched(filter, sample, X_WS, reading.t_ns, now_ns);
  };
  const haptics::WrenchFilter* const low_pass = std::get_if<haptics::WrenchFilter>(&setup_.filter);
  const Touch touch = low_pass ? told_by(*low_pass)
                               : told_by(*std::get_if<haptics::ReactionFilter>(&setup_.filter));
  if (!touch.well) last_ns_ = -kGoodFor_ns - 1;  // what it said before is no word for after
  if (!touch.valid) return now_ns - last_ns_ <= kGoodFor_ns ? last_ : sensed;
  sensed.state = haptics::SensorState::valid;
  sensed.f_D = pack(Vec3(setup_.X_WD.linear().transpose() * touch.f_W));
  sensed.p_DK = pack(Vec3(setup_.X_WD.inverse() * unpack(touch.p_WK)));
  last_ = sensed;
  last_ns_ = now_ns;
  return sensed;
}

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
  if (haptics::hasForce(record.sensed.state)) tool.f_sensed_D = record.sensed.f_D;
  return tool;
}

ToolState toolStateOf(const haptics::TickConfig& config, const haptics::TickState& state,
                      const haptics::FlightRecord& record, std::int64_t now_ns) {
  ToolState tool = toolStateOf(haptics::toolPose(config, state, record.reading), record);
  tool.t_ns = now_ns;
  tool.v_D = config.contact_mode == haptics::ContactMode::probe ? state.probe.motion.v_D
                                                                : state.contact.motion.v_D;
  tool.entry_D = state.contact.entry_D;
  return tool;
}

namespace {

/// What the task wants, and past everything that may hold it up, the emergency stop.
haptics::TickCommands commandsFor(Bus& bus, std::int64_t now_ns) {
  const haptics::TickCommands* const newest = bus.task_to_haptic.read(now_ns);
  haptics::TickCommands commands = newest ? *newest : haptics::TickCommands{};
  commands.emergency_stop = bus.stop.noForce();
  return commands;
}

}  // namespace

std::int64_t HapticActivity::step(std::int64_t now_ns) {
  const haptics::DeviceReading reading = device_.read(now_ns);
  const LocalGeometry* latest = geometryFor(reading, now_ns);
  const haptics::SensedForce sensed =
      sensing_ ? sensing_->sense(reading, now_ns) : haptics::SensedForce{};
  if (state_.tick % kKeyframeTicks == 0)
    bus_.keyframes_to_recorder.push(Keyframe{state_.tick, state_});
  const haptics::TickCommands told = commandsFor(bus_, now_ns);
  const haptics::Floor* floor = floors_ && told.floor ? floors_->floor(told.floor) : nullptr;
  haptics::FlightRecord record =
      haptics::tick(config_, state_, reading, latest, told, now_ns, sensed, floor);
  device_.command(now_ns, record.f_command_D);
  record.late_ns = due_ns_ < 0 ? 0 : now_ns - due_ns_;
  publish(record, now_ns);
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

void HapticActivity::publish(const haptics::FlightRecord& record, std::int64_t now_ns) {
  bus_.haptic_to_recorder.push(record);
  bus_.haptic_to_task.push(record);
  const ToolState tool = toolStateOf(config_, state_, record, now_ns);
  if (!exact_) bus_.haptic_to_geometry.publish(tool, now_ns);
  bus_.haptic_to_scene.publish(tool, now_ns);
  bus_.haptic_to_link.publish(tool, now_ns);
}

std::int64_t HapticPairActivity::step(std::int64_t now_ns) {
  std::array<haptics::DeviceReading, 2> readings;
  std::array<haptics::SensedForce, 2> sensed;
  for (std::size_t t = 0; t < 2; ++t) {
    readings[t] = tools_[t].device.read(now_ns);
    if (tools_[t].sensing) sensed[t] = tools_[t].sensing->sense(readings[t], now_ns);
  }
  std::array<haptics::FlightRecord, 2> records =
      haptics::tickPair(config_, state_, readings, commandsFor(bus_, now_ns), now_ns, sensed);
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
