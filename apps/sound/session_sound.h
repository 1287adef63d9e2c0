#pragma once

#include <atomic>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "apps/runtime/activity.h"
#include "apps/runtime/channels.h"
#include "apps/runtime/executive.h"
#include "apps/runtime/stop_switch.h"
#include "apps/sound/loudspeaker.h"
#include "apps/sound/score.h"
#include "apps/trial/trial_status.h"
#include "scene/scene_state.h"

namespace palpa::sound {

/// What of a frame has a sound: read from what is left of it when everything that the presentation
/// does not show was taken away (apps/trial/trial_scene.h, keepShown).
Seen seenIn(const scene::SceneState& shown, const trial::TrialStatus& status);

/// SOUND, 200 Hz, real time only: from what the screen shows and the emergency stop to cues. It
/// waits for nothing. The stop it reads from the switch itself, as the haptic loop does, so that it
/// sounds as well while the screen hangs.
class SessionSound final : public runtime::Activity {
 public:
  static constexpr std::int64_t kPeriod_ns = 5 * runtime::kMillisecond;
  /// A device that was asked for so long and has not answered is told of.
  static constexpr std::int64_t kOpensWithin_ns = 3 * runtime::kSecond;

  /// `heart_per_min` as in Score. All three outlive this.
  SessionSound(std::optional<double> heart_per_min, const runtime::StopSwitch& stop,
               const runtime::Clock& clock, OpenOutput open = openUsualOutput);

  const char* name() const override { return "sound"; }
  std::int64_t step(std::int64_t now_ns) override;

  // On the thread that draws:
  /// After every frame. Says once, in words for whoever is there, why nothing is heard; else empty.
  std::string see(const scene::SceneState& shown, const trial::TrialStatus& status,
                  std::int64_t now_ns);
  /// S: off, and on again. Says which, where it was one of these keys; else empty.
  std::string handle(const std::vector<std::string>& keys);

  /// After the session: on what it was played, or why not.
  std::string facts() const;

 private:
  const runtime::StopSwitch& stop_;
  Score score_;
  Loudspeaker speaker_;
  runtime::StateChannel<Seen> scene_to_sound_{runtime::TimeMode::real};
  bool audible_ = true, told_ = false;  ///< on the thread that draws
  std::int64_t first_ns_ = -1;          ///< first frame
  int switched_ = 0;                    ///< by the key
};

}  // namespace palpa::sound
