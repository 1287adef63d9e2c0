#include "apps/replay/squeeze_replay.h"

#include "apps/task_squeeze/squeeze_scene.h"

namespace palpa::replay {
namespace {

class SqueezeReplay final : public TrialReplay {
 public:
  SqueezeReplay(const SqueezeTrial& trial, scene::SceneView& view)
      : TrialReplay(trial, trial.length_s()),
        recorded_(trial),
        scene_({stage(view), trial.X_AD2, trial.middle_A}, bus_, channels_) {}

 private:
  void tell(double t_s, std::int64_t now_ns) override {
    const SqueezeMoment& moment = recorded_.moments[momentAt(recorded_.moments, t_s)];
    task_squeeze::SqueezeStatus status;
    fill(status, t_s);
    status.property = recorded_.comparison.property;
    status.thing = moment.thing;
    status.squeezed_N = moment.squeezed_N;
    status.held = moment.held;
    bus_.haptic_to_scene.publish(moment.tools[0], now_ns);
    bus_.second_to_scene.publish(moment.tools[1], now_ns);
    channels_.status_to_scene.publish(status, now_ns);
  }

  trial::TrialScene& scene() override { return scene_; }

  const SqueezeTrial& recorded_;
  task_squeeze::SqueezeChannels channels_{runtime::TimeMode::virtual_time};
  task_squeeze::SqueezeScene scene_;
};

}  // namespace

SqueezeReader::SqueezeReader(double touch_N, const std::array<Pose, 2>& X_ET,
                             const task_squeeze::Comparison& comparison, int trial)
    : X_ET_(X_ET), listener_(touch_N), trial_(static_cast<std::uint32_t>(trial)) {
  listener_.begin(trial_, comparison);
}

void SqueezeReader::add(const haptics::FlightRecord& record) {
  if (record.commands.trial != trial_ || !record.commands.armed) return;
  listener_.add(record);
  if (record.tool == 0) {
    first_ = toolIn(record, X_ET_[0]);
    return;
  }
  const double t_s = listener_.seconds();
  if (!moments_.empty() && t_s - moments_.back().t_s < kMomentStep - 1e-9) return;
  moments_.push_back({t_s,
                      {first_, toolIn(record, X_ET_[1])},
                      listener_.thing(record.commands),
                      listener_.now_N(),
                      listener_.held()});
}

std::unique_ptr<TrialReplay> squeezeReplay(const SqueezeTrial& trial, scene::SceneView& view) {
  return std::make_unique<SqueezeReplay>(trial, view);
}

}  // namespace palpa::replay
