#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <type_traits>

#include "anatomy/geometry/local_geometry.h"
#include "anatomy/geometry/pose.h"
#include "haptics/device.h"

namespace palpa::haptics {

inline constexpr int kMostLumps = 6, kMostLumpKinds = 8;

/// A lump of one of a session's kinds, at a place.
struct PlacedLump {
  Packed3 p_T0{};          ///< m, where it rests
  std::uint32_t kind = 0;  ///< 1 to kMostLumpKinds; else there is none
  /// 0: it is not there, and is felt. Above, to 1: it lies in the real object, and this share of
  /// what it adds is taken off
  float taken = 0;
  std::array<float, 3> n{0, 0, 1};  ///< the object's outward normal over it: its bed lies across
  float reserved = 0;
};
using PlacedLumps = std::array<PlacedLump, kMostLumps>;
static_assert(std::is_trivially_copyable_v<PlacedLumps>);

inline constexpr int kMostVessels = 3, kMostBeats = 4;

/// A beat of an artery: when its wave begins under the finger, session time, and how strong it is,
/// times an ordinary one; 0: there is none.
struct PulseBeat {
  std::int64_t start_ns = 0;
  double strength = 0;
};

/// An artery that is not there, below a real surface: a straight piece of it, and its beats as they
/// are known in this tick, those whose waves go on and those to come.
struct PulsingArtery {
  Packed3 p_P{};             ///< m, the middle of its line, on the surface
  Packed3 a_P{};             ///< unit, along it
  double half_length = 0;    ///< m
  double depth = 0;          ///< m, of its middle line below the surface at rest
  double strength_N = 0;     ///< of an ordinary beat where the artery lies right below a still tool
  double best_N = 0;         ///< pressed so hard it is felt best
  std::uint32_t vessel = 0;  ///< 1 to kMostVessels: whose wave; else there is none
  std::uint32_t reserved = 0;
  std::array<PulseBeat, kMostBeats> beats{};
};
static_assert(std::is_trivially_copyable_v<PulsingArtery>);

inline constexpr int kMostKeptOut = 2;

/// A region that is to be kept out of, by a cue of the task: a ball.
struct KeptOut {
  Packed3 p_D{};      ///< m, its middle
  double radius = 0;  ///< m; 0: there is none
};
static_assert(std::is_trivially_copyable_v<KeptOut>);

/// Where the needle is in the manoeuvre, as the contact model knows it.
enum class NeedlePhase : std::uint8_t { outside, indenting, inserted };

/// Why the safety limiter took the force away, or what it changed.
enum class SafetyCause : std::uint8_t {
  none,
  not_finite,
  clamp,
  slew,
  energy,
  silent_device,
  stale_geometry,
  emergency_stop,
  watchdog,
  not_ready,
  jump,              ///< the position moved faster than a hand can
  clock,             ///< session time stood still or went back
  corrupt_geometry,  ///< stale, because the snapshots that came were refused
  deadman,           ///< the button that must be held is not
  duty,              ///< the drives have had more than they can bear for long: less force
  no_sensor  ///< what is felt rests on a force sensor, and that says nothing that could be believed
};
inline constexpr int kSafetyCauseCount = 16;
const char* name(SafetyCause cause);

/// Whether there is a force sensor, and whether its word counts in this tick; estimated: there is
/// none, the force is told from another tool's and the object's law.
enum class SensorState : std::uint8_t { none, valid, unusable, estimated };
/// Whether there is a force to reckon with, measured or estimated.
inline bool hasForce(SensorState state) {
  return state == SensorState::valid || state == SensorState::estimated;
}

/// What the tick is told from outside; recorded with every tick, so that it can be run again.
struct TickCommands {
  double puncture_force_N = 1.5;    ///< skin gives way here in the current trial
  std::uint32_t trial = 0;          ///< a change resets the contact
  std::uint8_t force_feedback = 1;  ///< 0: forces are computed and recorded but not rendered
  std::uint8_t emergency_stop = 0;
  std::uint8_t armed = 0;    ///< 0: no force (not homed, between trials)
  std::uint8_t subtask = 0;  ///< number of the part of the task that is on, as the task counts them
  /// By Organ: a wall's peak in this trial, in its median peak.
  std::array<float, kOrganCount> wall_scale = [] {
    std::array<float, kOrganCount> one;
    one.fill(1);
    return one;
  }();
  /// Of the surface under a tool: how many times as rough as it is, in this trial. Here, because
  /// the lumps begin at a multiple of 8 bytes: nothing in between is left unsaid.
  float friction = 1;
  PlacedLumps lumps{};  ///< in P, of this trial
  float squeeze_stiffness = 1,
        /// Of what is held between two tools: how many times as hard and as heavy as it is, in this
        /// trial
      squeeze_weight = 1;
  std::uint32_t floor = 0;         ///< number of the floor that is searched; 0: none
  std::uint8_t degraded = 0;       ///< the floor with the lesser gains
  std::uint8_t held = 0;           ///< the handle is held where an episode starts
  std::uint8_t augmented = 0;      ///< 1: the session's augmentations may add force
  std::uint8_t asked = 0;          ///< the trial waits for an answer
  Packed3 line_p_D{}, line_a_D{};  ///< m; unit: a line for virtual fixtures; direction 0: none
  PulsingArtery artery;            ///< of this trial
  std::array<KeptOut, kMostKeptOut> kept_out{};  ///< of this trial
  double support = 0;  ///< 0 to 1: share of the cues that fade as the trainee becomes better
};
static_assert(std::is_trivially_copyable_v<TickCommands>);
static_assert(offsetof(TickCommands, lumps) == offsetof(TickCommands, friction) + sizeof(float));

/// What a force sensor says of a real object that the tool touches, cleared of tool, bias and
/// noise; or what is estimated of it.
struct SensedForce {
  Packed3 f_D{};  ///< of the object on the tool, N
  /// M, where the point that touches was (a round tip's middle), as late as the force is
  Packed3 p_DK{};
  SensorState state = SensorState::none;
  std::uint8_t reserved[7]{};
};
static_assert(std::is_trivially_copyable_v<SensedForce>);

/// Happened in this tick (bits of FlightRecord::events).
enum TickEvent : std::uint32_t {
  kSkinPunctured = 1u << 0,
  kWithdrawn = 1u << 1,
  kWallPunctured = 1u << 2,  ///< organ in `wall`; `wall_leaving` tells the back wall
  kBoneTouched = 1u << 3,    ///< contact begins; organ in `bone`
  kBoneLeft = 1u << 4,
  kSnapshotAdopted = 1u << 5,
  kSafetyTripped = 1u << 6,  ///< cause in `safety`
  kSafetyCleared = 1u << 7,
  kSnapshotRefused = 1u << 8,  ///< damaged; `snapshot` is its number in this tick
};

/// One tick of the haptic loop: everything that is needed to run it again and to score it.
/// Forces act on the tool, expressed in D, newtons.
struct FlightRecord {
  std::int64_t tick = 0;
  std::int64_t t_ns = 0;  ///< session time of the tick
  DeviceReading reading;
  TickCommands commands;
  SensedForce sensed;
  std::int64_t late_ns = 0;  ///< of the tick behind its due time; 0 in virtual time
  /// number of the newest geometry snapshot used, or refused in this tick
  std::uint64_t snapshot = 0;
  Packed3 f_contact_D{};    ///< computed contact force (coupled), independent of `force_feedback`
  Packed3 f_wanted_D{};     ///< after fading and passivity control: what entered the safety limiter
  Packed3 f_command_D{};    ///< what left the safety limiter
  Packed3 tau_missing_D{};  ///< torque about E that a three-axis device cannot give, N m
  double indentation = 0;   ///< of the skin before puncture, m
  /// Of the tip below the skin plane along the needle, m; along its normal while the needle has
  /// never been outside
  double depth = 0;
  double v_axial = 0;        ///< of the tip along the needle, inward positive, m/s
  double skin_force = 0;     ///< normal force on the skin before puncture, N
  double bone_force = 0;     ///< largest bone contact force, N
  double wall_force = 0;     ///< on the wall being deformed, N
  std::uint32_t events = 0;  ///< TickEvent bits
  NeedlePhase phase = NeedlePhase::outside;
  Tissue tissue = Tissue::air;  ///< at the tip; walls not yet punctured keep the tip outside
  Organ wall = Organ::none;     ///< whose wall the tip deforms, or punctured in this tick
  Organ bone = Organ::none;     ///< bone in contact
  std::uint8_t wall_leaving = 0;
  SafetyCause safety = SafetyCause::none;
  std::uint8_t skin_punctures = 0;  ///< in this trial
  std::uint8_t damped = 0;          ///< passivity control added damping
  std::uint8_t tool = 0;            ///< which of two devices; 0 where there is one
  std::uint8_t place = 0;           ///< where on a floor (FloorPlace bits)
  std::uint8_t subtasks = 0;        ///< bit i: part i of the task is on
  std::uint8_t augmenting = 0;      ///< bit i: augmentation i adds force
  std::uint8_t began = 0;           ///< bit i: it was triggered in this tick
  std::uint8_t reserved[7]{};       ///< or the same tick would have other bytes
  Packed3 f_augmentation_D{};  ///< all augmentations and the pulse, as computed; in `f_wanted_D`
};
static_assert(std::is_trivially_copyable_v<FlightRecord>);

}  // namespace palpa::haptics
