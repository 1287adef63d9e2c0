#include "apps/replay/needle_replay.h"

#include <cstdio>

#include "apps/task_needle/scene_activity.h"

namespace palpa::replay {
namespace {

constexpr std::int64_t kFramePeriod_ns = 40'000'000;
constexpr double kTrailPoint = 0.0005;   // m between points of the trail

std::string clockWords(double t_s) {
  char text[32];
  std::snprintf(text, sizeof text, "%d:%04.1f", static_cast<int>(t_s) / 60, t_s - 60 * (static_cast<int>(t_s) / 60));
  return text;
}

}  // namespace

std::string wordsAt(const std::vector<Mark>& marks, double t_s) {
  std::string words;
  for (const Mark& mark : marks)
    if (mark.t_s <= t_s && t_s < mark.t_s + kMarkShown) words = mark.words;
  return words;
}

struct NeedleReplay::Impl {
  Impl(const NeedleTrial& shown, scene::SceneView& on, RecordedPictures* beside) : recorded(shown), view(on), pictures(beside), activity(setup(), bus, channels) {
    Vec3 last = Vec3::Constant(1e9);
    for (const Moment& moment : recorded.moments) {
      const Vec3 tip = recorded.X_AD * unpack(moment.tool.X_DT).translation();
      if (moment.tool.phase != haptics::NeedlePhase::outside && (tip - last).norm() > kTrailPoint) trail.push_back(last = tip);
      trail_length.push_back(trail.size());
    }
  }

  task_needle::SceneActivity::Setup setup() {
    task_needle::SceneActivity::Setup s;
    s.stage.views = trial::TrialScene::Views::continuous;
    s.stage.view = &view;
    s.stage.camera.width = 1280;   // no picture is drawn with it
    s.stage.camera.height = 720;
    s.stage.camera.fx = s.stage.camera.fy = 1100;
    s.stage.camera.cx = 639.5;
    s.stage.camera.cy = 359.5;
    s.stage.X_WD = recorded.X_AD;     // W is A here
    s.stage.mark = recorded.mark;
    s.stage.input = [this](const scene::ViewInput& given, std::int64_t) { input = given; };
    s.stage.more = [this](scene::SceneState& state) { add(state); };
    s.words = recorded.words;
    return s;
  }

  /// What only a replay shows: the way so far, whichever way one came here; the strip; what happened.
  void add(scene::SceneState& state) const {
    const std::size_t i = momentAt(recorded.moments, at_s);
    state.trail_A.assign(trail.begin(), trail.begin() + static_cast<std::ptrdiff_t>(trail_length[i]));
    state.beside = pictures ? pictures->at(recorded.moments[i].tool.t_ns) : nullptr;
    scene::Timeline strip;
    const double length = std::max(recorded.length_s(), 1e-9);
    strip.at = at_s / length;
    for (const Mark& mark : recorded.marks) strip.ticks.push_back({mark.t_s / length, mark.tone});
    strip.time = clockWords(at_s) + " of " + clockWords(recorded.length_s());
    strip.rate = rate;
    state.hud.timeline = strip;
    const std::string words = wordsAt(recorded.marks, at_s);
    if (words.empty()) return;
    (state.hud.alarm ? state.hud.note : state.hud.notice) = words;
  }

  /// A camera that has nothing to complain of, and gives no picture: the scene then looks by itself.
  runtime::CameraView calmCamera() const {
    runtime::CameraView camera;
    camera.t_exposure_ns = now_ns;
    camera.number = static_cast<std::uint64_t>(now_ns / kFramePeriod_ns);
    camera.tracking = ar::TrackState::tracked;
    return camera;
  }

  void show(double t_s, const std::string& words) {
    at_s = t_s;
    rate = words;
    now_ns += kFramePeriod_ns;
    const Moment& moment = recorded.moments[momentAt(recorded.moments, t_s)];
    bus.haptic_to_scene.publish(moment.tool, now_ns);
    bus.camera_to_scene.publish(calmCamera(), now_ns);
    task_needle::TaskStatus status = statusAt(moment, recorded.number, recorded.force_feedback);
    status.elapsed_s = t_s;   // as the strip says it
    channels.status_to_scene.publish(status, now_ns);
    activity.step(now_ns);
  }

  const NeedleTrial& recorded;
  scene::SceneView& view;
  RecordedPictures* pictures;
  std::vector<Vec3> trail;
  std::vector<std::size_t> trail_length;   ///< up to each moment
  runtime::Bus bus{runtime::TimeMode::virtual_time};
  task_needle::TaskChannels channels{runtime::TimeMode::virtual_time};
  scene::ViewInput input;
  double at_s = 0;
  std::string rate;
  std::int64_t now_ns = 0;
  task_needle::SceneActivity activity;
};

NeedleReplay::NeedleReplay(const NeedleTrial& trial, scene::SceneView& view, RecordedPictures* pictures) : impl_(std::make_unique<Impl>(trial, view, pictures)) {}
NeedleReplay::~NeedleReplay() = default;
void NeedleReplay::show(double t_s, const std::string& rate) { impl_->show(t_s, rate); }
const scene::ViewInput& NeedleReplay::input() const { return impl_->input; }

}  // namespace palpa::replay
