#pragma once

#include <array>
#include <type_traits>

#include "haptics/augmentation/augmentation.h"
#include "haptics/contact/needle_contact.h"
#include "haptics/contact/probe_contact.h"
#include "haptics/modulation/modulation.h"
#include "haptics/modulation/touch_augmentation.h"
#include "haptics/safety/passivity.h"
#include "haptics/safety/plausibility.h"
#include "haptics/safety/safety_limiter.h"

namespace palpa::haptics {

/// What the tool touches: a virtual patient, as a needle or a probe, a real thing with a force
/// sensor, whose feel is changed, or a virtual floor, as a probe.
enum class ContactMode : std::uint8_t { needle, probe, sensed_object, floor };

/// Constant during a session; stored in its file. Trivially copyable, so that a replay has it
/// whole.
struct TickConfig {
  NeedleMaterials materials;
  ProbeMaterials probe;
  ContactMode contact_mode = ContactMode::needle;
  /// 1: a real object is touched beyond the force sensor, the hand holds the tool before it:
  /// passivity is kept at the hand's port, device and object together. 0: what is sensed is only
  /// recorded.
  std::uint8_t object_at_port = 0;
  std::uint8_t device_turns = 1;  ///< 0: no orientation is read; see toolPose
  std::uint8_t reserved[2]{};
  CouplingLimits coupling;
  PassivityLimits passivity;
  SafetyLimits safety;
  PackedPose X_ET;  ///< tool tip in the end effector; needle along +z of T
  std::int64_t period_ns = 1'000'000;
  std::int64_t blend_ns = 10'000'000;       ///< a new snapshot takes over within this time
  std::int64_t age_limit_ns = 100'000'000;  ///< older snapshots fade out
  std::int64_t fade_ns = 50'000'000;
  TouchAugmentation touch;
  PackedPose X_DP;  ///< the real thing, in whose frame its lumps lie
  PackedPose X_DF;  ///< the floor
  FloorRendering floor;
  AugmentationPlan augmentations;
  std::array<double, kMostLumpKinds> lump_radius{};  ///< m, of each kind: where a lump's edge is
};
static_assert(std::is_trivially_copyable_v<TickConfig>);

/// Everything that changes: copy it, and the loop can be continued from there.
struct TickState {
  std::int64_t tick = 0;
  std::int64_t t_ns = 0;
  std::int64_t t_adopted_ns = 0;  ///< when `now` replaced `old`
  LocalGeometry now, old;
  NeedleState contact, contact_old;  ///< `contact_old` runs on `old` during the blend
  ProbeState probe, probe_old;
  TouchAugmentationState touch;
  FloorState floor;
  PointMotion tip;  ///< of what the task's parts are told by
  AugmentationState augmentation;
  PassivityState passivity;
  SafetyState safety;
  ReadingState reading;
  double homing_ns = 0;       ///< still to be steady after homing
  std::uint64_t refused = 0;  ///< number of the last snapshot, when it was damaged
  std::uint32_t trial = 0;
  std::uint8_t blending = 0;
  SafetyCause cause = SafetyCause::none;
  std::uint8_t tripped = 0;  ///< force was taken away and has not come back
  std::uint8_t reserved[1]{};
};
static_assert(std::is_trivially_copyable_v<TickState>);

/// X_DT, the needle along its +z: as the device holds it; where the device does not turn, along
/// entry to tip once it is some millimetres in the tissue: the entry is its pivot.
PackedPose toolPose(const TickConfig& config, const TickState& state,
                    const DeviceReading& reading) noexcept;

/// One tick: reading -> contact on the snapshot -> blend -> augmentation -> passivity -> safety
/// limiter -> command. Pure: same inputs, same bits. `latest` is the newest snapshot or null; it is
/// adopted when the last blend is over, unless it is damaged. Whatever comes in, the command is
/// finite and within the limits. Never allocates, locks, logs or throws. `sensed` is what a force
/// sensor says of a real object at the tool: it counts at the hand's port.
/// ContactMode::sensed_object asks for no snapshots, and gives no force while the sensor is not
/// valid; ContactMode::floor asks for none either, `floor` is the one whose number the commands
/// say. Zero force in the same tick for readings that cannot be, jumps, a clock that stood still or
/// went back, and after a pause of the loop (watchdog). A device that is not homed touches nothing.
FlightRecord tick(const TickConfig& config, TickState& state, const DeviceReading& reading,
                  const LocalGeometry* latest, const TickCommands& commands, std::int64_t now_ns,
                  const SensedForce& sensed = {}, const Floor* floor = nullptr) noexcept;

}  // namespace palpa::haptics

/// Two devices on one real thing, in one tick: two fingers that press it, or that hold and squeeze
/// it.
namespace palpa::haptics {

struct PairConfig {
  /// Both ContactMode::sensed_object, each with its own X_DP; what is added is the first one's
  /// `touch`
  std::array<TickConfig, 2> tools;
  SqueezeModulation squeeze;
  std::uint8_t squeezing = 0;  ///< 1: held between the tools, in place of pressed
  std::uint8_t reserved[7]{};
};
struct PairState {
  std::array<TickState, 2> tools;
  TouchAugmentationState touch;
  SqueezeState squeeze;
  std::uint32_t trial = 0;
  std::uint8_t reserved[4]{};
};
static_assert(std::is_trivially_copyable_v<PairConfig> && std::is_trivially_copyable_v<PairState>);

/// One tick of both: readings -> what each sensor felt -> augmentTouch, or modulateSqueeze -> each
/// device's passivity and safety. Each device keeps its own limits and is judged by its own
/// readings: pressing goes on with the one that is believed; squeezing, which takes two, gives no
/// force then. What is held is `commands.squeeze_*` times as hard and heavy as the law has it.
/// Pure; the promises of `tick`.
std::array<FlightRecord, 2> tickPair(const PairConfig& config, PairState& state,
                                     const std::array<DeviceReading, 2>& readings,
                                     const TickCommands& commands, std::int64_t now_ns,
                                     const std::array<SensedForce, 2>& sensed) noexcept;

}  // namespace palpa::haptics
