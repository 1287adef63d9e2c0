#include "haptics/loop/tick_frame.h"

#include <algorithm>
#include <cmath>

#include "haptics/safety/plausibility.h"

namespace palpa::haptics {
namespace {

constexpr double kStrongestObject = 1000;  // N

/// A device that does not turn holds the needle as its tool says; once inserted the needle points
/// from the entry to the tip, taking over between 3 and 6 mm.
Vec3 alongEntry(const NeedleState& needle, const Vec3& p_DT, const Vec3& held_D) {
  constexpr double kFrom = 0.003, kTo = 0.006;
  const Vec3 way = p_DT - unpack(needle.entry_D);
  const double length = way.norm();
  if (needle.phase != NeedlePhase::inserted || length <= kFrom) return held_D;
  const double share = std::min((length - kFrom) / (kTo - kFrom), 1.0);
  const Vec3 axis = (1 - share) * held_D + share * way / length;
  return axis.norm() > 0.1 ? axis.normalized() : held_D;
}

NeedlePose needlePose(const TickConfig& config, const NeedleState& needle,
                      const DeviceReading& reading) {
  const Quat q_DE = unpack(reading.q_DE).normalized();
  const Vec3 p_DE = unpack(reading.p_DE);
  const Quat q_ET = unpack(config.X_ET.q);
  NeedlePose pose{p_DE + q_DE * unpack(config.X_ET.p), q_DE * (q_ET * Vec3::UnitZ()), p_DE};
  if (!config.device_turns) pose.a_D = alongEntry(needle, pose.p_DT, pose.a_D);
  return pose;
}

void startTrial(TickState& state, std::uint32_t trial) {
  state.trial = trial;
  state.contact = state.contact_old = NeedleState{};
  state.probe = state.probe_old = ProbeState{};
  state.touch = TouchAugmentationState{};
  state.pulse = PulseState{};
  state.floor = FloorState{};
  state.tip = PointMotion{};
  state.augmentation = AugmentationState{};
  state.passivity = PassivityState{};
  state.blending = 0;
}

/// A snapshot that arrives during a blend waits until it is over, so that the force never jumps. A
/// damaged one is refused: the one before it stays, grows stale and fades. Returns the TickEvent.
std::uint32_t adopt(const TickConfig& config, TickState& state, const LocalGeometry* latest,
                    std::int64_t now_ns) {
  state.t_adopted_ns = std::min(state.t_adopted_ns, now_ns);  // where the clock went back
  if (state.blending && between(state.t_adopted_ns, now_ns) >= static_cast<double>(config.blend_ns))
    state.blending = 0;
  if (!latest || latest->number == 0 || state.blending) return 0;
  if (latest->number == state.now.number || latest->number == state.refused) return 0;
  if (!plausible(*latest)) {
    state.refused = latest->number;
    return kSnapshotRefused;
  }
  state.refused = 0;
  state.blending = state.now.number != 0 && config.blend_ns > 0;
  state.old = state.now;
  state.contact_old = state.contact;
  state.probe_old = state.probe;
  state.now = *latest;
  state.t_adopted_ns = now_ns;
  return kSnapshotAdopted;
}

/// After readings that were not believed the velocity is measured anew.
void forgetMotion(TickState& state) {
  for (PointMotion* motion : {&state.contact.motion, &state.contact_old.motion, &state.probe.motion,
                              &state.probe_old.motion, &state.floor.motion, &state.tip})
    motion->started = 0;
  state.touch = TouchAugmentationState{};
  state.pulse = PulseState{};
  state.augmentation = AugmentationState{};
  state.passivity = PassivityState{};
}

/// 1 while the snapshot is young, then falling to 0 within the fade. One from the future is as bad
/// as an old one: the clock went back, or its time is wrong.
double freshness(const TickConfig& config, const TickState& state, std::int64_t now_ns) {
  if (config.contact_mode == ContactMode::sensed_object ||
      config.contact_mode == ContactMode::floor)
    return 1;  // a real thing, a floor are always where they are
  if (state.now.number == 0) return 0;
  const double over =
      std::abs(between(state.now.t_ns, now_ns)) - static_cast<double>(config.age_limit_ns);
  return std::clamp(1.0 - over / static_cast<double>(config.fade_ns), 0.0, 1.0);
}

/// What is wrong with this tick before any force is computed.
SafetyCause faultOf(const TickConfig& config, TickState& state, const DeviceReading& reading,
                    const NeedlePose& pose, double elapsed_ns) {
  if (!possible(reading)) return SafetyCause::not_finite;
  // Where it will be once homed is no jump from where it seemed to be, but has to be steady as
  // after one.
  if (!reading.homed) {
    state.reading = ReadingState{};
    state.homing_ns = static_cast<double>(config.safety.jump_hold_ns);
    return SafetyCause::none;
  }
  state.homing_ns = std::max(state.homing_ns - std::max(elapsed_ns, 0.0), 0.0);
  const bool still =
      steady(config.safety, config.period_ns, pose, reading.sequence, elapsed_ns, state.reading);
  if (!still) return SafetyCause::jump;
  if (state.homing_ns > 0) return SafetyCause::not_ready;
  if (elapsed_ns <= 0) return SafetyCause::clock;
  return elapsed_ns > static_cast<double>(config.safety.watchdog_ns) ? SafetyCause::watchdog
                                                                     : SafetyCause::none;
}

bool sensorBelieved(const SensedForce& sensed) {
  const Vec3 f = unpack(sensed.f_D);
  return hasForce(sensed.state) && f.allFinite() && f.norm() <= kStrongestObject &&
         unpack(sensed.p_DK).allFinite();
}

bool believable(SafetyCause fault) {
  return fault != SafetyCause::not_finite && fault != SafetyCause::jump &&
         fault != SafetyCause::not_ready && fault != SafetyCause::no_sensor;
}

/// A device that is not homed does not know where it is: nothing is touched, and what was touched
/// is over.
void forgetContact(TickState& state) {
  const std::uint8_t punctures = state.contact.skin_punctures;
  state.contact = state.contact_old = NeedleState{};
  state.contact.skin_punctures = state.contact_old.skin_punctures = punctures;
  state.probe = state.probe_old = ProbeState{};
  state.touch = TouchAugmentationState{};
  state.pulse = PulseState{};
  state.floor = FloorState{};
  state.tip = PointMotion{};
  state.augmentation = AugmentationState{};
  state.passivity = PassivityState{};
}

/// Of a real object on the tool; none where the sensor's word does not count or cannot be meant.
Vec3 objectForce(const TickConfig& config, const SensedForce& sensed) {
  return config.object_at_port && sensorBelieved(sensed) ? unpack(sensed.f_D) : Vec3(Vec3::Zero());
}

/// The force that is asked of the limiter. Where nothing will be rendered the observer starts anew.
Vec3 passiveForce(const TickConfig& config, TickState& state, TickFrame& frame,
                  const Vec3& f_felt_D) {
  const TickCommands& commands = frame.record.commands;
  const SafetyInput& in = frame.input;
  const double fresh = frame.fresh;
  const Vec3 f_D = fresh * f_felt_D;
  frame.forces.rendered = commands.force_feedback ? fresh : 0;
  if (!commands.force_feedback || !commands.armed || fresh == 0) {
    state.passivity = PassivityState{};
    return commands.force_feedback ? f_D : Vec3::Zero();
  }
  PassivityInput port;
  port.p_DE = in.p_DE;
  port.f_D = f_D;
  port.f_object_D = objectForce(config, frame.record.sensed);
  port.f_source_D = fresh * frame.f_source_D;
  port.fresh = in.sequence != state.passivity.sequence;
  port.dt = in.dt;
  Vec3 f_passive_D = keepPassive(config.passivity, state.passivity, port);
  state.passivity.sequence = in.sequence;
  frame.forces.damping = f_passive_D - f_D;
  return f_passive_D;
}

/// The part of the commanded force that the port owes nothing for: what carries the handle, and
/// cues that heed no motion. None where the limiter let none out.
Vec3 besidesThePort(const FlightRecord& record, const TickFrame& frame) {
  if (unpack(record.f_command_D).squaredNorm() == 0) return Vec3::Zero();
  return frame.f_hold_D + frame.fresh * frame.f_source_D;
}

void describe(const TickConfig& config, FlightRecord& record, const NeedleContact& contact,
              const TickState& state) {
  record.snapshot = record.events & kSnapshotRefused ? state.refused : state.now.number;
  record.f_contact_D = pack(contact.f_D);
  record.tau_missing_D = pack(contact.tau_D);
  record.indentation = contact.indentation;
  record.depth = contact.depth;
  record.v_axial = contact.v_axial;
  record.skin_force = contact.skin_force;
  record.bone_force = contact.bone_force;
  record.wall_force = contact.wall_force;
  record.events |= contact.events;
  record.phase = state.contact.phase;
  record.tissue = contact.tissue;
  record.wall = contact.wall;
  record.wall_leaving = contact.wall_leaving;
  record.bone = config.contact_mode == ContactMode::probe ? state.probe.bone : state.contact.bone;
  record.skin_punctures = state.contact.skin_punctures;
  record.damped = state.passivity.injecting;
}

SafetyInput safetyInput(const DeviceReading& reading, const TickCommands& commands,
                        SafetyCause fault, std::int64_t now_ns, double dt) {
  SafetyInput input;
  input.now_ns = now_ns;
  input.dt = dt;
  input.p_DE = unpack(reading.p_DE);
  input.sequence = reading.sequence;
  input.buttons = reading.buttons;
  input.fault = fault;
  input.armed = commands.armed;
  input.homed = reading.homed;
  input.emergency_stop = commands.emergency_stop;
  return input;
}

/// Whether force goes out, if perhaps less than was asked for.
bool rendered(SafetyCause cause) {
  return cause == SafetyCause::none || cause == SafetyCause::clamp || cause == SafetyCause::slew ||
         cause == SafetyCause::duty;
}

bool isTrip(SafetyCause cause) {
  return !rendered(cause) && cause != SafetyCause::not_ready && cause != SafetyCause::deadman;
}

/// The limiter's cause, or that the geometry has faded; and the events when it changes.
void reportCause(FlightRecord& record, TickState& state, double fresh) {
  SafetyCause cause = state.safety.cause;
  if (rendered(cause) && fresh < 1)
    cause = state.refused ? SafetyCause::corrupt_geometry : SafetyCause::stale_geometry;
  record.safety = cause;
  if (isTrip(cause) && cause != state.cause) record.events |= kSafetyTripped;
  state.tripped |= isTrip(cause);
  if (state.tripped && rendered(cause)) {
    record.events |= kSafetyCleared;
    state.tripped = 0;
  }
  state.cause = cause;
}

}  // namespace

PackedPose toolPose(const TickConfig& config, const TickState& state,
                    const DeviceReading& reading) noexcept {
  const NeedlePose pose = needlePose(config, state.contact, reading);
  const Quat q_DT = (unpack(reading.q_DE).normalized() * unpack(config.X_ET.q)).normalized();
  const Quat turn = turnBetween(q_DT * Vec3::UnitZ(), pose.a_D);  // none where the device turns
  return {pack(pose.p_DT), pack(config.device_turns ? q_DT : Quat(turn * q_DT))};
}

TickFrame beginTick(const TickConfig& config, TickState& state, const DeviceReading& reading,
                    const LocalGeometry* latest, const TickCommands& commands, std::int64_t now_ns,
                    const SensedForce& sensed) noexcept {
  const double period = static_cast<double>(config.period_ns);
  const double elapsed = state.tick == 0 ? period : between(state.t_ns, now_ns);
  TickFrame frame;
  FlightRecord& record = frame.record;
  record.tick = state.tick++;
  record.t_ns = state.t_ns = now_ns;
  record.reading = reading;
  record.commands = commands;
  record.sensed = sensed;
  if (commands.trial != state.trial) startTrial(state, commands.trial);
  record.events |= adopt(config, state, latest, now_ns);
  frame.pose = needlePose(config, state.contact, reading);
  SafetyCause fault = faultOf(config, state, reading, frame.pose, elapsed);
  if (fault == SafetyCause::none && config.contact_mode == ContactMode::sensed_object &&
      reading.homed && !sensorBelieved(sensed))
    fault = commands.armed ? SafetyCause::no_sensor : SafetyCause::not_ready;
  frame.input =
      safetyInput(reading, commands, fault, now_ns, std::clamp(elapsed * 1e-9, 0.0, kLongestStep));
  frame.fresh = freshness(config, state, now_ns);
  frame.felt = reading.homed && believable(fault);
  if (!reading.homed)
    forgetContact(state);
  else if (!frame.felt)
    forgetMotion(state);
  return frame;
}

ToolTouch touchIn(const TickConfig& config, const SensedForce& sensed) noexcept {
  const Quat q_PD = unpack(config.X_DP.q).normalized().conjugate();
  return {true, q_PD * (unpack(sensed.p_DK) - unpack(config.X_DP.p)), q_PD * unpack(sensed.f_D)};
}

NeedleContact addedIn(const TickConfig& config, const Vec3& f_d_P, double x, double f_n) noexcept {
  NeedleContact contact;
  contact.f_D = unpack(config.X_DP.q).normalized() * f_d_P;
  contact.indentation = x;
  contact.skin_force = f_n;
  return contact;
}

const FlightRecord& finishTick(const TickConfig& config, TickState& state,
                               const NeedleContact& contact, TickFrame& frame) noexcept {
  FlightRecord& record = frame.record;
  if (frame.felt)
    frame.input.f_wanted_D =
        passiveForce(config, state, frame, contact.f_D + unpack(record.f_augmentation_D)) +
        frame.f_hold_D;
  record.f_wanted_D = pack(frame.input.f_wanted_D);
  describe(config, record, contact, state);
  record.f_command_D = pack(limitForce(config.safety, state.safety, frame.input));
  state.passivity.f_last_D =  // what the hand really gets of it
      pack(Vec3(unpack(record.f_command_D) - besidesThePort(record, frame) +
                objectForce(config, record.sensed)));
  reportCause(record, state, frame.fresh);
  return record;
}

}  // namespace palpa::haptics
