#pragma once

#include <array>
#include <type_traits>

#include "anatomy/geometry/top_shape.h"
#include "haptics/augmentation/augmentation.h"
#include "haptics/contact/needle_contact.h"
#include "haptics/contact/probe_contact.h"
#include "haptics/modulation/modulation.h"
#include "haptics/modulation/pulse.h"
#include "haptics/modulation/touch_augmentation.h"
#include "haptics/safety/passivity.h"
#include "haptics/safety/safety_limiter.h"

/// What a tick is given once, before a session. Who configures or records it needs no tick.
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
  PulseLaw pulse;
  PackedPose X_DP;  ///< the real thing, in whose frame its lumps lie
  TopShape top;     ///< of the real thing, in P; flat: the plane z = 0
  PackedPose X_DF;  ///< the floor
  FloorRendering floor;
  AugmentationPlan augmentations;
  std::array<double, kMostLumpKinds> lump_radius{};  ///< m, of each kind: where a lump's edge is
};
static_assert(std::is_trivially_copyable_v<TickConfig>);

/// Two devices on one real thing, in one tick: two fingers that press it, or that hold and squeeze
/// it.
struct PairConfig {
  /// Both ContactMode::sensed_object, each with its own X_DP; what is added is the first one's
  /// `touch`
  std::array<TickConfig, 2> tools;
  SqueezeModulation squeeze;
  std::uint8_t squeezing = 0;  ///< 1: held between the tools, in place of pressed
  /// 1: the second tool is tracked and has neither a force sensor nor drives: what it presses with
  /// is estimated (`estimateReaction`), and it is given no force
  std::uint8_t estimated = 0;
  std::uint8_t opposed = 0;  ///< 1: the second tool presses the face opposite the first one's
  std::uint8_t reserved[1]{};
  float thickness = 0;  ///< m, from face to face where they are opposed
};
static_assert(std::is_trivially_copyable_v<PairConfig>);

}  // namespace palpa::haptics
