#pragma once

#include <string>
#include <vector>

#include "apps/runtime/stop_switch.h"
#include "apps/training/engine.h"
#include "apps/trial/trial_status.h"
#include "scene/scene_state.h"
#include "scene/view/scene_view.h"

namespace palpa::trial {

/// Keys that every session understands, and what a trainee says by a key; whatever else a key does
/// (skin, view, needle) is done where it belongs.
void handleKeys(const scene::ViewInput& input, Channels& channels, runtime::StopSwitch& stop);

/// What moves the tool, beside these keys.
enum class HeldBy { device, mouse_needle, mouse_finger };

/// All keys of a session with what they do, as the window shows them: what the trainee needs first.
std::vector<scene::KeyHelp> keysOf(training::Engine engine, HeldBy held, bool left_handed = false);
/// The same as one line of a command's help: "Keys: Enter starts or continues, ...".
std::string keysText(training::Engine engine);

}  // namespace palpa::trial
