#include "haptics/tick.h"

#include <algorithm>

#include "haptics/tick_augmentation.h"

namespace palpa::haptics {
namespace {

/// One of the two descriptions of the contact: on the newest snapshot, or on the one before it.
struct View {
  const LocalGeometry& geometry;
  NeedleState& needle;
  ProbeState& probe;
};

NeedleContact contactOn(const TickConfig& config, const View& view, const NeedlePose& pose,
                        const TickCommands& commands, double dt) {
  if (config.engine == Engine::probe)
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

/// What is added to a real thing.
NeedleContact touchedContact(const TickConfig& config, TickState& state, const FlightRecord& record,
                             double dt) {
  const AugmentedTouch now = augmentTouch(config.touch, record.commands.lumps,
                                          {touchIn(config, record.sensed), {}}, dt, &state.touch);
  return addedIn(config, now.f_d[0], now.touch[0].x, now.touch[0].f_n);
}

NeedleContact contactNow(const TickConfig& config, TickState& state, const TickCommands& commands,
                         std::int64_t now_ns, TickFrame& frame) {
  if (config.engine == Engine::touch)
    return touchedContact(config, state, frame.record, frame.input.dt);
  return blendedContact(config, state, frame.pose, commands, frame.input.dt, now_ns);
}

}  // namespace

FlightRecord tick(const TickConfig& config, TickState& state, const DeviceReading& reading,
                  const LocalGeometry* latest, const TickCommands& commands, std::int64_t now_ns,
                  const SensedForce& sensed, const Floor* floor) noexcept {
  TickFrame frame = beginTick(config, state, reading, latest, commands, now_ns, sensed);
  NeedleContact contact;
  if (frame.felt) {
    FloorTouch touch;
    const bool on_floor = config.engine == Engine::floor;
    contact = on_floor ? floorContact(config, state, floor, &frame, &touch)
                       : contactNow(config, state, commands, now_ns, frame);
    addAugmentations(config, state, contact, floor, on_floor ? &touch : nullptr, &frame);
  }
  return finishTick(config, state, contact, frame);
}

}  // namespace palpa::haptics
