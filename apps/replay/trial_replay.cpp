#include "apps/replay/trial_replay.h"

#include <algorithm>
#include <cstdio>

#include "apps/runtime/haptic_activity.h"

namespace palpa::replay {
namespace {

constexpr std::int64_t kFramePeriod_ns = 40'000'000;

std::string clockWords(double t_s) {
  char text[32];
  std::snprintf(text, sizeof text, "%d:%04.1f", static_cast<int>(t_s) / 60,
                t_s - 60 * (static_cast<int>(t_s) / 60));
  return text;
}

/// A camera that has nothing to complain of, and gives no picture: the scene then looks by itself.
runtime::CameraView calmCamera(std::int64_t now_ns) {
  runtime::CameraView camera;
  camera.t_exposure_ns = now_ns;
  camera.number = static_cast<std::uint64_t>(now_ns / kFramePeriod_ns);
  camera.tracking = ar::TrackState::tracked;
  return camera;
}

}  // namespace

std::string wordsAt(const std::vector<StripMark>& marks, double t_s) {
  std::string words;
  for (const StripMark& mark : marks)
    if (mark.t_s <= t_s && t_s < mark.t_s + kMarkShown) words = mark.words;
  return words;
}

runtime::ToolState toolIn(const haptics::FlightRecord& record, const Pose& X_ET) {
  const Quat q_DE = unpack(record.reading.q_DE);
  return runtime::toolStateOf(
      pack(makePose(q_DE.normalized().toRotationMatrix(), unpack(record.reading.p_DE)) * X_ET),
      record);
}

trial::TrialScene::Stage TrialReplay::stage(scene::SceneView& view) {
  trial::TrialScene::Stage s;
  s.views = trial::TrialScene::Views::continuous;
  s.view = &view;
  s.camera.width = 1280;  // no picture is drawn with it
  s.camera.height = 720;
  s.camera.fx = s.camera.fy = 1100;
  s.camera.cx = 639.5;
  s.camera.cy = 359.5;
  s.X_WD = trial_.X_AD;
  s.mark = trial_.mark;
  s.input = [this](const scene::ViewInput& given, std::int64_t) { input_ = given; };
  s.more = [this](scene::SceneState& state) {
    add(state, at_s_);
    addStrip(state);
    if (told_) told_(state);
  };
  return s;
}

void TrialReplay::addStrip(scene::SceneState& state) const {
  scene::Timeline strip;
  const double length = std::max(length_s_, 1e-9);
  strip.at = at_s_ / length;
  for (const StripMark& mark : trial_.marks) strip.ticks.push_back({mark.t_s / length, mark.tone});
  strip.time = clockWords(at_s_);
  strip.whole = " of " + clockWords(length_s_);
  strip.rate = rate_;
  state.hud.timeline = strip;
  const std::string words = wordsAt(trial_.marks, at_s_);
  if (words.empty()) return;
  (state.hud.alarm ? state.hud.note : state.hud.notice) = words;
}

void TrialReplay::fill(trial::TrialStatus& status, double elapsed_s) const {
  status.state = trial::TrialState::running;
  status.trial = trial_.number;
  status.trials = 1;
  status.force_feedback = trial_.force_feedback;
  status.elapsed_s = elapsed_s;
}

void TrialReplay::show(double t_s, const std::string& rate) {
  at_s_ = t_s;
  rate_ = rate;
  now_ns_ += kFramePeriod_ns;
  bus_.camera_to_scene.publish(calmCamera(now_ns_), now_ns_);
  showAt(t_s, now_ns_);
  scene().step(now_ns_);
}

}  // namespace palpa::replay
