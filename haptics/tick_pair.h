#pragma once

#include <array>
#include <type_traits>

#include "haptics/squeeze_modulation.h"
#include "haptics/tick.h"

/// Two devices on one real thing, in one tick: two fingers that press it, or that hold and squeeze
/// it.
namespace palpa::haptics {

struct PairConfig {
  std::array<TickConfig, 2> tools;  ///< both Engine::touch, each with its own X_DP; what is added
                                    ///< is the first one's `touch`
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
