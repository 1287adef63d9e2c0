#include "apps/replay/search_replay.h"

#include "anatomy/phantom_block.h"
#include "apps/task_search/search_scene.h"

namespace palpa::replay {
namespace {

constexpr double kLongestGap = 0.1;  // s; longer: it was paused

class SearchReplay final : public TrialReplay {
 public:
  SearchReplay(const SearchTrial& trial, scene::SceneView& view)
      : TrialReplay(trial, trial.length_s()),
        recorded_(trial),
        scene_({stage(view), Pose::Identity(), anatomy::X_AP(), trial.side, trial.magnification},
               bus_, channels_) {}

 private:
  void tell(double t_s, std::int64_t now_ns) override {
    const SearchMoment& moment = recorded_.moments[momentAt(recorded_.moments, t_s)];
    task_search::SearchStatus status;
    fill(status, moment.searched_s);
    status.held = moment.held;
    bus_.haptic_to_scene.publish(moment.tool, now_ns);
    channels_.status_to_scene.publish(status, now_ns);
  }

  trial::TrialScene& scene() override { return scene_; }

  const SearchTrial& recorded_;
  task_search::SearchChannels channels_{runtime::TimeMode::virtual_time};
  task_search::SearchScene scene_;
};

}  // namespace

SearchReader::SearchReader(const task_search::SearchSettings& task,
                           const haptics::TickConfig& config, int trial)
    : config_(config),
      listener_(task, config.augmentations),
      trial_(static_cast<std::uint32_t>(trial)) {
  listener_.begin(trial_);
}

void SearchReader::add(const haptics::FlightRecord& record) {
  if (record.commands.trial != trial_ || !record.commands.armed) return;
  listener_.add(record, task_search::tipOf(config_, record.reading));
  const double dt = last_ns_ < 0 ? 0 : 1e-9 * static_cast<double>(record.t_ns - last_ns_);
  last_ns_ = record.t_ns;
  if (dt <= kLongestGap) seconds_ += dt;
  if (!moments_.empty() && seconds_ - moments_.back().t_s < kMomentStep - 1e-9) return;
  moments_.push_back(
      {seconds_, toolIn(record, unpack(config_.X_ET)), !listener_.released(), listener_.seconds()});
}

std::unique_ptr<TrialReplay> searchReplay(const SearchTrial& trial, scene::SceneView& view) {
  return std::make_unique<SearchReplay>(trial, view);
}

}  // namespace palpa::replay
