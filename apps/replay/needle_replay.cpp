#include "apps/replay/needle_replay.h"

#include "apps/task_needle/scene_activity.h"

namespace palpa::replay {
namespace {

constexpr double kTrailPoint = 0.0005;  // m between points of the trail

class NeedleReplay final : public TrialReplay {
 public:
  NeedleReplay(const NeedleTrial& trial, scene::SceneView& view, RecordedPictures* pictures)
      : TrialReplay(trial, trial.length_s()),
        recorded_(trial),
        pictures_(pictures),
        scene_(setup(view), bus_, channels_) {
    Vec3 last = Vec3::Constant(1e9);
    for (const Moment& moment : recorded_.moments) {
      const Vec3 tip = recorded_.X_AD * unpack(moment.tool.X_DT).translation();
      if (moment.tool.phase != haptics::NeedlePhase::outside && (tip - last).norm() > kTrailPoint)
        trail_.push_back(last = tip);
      trail_length_.push_back(trail_.size());
    }
  }

 private:
  task_needle::SceneActivity::Setup setup(scene::SceneView& view) {
    task_needle::SceneActivity::Setup s;
    s.stage = stage(view);
    s.words = recorded_.words;
    return s;
  }

  void tell(double t_s, std::int64_t now_ns) override {
    const Moment& moment = recorded_.moments[momentAt(recorded_.moments, t_s)];
    bus_.haptic_to_scene.publish(moment.tool, now_ns);
    task_needle::TaskStatus status = statusAt(moment, recorded_.number, recorded_.force_feedback);
    status.elapsed_s = t_s;  // as the strip says it
    channels_.status_to_scene.publish(status, now_ns);
  }

  trial::TrialScene& scene() override { return scene_; }

  /// The way so far, whichever way one came here.
  void add(scene::SceneState& state, double at_s) override {
    const std::size_t i = momentAt(recorded_.moments, at_s);
    state.trail_A.assign(trail_.begin(),
                         trail_.begin() + static_cast<std::ptrdiff_t>(trail_length_[i]));
    state.beside = pictures_ ? pictures_->at(recorded_.moments[i].tool.t_ns) : nullptr;
  }

  const NeedleTrial& recorded_;
  RecordedPictures* pictures_;
  std::vector<Vec3> trail_;
  std::vector<std::size_t> trail_length_;  ///< up to each moment
  task_needle::TaskChannels channels_{runtime::TimeMode::virtual_time};
  task_needle::SceneActivity scene_;
};

}  // namespace

std::unique_ptr<TrialReplay> needleReplay(const NeedleTrial& trial, scene::SceneView& view,
                                          RecordedPictures* pictures) {
  return std::make_unique<NeedleReplay>(trial, view, pictures);
}

}  // namespace palpa::replay
