#pragma once

#include <array>
#include <type_traits>

#include "haptics/augmentation/augmentation.h"
#include "haptics/contact/needle_contact.h"
#include "haptics/contact/probe_contact.h"
#include "haptics/modulation/estimated_reaction.h"
#include "haptics/modulation/modulation.h"
#include "haptics/modulation/pulse.h"
#include "haptics/modulation/touch_augmentation.h"
#include "haptics/safety/passivity.h"
#include "haptics/safety/plausibility.h"
#include "haptics/safety/safety_limiter.h"

/// What a tick keeps for the next one: a keyframe of a record.
namespace palpa::haptics {

/// Everything that changes: copy it, and the loop can be continued from there.
struct TickState {
  std::int64_t tick = 0;
  std::int64_t t_ns = 0;
  std::int64_t t_adopted_ns = 0;  ///< when `now` replaced `old`
  LocalGeometry now, old;
  NeedleState contact, contact_old;  ///< `contact_old` runs on `old` during the blend
  ProbeState probe, probe_old;
  TouchAugmentationState touch;
  PulseState pulse;
  FloorState floor;
  PointMotion tip;  ///< by which the task's parts are recognised
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

/// Of two devices on one real thing.
struct PairState {
  std::array<TickState, 2> tools;
  TouchAugmentationState touch;
  SqueezeState squeeze;
  EstimateState estimate;
  std::uint32_t trial = 0;
  std::uint8_t reserved[4]{};
};
static_assert(std::is_trivially_copyable_v<PairState>);

}  // namespace palpa::haptics
