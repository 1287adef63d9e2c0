#pragma once

#include "apps/runtime/bus.h"
#include "apps/task_needle/task_status.h"
#include "apps/task_needle/task_words.h"
#include "scene/scene_state.h"

namespace palpa::task_needle {

/// The needle is in the lung or an artery, or in their walls.
bool injury(const runtime::ToolState& tool);

/// The HUD's lines in clinical words; in assessment only what is there without a simulator: the
/// trial, the time, the blood. `camera`: what is wrong with the camera
/// (apps/runtime/camera_words.h); empty: nothing.
scene::Hud hudText(const TaskStatus& status, const runtime::ToolState& tool,
                   const std::string& camera, const std::string& mark, const TaskWords& words = {});

}  // namespace palpa::task_needle
