#include "haptics/loop/tick.h"

#include <algorithm>

#include "haptics/loop/tick_frame.h"
#include "haptics/safety/plausibility.h"

namespace palpa::haptics {
namespace {

/// What one tool's force is made of, from P to D.
void describeTouch(const TickConfig& config, const AugmentedTouch& now, std::size_t t,
                   TickForces* forces) noexcept {
  const Quat q_DP = unpack(config.X_DP.q).normalized();
  const Modulated& touch = now.touch[t];
  if (!now.taking) {
    forces->stiffness = q_DP * Vec3(touch.f_d - touch.f_rub);
    forces->friction = q_DP * touch.f_rub;
  }
  forces->taken = q_DP * now.f_taken[t];
  forces->texture = q_DP * now.f_source[t];
  forces->lumps = q_DP * now.f_lumps[t];
  forces->slid = q_DP * touch.slid;
  if (touch.contact) forces->normal = q_DP * touch.u_n;
}

/// One of the two descriptions of the contact: on the newest snapshot, or on the one before it.
struct ContactView {
  const LocalGeometry& geometry;
  NeedleState& needle;
  ProbeState& probe;
};

NeedleContact contactOn(const TickConfig& config, const ContactView& view, const NeedlePose& pose,
                        const TickCommands& commands, double dt) {
  if (config.contact_mode == ContactMode::probe)
    return probeContact(config.probe, config.coupling, view.geometry, pose.p_DT, dt, view.probe);
  return needleContact(config.materials, config.coupling, view.geometry, pose, commands, dt,
                       view.needle);
}

/// Force on the newest snapshot, faded in from the one before it. The old one only lends its force:
/// what happened (punctures, contacts) is told by the new one.
NeedleContact blendedContact(const TickConfig& config, TickState& state, const NeedlePose& pose,
                             const TickCommands& commands, double dt, std::int64_t now_ns) {
  NeedleContact contact =
      contactOn(config, {state.now, state.contact, state.probe}, pose, commands, dt);
  if (!state.blending) return contact;
  const NeedleContact old =
      contactOn(config, {state.old, state.contact_old, state.probe_old}, pose, commands, dt);
  if (state.contact_old.phase != state.contact.phase) {
    state.blending = 0;  // a puncture in one of them: the two no longer describe the same contact
    return contact;
  }
  const double u = std::clamp(
      between(state.t_adopted_ns, now_ns) / static_cast<double>(config.blend_ns), 0.0, 1.0);
  contact.f_D = (1 - u) * old.f_D + u * contact.f_D;
  contact.tau_D = (1 - u) * old.tau_D + u * contact.tau_D;
  return contact;
}

/// What is added to a real thing; the pulse apart, a source.
NeedleContact touchedContact(const TickConfig& config, TickState& state, TickFrame& frame) {
  const TickCommands& commands = frame.record.commands;
  const double dt = frame.input.dt;
  ToolTouch tool = touchIn(config, frame.record.sensed);
  tool.friction = static_cast<double>(commands.friction);
  const AugmentedTouch now =
      augmentTouch(config.touch, commands.lumps, {tool, {}}, dt, &state.touch);
  const Modulated& felt = now.touch[0];
  const PulseTouch touch{felt.contact, Vec3(tool.p_M - config.touch.tip_radius * felt.u_n),
                         felt.u_n, felt.f_n};
  frame.f_pulse_D =
      unpack(config.X_DP.q).normalized() *
      feelPulse(config.pulse, commands.artery, touch, frame.record.t_ns, dt, &state.pulse);
  frame.f_source_D += unpack(config.X_DP.q).normalized() * now.f_source[0];
  describeTouch(config, now, 0, &frame.forces);
  return addedIn(config, now.f_d[0], now.touch[0].x, now.touch[0].f_n);
}

NeedleContact contactNow(const TickConfig& config, TickState& state, const TickCommands& commands,
                         std::int64_t now_ns, TickFrame& frame) {
  if (config.contact_mode == ContactMode::sensed_object)
    return touchedContact(config, state, frame);
  return blendedContact(config, state, frame.pose, commands, frame.input.dt, now_ns);
}

}  // namespace

FlightRecord tick(const TickConfig& config, TickState& state, const DeviceReading& reading,
                  const LocalGeometry* latest, const TickCommands& commands, std::int64_t now_ns,
                  const SensedForce& sensed, const Floor* floor, TickForces* forces) noexcept {
  TickFrame frame = beginTick(config, state, reading, latest, commands, now_ns, sensed);
  NeedleContact contact;
  if (frame.felt) {
    FloorTouch touch;
    const bool on_floor = config.contact_mode == ContactMode::floor;
    contact = on_floor ? floorContact(config, state, floor, &frame, &touch)
                       : contactNow(config, state, commands, now_ns, frame);
    addAugmentations(config, state, contact, floor, on_floor ? &touch : nullptr, &frame);
    if (config.contact_mode != ContactMode::sensed_object) frame.forces.body = contact.f_D;
  }
  const FlightRecord& record = finishTick(config, state, contact, frame);
  if (forces) *forces = frame.forces;
  return record;
}

namespace {

/// What is added under each tool, in P.
struct AddedForces {
  std::array<Vec3, 2> f_d{Vec3::Zero(), Vec3::Zero()};
  std::array<double, 2> x{}, f_n{};
  /// of f_d, what asks for no motion
  std::array<Vec3, 2> f_source{Vec3::Zero(), Vec3::Zero()};
};

AddedForces pressed(const PairConfig& config, PairState& state,
                    const std::array<ToolTouch, 2>& tools,
                    std::array<TickFrame, 2>* frames) noexcept {
  const TickFrame& first = frames->front();
  const AugmentedTouch now = augmentTouch(config.tools[0].touch, first.record.commands.lumps, tools,
                                          first.input.dt, &state.touch);
  for (std::size_t t = 0; t < 2; ++t) describeTouch(config.tools[t], now, t, &(*frames)[t].forces);
  return {now.f_d,
          {now.touch[0].x, now.touch[1].x},
          {now.touch[0].f_n, now.touch[1].f_n},
          now.f_source};
}

/// Where one of the tools is not believed it feels nothing: no contact.
AddedForces squeezed(const PairConfig& config, PairState& state,
                     const std::array<ToolTouch, 2>& tools,
                     std::array<TickFrame, 2>* frames) noexcept {
  const TickCommands& commands = frames->front().record.commands;
  SqueezeModulation law = config.squeeze;
  law.target.factor *= static_cast<double>(commands.squeeze_stiffness);
  law.weight_factor *= static_cast<double>(commands.squeeze_weight);
  const Squeezed now = modulateSqueeze(law, {tools[0].f_r, tools[1].f_r},
                                       {tools[0].p_M, tools[1].p_M}, &state.squeeze);
  AddedForces added;
  added.f_d = now.f_d;
  added.x = {now.x, now.x};
  added.f_n = {now.F, now.F};
  for (std::size_t t = 0; t < 2; ++t) {
    TickForces& forces = (*frames)[t].forces;
    const Quat q_DP = unpack(config.tools[t].X_DP.q).normalized();
    const Vec3 weight = (law.weight_factor - 1) * now.f_w[t];
    forces.weight = q_DP * weight;
    forces.stiffness = q_DP * Vec3(now.f_d[t] - weight);
    if (now.contact) forces.normal = q_DP * Vec3(t == 0 ? now.l : Vec3(-now.l));
  }
  return added;
}

}  // namespace

namespace {

/// Of the second tool, by the first one's, which must be believed.
SensedForce estimatedForce(const PairConfig& config, PairState& state, const DeviceReading& reading,
                           const TickFrame& first, const ToolTouch& touch) noexcept {
  const TickConfig& tool = config.tools[1];
  SensedForce sensed;
  sensed.state = SensorState::unusable;
  if (!first.felt || !reading.homed || !possible(reading)) {
    state.estimate = {};
    return sensed;
  }
  const Pose X_DP = unpack(tool.X_DP),
             X_DE = makePose(unpack(reading.q_DE).normalized().toRotationMatrix(),
                             unpack(reading.p_DE));
  const Vec3 p_DM = X_DE * (unpack(tool.X_ET) * Vec3(0, 0, -tool.touch.tip_radius));
  const Vec3 p_PM = X_DP.inverse() * p_DM;
  const TouchAugmentation& law = config.tools[0].touch;
  const EstimatedReaction told = estimateReaction(
      {lawAt(law.surface.contact, law.map, touch.p_M), lawAt(law.surface.contact, law.map, p_PM)},
      {config.opposed != 0, static_cast<double>(config.thickness)}, tool.touch.tip_radius, touch,
      p_PM, first.input.dt, &state.estimate);
  sensed.state = SensorState::estimated;
  sensed.f_D = pack(Vec3(X_DP.linear() * told.f_r));
  sensed.p_DK = pack(Vec3(X_DP * told.p_M));
  return sensed;
}

}  // namespace

std::array<FlightRecord, 2> tickPair(const PairConfig& config, PairState& state,
                                     const std::array<DeviceReading, 2>& readings,
                                     const TickCommands& commands, std::int64_t now_ns,
                                     const std::array<SensedForce, 2>& sensed,
                                     std::array<TickForces, 2>* forces) noexcept {
  if (commands.trial != state.trial) {
    state.trial = commands.trial;
    state.touch = {};
    state.squeeze = {};
    state.estimate = {};
  }
  std::array<TickFrame, 2> frames;
  std::array<ToolTouch, 2> tools;
  for (std::size_t t = 0; t < 2; ++t) {
    const bool estimated = t == 1 && config.estimated;
    const SensedForce felt =
        estimated ? estimatedForce(config, state, readings[1], frames[0], tools[0]) : sensed[t];
    TickCommands told = commands;
    if (estimated) told.force_feedback = 0;  // it has no drives
    frames[t] =
        beginTick(config.tools[t], state.tools[t], readings[t], nullptr, told, now_ns, felt);
    if (frames[t].felt) tools[t] = touchIn(config.tools[t], felt);
    tools[t].friction = static_cast<double>(commands.friction);
  }
  const AddedForces added = config.squeezing ? squeezed(config, state, tools, &frames)
                                             : pressed(config, state, tools, &frames);
  std::array<FlightRecord, 2> records;
  for (std::size_t t = 0; t < 2; ++t) {
    frames[t].f_source_D += unpack(config.tools[t].X_DP.q).normalized() * added.f_source[t];
    records[t] =
        finishTick(config.tools[t], state.tools[t],
                   addedIn(config.tools[t], added.f_d[t], added.x[t], added.f_n[t]), frames[t]);
  }
  if (forces) *forces = {frames[0].forces, frames[1].forces};
  records[1].tool = 1;
  return records;
}

}  // namespace palpa::haptics
