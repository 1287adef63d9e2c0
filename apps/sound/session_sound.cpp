#include "apps/sound/session_sound.h"

#include <utility>

#include "anatomy/base/counted.h"
#include "apps/trial/trial_scene.h"

namespace palpa::sound {
namespace {

/// An alarm on the screen is a matter of force, or of where the needle is.
bool isAboutForce(const trial::TrialStatus& status) {
  return status.emergency_stop || !status.device.empty() || !trial::forceText(status.trip).empty();
}

constexpr const char* kInSilence = "; the session goes on in silence";

}  // namespace

Seen seenIn(const scene::SceneState& shown, const trial::TrialStatus& status) {
  Seen seen;
  seen.trial = status.trial;
  seen.running = status.state == trial::TrialState::running;
  if (shown.hud.alarm) seen.urgency = isAboutForce(status) ? Urgency::high : Urgency::medium;
  seen.blood = shown.blood;
  // Bright blood is seen by everybody; what it means is for the trainee to say, unless the screen
  // names what is touched.
  seen.arterial = shown.blood_of == Tissue::artery_lumen && !shown.hud.touched.empty();
  return seen;
}

SessionSound::SessionSound(std::optional<double> heart_per_min, const runtime::StopSwitch& stop,
                           const runtime::Clock& clock, OpenOutput open)
    : stop_(stop), score_(heart_per_min), speaker_(clock, std::move(open)) {}

std::int64_t SessionSound::step(std::int64_t now_ns) {
  const Seen* const shown = scene_to_sound_.read(now_ns);
  Seen seen = shown ? *shown : Seen();
  if (stop_.noForce() && !stop_.ended()) {
    seen.urgency = Urgency::high;
    seen.running = false;
  }
  if (stop_.ended()) seen = {.trial = seen.trial};  // the session ends: nothing new sounds
  for (const CueStart& start : score_.next(seen, now_ns)) speaker_.play(start);
  return now_ns + kPeriod_ns;
}

std::string SessionSound::see(const scene::SceneState& shown, const trial::TrialStatus& status,
                              std::int64_t now_ns) {
  scene_to_sound_.publish(seenIn(shown, status), now_ns);
  if (first_ns_ < 0) first_ns_ = now_ns;
  const Loudspeaker::State state = speaker_.state();
  const bool hangs = state == Loudspeaker::State::opening && now_ns - first_ns_ > kOpensWithin_ns;
  if (told_ || !(hangs || state == Loudspeaker::State::silent)) return "";
  told_ = true;
  return (hangs ? "The sound server does not answer" : speaker_.words()) + kInSilence;
}

std::string SessionSound::handle(const std::vector<std::string>& keys) {
  std::string words;
  for (const std::string& key : keys) {
    if (key != "s") continue;
    audible_ = !audible_;
    ++switched_;
    speaker_.setAudible(audible_);
    words = audible_ ? "The sound is on" : "The sound is off";
  }
  return words;
}

std::string SessionSound::facts() const {
  const std::string words = speaker_.words();
  const std::string how = speaker_.state() == Loudspeaker::State::playing ? "played on " + words
                          : speaker_.state() == Loudspeaker::State::silent
                              ? "not heard: " + words
                              : "not heard: the sound "
                                "server did not answer";
  return switched_ == 0 ? how : how + "; key S was pressed " + howOften(switched_);
}

}  // namespace palpa::sound
