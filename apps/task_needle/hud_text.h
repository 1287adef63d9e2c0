#pragma once

#include "apps/runtime/bus.h"
#include "apps/task_needle/task_status.h"
#include "scene/scene_state.h"

namespace palpa::task_needle {

/// The needle is in the lung or an artery, or in their walls.
bool injury(const runtime::ToolState& tool);

/// The HUD's lines in clinical words.
scene::Hud hudText(const TaskStatus& status, const runtime::ToolState& tool, bool board_seen,
                   const std::string& mark);

}  // namespace palpa::task_needle
