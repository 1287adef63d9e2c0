#include "haptics/tick.h"

#include <algorithm>

namespace palpa::haptics {
namespace {

constexpr double kLongestStep = 0.005;  // s: a late tick is not integrated over more than this

bool finite(const DeviceReading& reading) {
  const Quat q = unpack(reading.q_DE);
  return unpack(reading.p_DE).allFinite() && q.coeffs().allFinite() && q.norm() > 0.5;
}

NeedlePose needlePose(const TickConfig& config, const DeviceReading& reading) {
  const Quat q_DE = unpack(reading.q_DE).normalized();
  const Vec3 p_DE = unpack(reading.p_DE);
  const Quat q_ET = unpack(config.X_ET.q);
  return {p_DE + q_DE * unpack(config.X_ET.p), q_DE * (q_ET * Vec3::UnitZ()), p_DE};
}

void startTrial(TickState& state, std::uint32_t trial) {
  state.trial = trial;
  state.contact = state.contact_old = NeedleState{};
  state.probe = state.probe_old = ProbeState{};
  state.passivity = PassivityState{};
  state.blending = 0;
}

/// A snapshot that arrives during a blend waits until it is over, so that the force never jumps.
bool adopt(const TickConfig& config, TickState& state, const LocalGeometry* latest,
           std::int64_t now_ns) {
  if (state.blending && now_ns - state.t_adopted_ns >= config.blend_ns) state.blending = 0;
  if (!latest || latest->number == state.now.number || state.blending) return false;
  state.blending = state.now.number != 0;
  state.old = state.now;
  state.contact_old = state.contact;
  state.probe_old = state.probe;
  state.now = *latest;
  state.t_adopted_ns = now_ns;
  return true;
}

/// One of the two descriptions of the contact: on the newest snapshot, or on the one before it.
struct View {
  const LocalGeometry& geometry;
  NeedleState& needle;
  ProbeState& probe;
};

NeedleContact contactOn(const TickConfig& config, const View& view, const NeedlePose& pose,
                        double puncture_force_N, double dt) {
  if (config.engine == Engine::probe)
    return probeContact(config.probe, config.coupling, view.geometry, pose.p_DT, dt, view.probe);
  return needleContact(config.materials, config.coupling, view.geometry, pose, puncture_force_N, dt,
                       view.needle);
}

/// Force on the newest snapshot, faded in from the one before it. The old one only lends its force:
/// what happened (punctures, contacts) is told by the new one.
NeedleContact blendedContact(const TickConfig& config, TickState& state, const NeedlePose& pose,
                             double puncture_force_N, double dt, std::int64_t now_ns) {
  NeedleContact contact =
      contactOn(config, {state.now, state.contact, state.probe}, pose, puncture_force_N, dt);
  if (!state.blending) return contact;
  const NeedleContact old =
      contactOn(config, {state.old, state.contact_old, state.probe_old}, pose, puncture_force_N, dt);
  if (state.contact_old.phase != state.contact.phase) {
    state.blending = 0;  // a puncture in one of them: the two no longer describe the same contact
    return contact;
  }
  const double u = std::clamp(
      static_cast<double>(now_ns - state.t_adopted_ns) / static_cast<double>(config.blend_ns), 0.0,
      1.0);
  contact.f_D = (1 - u) * old.f_D + u * contact.f_D;
  contact.tau_D = (1 - u) * old.tau_D + u * contact.tau_D;
  return contact;
}

/// 1 while the snapshot is young, then falling to 0 within the fade.
double freshness(const TickConfig& config, const TickState& state, std::int64_t now_ns) {
  if (state.now.number == 0) return 0;
  const std::int64_t over = now_ns - state.now.t_ns - config.age_limit_ns;
  return std::clamp(1.0 - static_cast<double>(over) / static_cast<double>(config.fade_ns), 0.0, 1.0);
}

/// The force that is asked of the limiter. Where nothing will be rendered the observer starts anew.
Vec3 passiveForce(const TickConfig& config, TickState& state, const TickCommands& commands,
                  const Vec3& f_D, const SafetyInput& in) {
  if (!commands.force_feedback || !commands.armed) {
    state.passivity = PassivityState{};
    return commands.force_feedback ? f_D : Vec3::Zero();
  }
  PassivityInput port;
  port.p_DE = in.p_DE;
  port.f_D = f_D;
  port.dt = in.dt;
  return keepPassive(config.passivity, state.passivity, port);
}

bool isTrip(SafetyCause cause) {
  return cause != SafetyCause::none && cause != SafetyCause::clamp && cause != SafetyCause::slew &&
         cause != SafetyCause::not_ready;
}

void describe(const TickConfig& config, FlightRecord& record, const NeedleContact& contact,
              const TickState& state) {
  record.snapshot = state.now.number;
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
  record.bone = config.engine == Engine::probe ? state.probe.bone : state.contact.bone;
  record.skin_punctures = state.contact.skin_punctures;
  record.damped = state.passivity.injecting;
}

}  // namespace

FlightRecord tick(const TickConfig& config, TickState& state, const DeviceReading& reading,
                  const LocalGeometry* latest, const TickCommands& commands,
                  std::int64_t now_ns) noexcept {
  const double elapsed = static_cast<double>(now_ns - state.t_ns) * 1e-9;
  const double dt = state.tick == 0 ? static_cast<double>(config.period_ns) * 1e-9
                                    : std::clamp(elapsed, 0.0, kLongestStep);
  FlightRecord record;
  record.tick = state.tick++;
  record.t_ns = state.t_ns = now_ns;
  record.reading = reading;
  record.commands = commands;
  if (commands.trial != state.trial) startTrial(state, commands.trial);
  if (adopt(config, state, latest, now_ns)) record.events |= kSnapshotAdopted;

  NeedleContact contact;
  const bool sound = finite(reading);
  if (sound)
    contact = blendedContact(config, state, needlePose(config, reading), commands.puncture_force_N,
                             dt, now_ns);

  const double fresh = freshness(config, state, now_ns);
  SafetyInput input;
  input.now_ns = now_ns;
  input.dt = dt;
  input.p_DE = unpack(reading.p_DE);
  input.f_wanted_D = passiveForce(config, state, commands, fresh * contact.f_D, input);
  input.sequence = reading.sequence;
  input.armed = commands.armed && reading.homed;
  input.emergency_stop = commands.emergency_stop;
  record.f_wanted_D = pack(input.f_wanted_D);
  describe(config, record, contact, state);
  record.f_command_D = pack(limitForce(config.safety, state.safety, input));
  if (!sound) record.f_command_D = state.safety.f_last_D = {0, 0, 0};
  state.passivity.f_last_D = record.f_command_D;  // what the hand really gets

  SafetyCause cause = sound ? state.safety.cause : SafetyCause::not_finite;
  if (!isTrip(cause) && cause != SafetyCause::not_ready && fresh < 1)
    cause = SafetyCause::stale_geometry;
  record.safety = cause;
  if (isTrip(cause) && !isTrip(state.cause)) record.events |= kSafetyTripped;
  if (!isTrip(cause) && isTrip(state.cause)) record.events |= kSafetyCleared;
  state.cause = cause;
  return record;
}

}  // namespace palpa::haptics
