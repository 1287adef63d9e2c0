#include "apps/replay/palpation_replay.h"

#include "anatomy/phantom_block.h"
#include "apps/task_palpation/palpation_scene.h"

namespace palpa::replay {
namespace {

class PalpationReplay final : public TrialReplay {
 public:
  PalpationReplay(const PalpationTrial& trial, scene::SceneView& view)
      : TrialReplay(trial, trial.length_s()),
        recorded_(trial),
        map_(emptyMap()),
        scene_({stage(view), anatomy::X_AP(), trial.rules.area, trial.tip_radius, ""}, bus_,
               channels_) {}

 private:
  assess::CoverageMap emptyMap() const {
    return {recorded_.rules.area, recorded_.rules.levels, recorded_.rules.reach};
  }

  /// What had been felt up to a moment: going back begins anew.
  void feelUpTo(std::size_t samples) {
    if (samples < felt_) {
      map_ = emptyMap();
      felt_ = 0;
    }
    for (; felt_ < samples; ++felt_) map_.add(recorded_.samples[felt_]);
  }

  void tell(double t_s, std::int64_t now_ns) override {
    const PalpationMoment& moment = recorded_.moments[momentAt(recorded_.moments, t_s)];
    feelUpTo(moment.samples);
    task_palpation::PalpationStatus status;
    fill(status, t_s);
    status.columns = map_.columns();
    status.rows = map_.rows();
    status.levels = task_palpation::levelsOf(map_);
    for (std::size_t i = 0; i < moment.marks; ++i)
      status.marks_P.push_back(recorded_.pressed[i].p_P);
    status.lumps = recorded_.lumps;
    status.pressed_N = moment.samples > 0 ? recorded_.samples[moment.samples - 1].f_n : 0;
    status.level = task_palpation::levelOf(recorded_.rules.levels, status.pressed_N);
    bus_.haptic_to_scene.publish(moment.tool, now_ns);
    channels_.status_to_scene.publish(status, now_ns);
  }

  trial::TrialScene& scene() override { return scene_; }

  const PalpationTrial& recorded_;
  assess::CoverageMap map_;
  std::size_t felt_ = 0;
  task_palpation::PalpationChannels channels_{runtime::TimeMode::virtual_time};
  task_palpation::PalpationScene scene_;
};

}  // namespace

PalpationReader::PalpationReader(const haptics::TickConfig& config, int trial)
    : X_ET_(unpack(config.X_ET)), listener_(config) {
  listener_.begin(static_cast<std::uint32_t>(trial));
}

void PalpationReader::add(const haptics::FlightRecord& record) {
  if (!listener_.add(record)) return;
  moments_.push_back({listener_.seconds(), toolIn(record, X_ET_), listener_.samples().size(),
                      listener_.marks().size()});
}

void PalpationReader::into(PalpationTrial& trial) const {
  trial.moments = moments_;
  trial.samples = listener_.samples();
  trial.pressed = listener_.marks();
}

std::unique_ptr<TrialReplay> palpationReplay(const PalpationTrial& trial, scene::SceneView& view) {
  return std::make_unique<PalpationReplay>(trial, view);
}

}  // namespace palpa::replay
