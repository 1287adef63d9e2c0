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
/// (skin, view, needle, sound) is done where it belongs.
void handleKeys(const scene::ViewInput& input, Channels& channels, runtime::StopSwitch& stop);

/// What moves the tool, beside these keys.
enum class HeldBy { device, mouse_needle, mouse_finger };

/// Which keys there are besides those of every session.
struct KeysInUse {
  training::Engine engine = training::Engine::needle;
  HeldBy held = HeldBy::device;
  bool left_handed = false;
  bool free_skin = false;       ///< its look may be changed
  bool one_fixed_view = false;  ///< of several
  bool sound = false;           ///< it may be heard
};
/// All keys of a session with what they do, as the window shows them: what the trainee needs first.
/// Letters as scene/key_places.h names them: "[P]".
std::vector<scene::KeyHelp> keysOf(const KeysInUse& use);
/// The same as one line of a command's help: "Keys: Enter starts or continues, ...".
std::string keysText(training::Engine engine);
/// How the tool is moved, in one line for the window, with "[Z]"; empty: a device says it by
/// itself.
std::string movedWords(HeldBy held, bool left_handed);

}  // namespace palpa::trial
