#pragma once

#include "haptics/loop/tick.h"
#include "haptics/loop/tick_forces.h"

/// What every tick has before and after its contact, whoever computes that: for this folder only.
namespace palpa::haptics {

/// s: a late tick is not integrated over more than this
inline constexpr double kLongestStep = 0.005;

/// A tick on its way.
struct TickFrame {
  FlightRecord record;
  NeedlePose pose;
  SafetyInput input;
  double fresh = 0;              ///< share of the force that may go out, by the age of the geometry
  bool felt = false;             ///< the readings are believed: there is a contact to compute
  Vec3 f_hold_D = Vec3::Zero();  ///< N: what holds the handle up or in its place; no contact
  Vec3 f_pulse_D = Vec3::Zero();   ///< N, of an artery under the tool
  Vec3 f_source_D = Vec3::Zero();  ///< N, of pulse, texture and cues that heed no motion
  TickForces forces;               ///< of what the force is made
};

/// From one time to another, ns. In floating point: a clock that leaps must not overflow.
inline double between(std::int64_t from_ns, std::int64_t to_ns) noexcept {
  return static_cast<double>(to_ns) - static_cast<double>(from_ns);
}

/// Time, trial, snapshot, and whether the readings can be believed. Where they cannot, what was
/// touched is forgotten.
TickFrame beginTick(const TickConfig& config, TickState& state, const DeviceReading& reading,
                    const LocalGeometry* latest, const TickCommands& commands, std::int64_t now_ns,
                    const SensedForce& sensed) noexcept;

/// A sensed object under the tool, in P where its lumps lie. Position and force are of one time, a
/// filter's delay ago.
ToolTouch touchIn(const TickConfig& config, const SensedForce& sensed) noexcept;
/// What is added to it, from P back to D: force, N; depth, m, and force of the real object, N, as
/// they were felt.
NeedleContact addedIn(const TickConfig& config, const Vec3& f_d_P, double x, double f_n) noexcept;

/// Passivity, safety, and the record. `contact`: as computed where it was felt; else as made.
const FlightRecord& finishTick(const TickConfig& config, TickState& state,
                               const NeedleContact& contact, TickFrame& frame) noexcept;

}  // namespace palpa::haptics

/// The floor that is searched, and what augmentations add to any contact: for this folder only.
namespace palpa::haptics {

/// The floor's contact; before an episode the handle is held over its middle instead, and always
/// its weight is carried (`frame->f_hold_D`).
NeedleContact floorContact(const TickConfig& config, TickState& state, const Floor* floor,
                           TickFrame* frame, FloorTouch* touch) noexcept;

/// Signals, parts and augmentations of this tick into the record, with the frame's pulse. `touch`:
/// of a floor, else null.
void addAugmentations(const TickConfig& config, TickState& state, const NeedleContact& contact,
                      const Floor* floor, const FloorTouch* touch, TickFrame* frame) noexcept;

}  // namespace palpa::haptics
