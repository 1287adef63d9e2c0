#pragma once

#include <vector>

#include "apps/runtime/bus.h"
#include "scene/scene_state.h"

namespace palpa::task_palpation {

/// The arrows at a tool that presses, N, in A: what the real thing gives back, at the tip, and what
/// the device adds, at the handle, both as the loop recorded them. Where they may not be told apart
/// only what is felt, their sum: the device does nothing but lumps, and its arrow would give them
/// away. Weaker ones than 0.05 N are not shown.
std::vector<scene::ForceArrow> shownForces(const runtime::ToolState& tool, const Mat3& R_AD,
                                           const Pose& X_AT, bool apart);

}  // namespace palpa::task_palpation
