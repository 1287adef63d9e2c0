#pragma once

#include <array>

#include "haptics/flight_record.h"
#include "haptics/loop/tick_config.h"
#include "haptics/loop/tick_forces.h"
#include "haptics/loop/tick_state.h"

namespace palpa::haptics {

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
/// say. A surface whose friction is modulated feels `commands.friction` times as rough as its law's
/// wanted one; an artery in the commands pulses under one tool (feelPulse), not under two. Zero
/// force in the same tick for readings that cannot be, jumps, a clock that stood still or went
/// back, and after a pause of the loop (watchdog). A device that is not homed touches nothing.
/// `forces`, where it is asked for: what the force is made of.
FlightRecord tick(const TickConfig& config, TickState& state, const DeviceReading& reading,
                  const LocalGeometry* latest, const TickCommands& commands, std::int64_t now_ns,
                  const SensedForce& sensed = {}, const Floor* floor = nullptr,
                  TickForces* forces = nullptr) noexcept;

/// One tick of both: readings -> what each sensor felt -> augmentTouch, or modulateSqueeze -> each
/// device's passivity and safety. Each device keeps its own limits and is judged by its own
/// readings: pressing goes on with the one that is believed; squeezing, which takes two, gives no
/// force then. A second tool that is only tracked (`PairConfig::estimated`) is felt by estimate:
/// what `sensed` says of it is not asked for, its record says what was estimated, and it is given
/// no force. What is held is `commands.squeeze_*` times as hard and heavy as the law has it.
/// Pure; the promises of `tick`.
std::array<FlightRecord, 2> tickPair(const PairConfig& config, PairState& state,
                                     const std::array<DeviceReading, 2>& readings,
                                     const TickCommands& commands, std::int64_t now_ns,
                                     const std::array<SensedForce, 2>& sensed,
                                     std::array<TickForces, 2>* forces = nullptr) noexcept;

}  // namespace palpa::haptics
