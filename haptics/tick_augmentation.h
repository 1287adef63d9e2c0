#pragma once

#include "haptics/tick_frame.h"

/// The floor that is searched, and what augmentations add to any contact: for this folder only.
namespace palpa::haptics {

/// The floor's contact; before an episode the handle is held over its middle instead, and always
/// its weight is carried (`frame->f_hold_D`).
NeedleContact floorContact(const TickConfig& config, TickState& state, const Floor* floor,
                           TickFrame* frame, FloorTouch* touch) noexcept;

/// Cues, parts and augmentations of this tick into the record. `touch`: of a floor, else null.
void addAugmentations(const TickConfig& config, TickState& state, const NeedleContact& contact,
                      const Floor* floor, const FloorTouch* touch, TickFrame* frame) noexcept;

}  // namespace palpa::haptics
