#include "apps/replay/touch_replay.h"

#include <algorithm>

#include "anatomy/parametric/phantoms.h"
#include "apps/task_comparison/comparison_scene.h"
#include "apps/task_palpation/palpation_scene.h"
#include "apps/task_pulse/pulse_scene.h"
#include "apps/task_search/search_scene.h"

namespace palpa::replay {
namespace {

class PalpationReplay final : public TrialReplay {
 public:
  PalpationReplay(const PalpationTrial& trial, scene::SceneView& view)
      : TrialReplay(trial, trial.length_s()),
        recorded_(trial),
        map_(emptyMap()),
        scene_({stage(view), anatomy::X_AP(), trial.rules.area, trial.tip_radius, "", trial.X_AD2,
                trial.estimated, trial.map},
               bus_, channels_) {}

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

  void showAt(double t_s, std::int64_t now_ns) override {
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
    status.pressed_N =
        task_palpation::pressing(assess::PalpationSamples(recorded_.samples).first(moment.samples));
    status.level = task_palpation::levelOf(recorded_.rules.levels, status.pressed_N);
    bus_.haptic_to_scene.publish(moment.tool, now_ns);
    if (recorded_.X_AD2) bus_.second_to_scene.publish(moment.second, now_ns);
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

PalpationReader::PalpationReader(const haptics::TickConfig& config,
                                 const std::optional<haptics::PairConfig>& pair, int trial)
    : X_ET_(unpack(config.X_ET)), listener_(config, pair) {
  listener_.begin(static_cast<std::uint32_t>(trial));
}

void PalpationReader::add(const haptics::FlightRecord& record) {
  if (!listener_.add(record)) return;
  if (record.tool == 0)
    moments_.push_back({listener_.seconds(), toolIn(record, X_ET_), {}, 0, 0});
  else if (!moments_.empty())
    moments_.back().second = toolIn(record, X_ET_);
  if (moments_.empty()) return;
  moments_.back().samples = listener_.samples().size();
  moments_.back().marks = listener_.marks().size();
}

void PalpationReader::into(PalpationTrial& trial) const {
  trial.moments = moments_;
  trial.samples = listener_.samples();
  trial.pressed = listener_.marks();
}

std::unique_ptr<TrialReplay> palpationReplay(const PalpationTrial& trial, scene::SceneView& view) {
  return std::make_unique<PalpationReplay>(trial, view);
}

namespace {

class SearchReplay final : public TrialReplay {
 public:
  SearchReplay(const ShownSearch& trial, scene::SceneView& view)
      : TrialReplay(trial, trial.length_s()),
        recorded_(trial),
        scene_({stage(view), Pose::Identity(), anatomy::X_AP(), trial.side, trial.magnification},
               bus_, channels_) {}

 private:
  void showAt(double t_s, std::int64_t now_ns) override {
    const SearchMoment& moment = recorded_.moments[momentAt(recorded_.moments, t_s)];
    task_search::SearchStatus status;
    fill(status, moment.searched_s);
    status.held = moment.held;
    bus_.haptic_to_scene.publish(moment.tool, now_ns);
    channels_.status_to_scene.publish(status, now_ns);
  }

  trial::TrialScene& scene() override { return scene_; }

  const ShownSearch& recorded_;
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
  if (record.commands.trial != trial_) return;
  if (!record.commands.armed) return clock_.pause();
  listener_.add(record, task_search::tipOf(config_, record.reading));
  clock_.pass(record.t_ns);
  if (!moments_.empty() && clock_.seconds() - moments_.back().t_s < kMomentStep - 1e-9) return;
  moments_.push_back({clock_.seconds(), toolIn(record, unpack(config_.X_ET)), !listener_.released(),
                      listener_.seconds()});
}

std::unique_ptr<TrialReplay> searchReplay(const ShownSearch& trial, scene::SceneView& view) {
  return std::make_unique<SearchReplay>(trial, view);
}

namespace {

class ComparisonReplay final : public TrialReplay {
 public:
  ComparisonReplay(const ShownComparison& trial, scene::SceneView& view)
      : TrialReplay(trial, trial.length_s()),
        recorded_(trial),
        scene_({stage(view), trial.X_AD2, trial.middle_A, trial.up_A, true}, bus_, channels_) {}

 private:
  void showAt(double t_s, std::int64_t now_ns) override {
    const ComparisonMoment& moment = recorded_.moments[momentAt(recorded_.moments, t_s)];
    task_comparison::ComparisonStatus status;
    fill(status, t_s);
    status.property = recorded_.comparison.property;
    status.thing = moment.thing;
    status.things = static_cast<int>(recorded_.comparison.factors.size());
    status.force_N = moment.force_N;
    status.touching = moment.touching;
    bus_.haptic_to_scene.publish(moment.tools[0], now_ns);
    if (recorded_.X_AD2) bus_.second_to_scene.publish(moment.tools[1], now_ns);
    channels_.status_to_scene.publish(status, now_ns);
  }

  trial::TrialScene& scene() override { return scene_; }

  const ShownComparison& recorded_;
  task_comparison::ComparisonChannels channels_{runtime::TimeMode::virtual_time};
  task_comparison::ComparisonScene scene_;
};

}  // namespace

ComparisonReader::ComparisonReader(double touch_N, const std::vector<Pose>& X_ET,
                                   const task_comparison::Comparison& comparison, int trial)
    : X_ET_(X_ET),
      listener_(touch_N, static_cast<int>(X_ET.size())),
      trial_(static_cast<std::uint32_t>(trial)) {
  listener_.begin(trial_, comparison);
}

void ComparisonReader::add(const haptics::FlightRecord& record) {
  if (record.commands.trial != trial_ || !record.commands.armed) return;
  listener_.add(record);
  const bool two = X_ET_.size() == 2;
  if (record.tool == 0) first_ = toolIn(record, X_ET_[0]);
  if (two && record.tool == 0) return;
  const double t_s = listener_.seconds();
  if (!moments_.empty() && t_s - moments_.back().t_s < kMomentStep - 1e-9) return;
  moments_.push_back({t_s,
                      {first_, two ? toolIn(record, X_ET_[1]) : runtime::ToolState{}},
                      listener_.thing(record.commands),
                      listener_.now_N(),
                      listener_.touching()});
}

std::unique_ptr<TrialReplay> comparisonReplay(const ShownComparison& trial,
                                              scene::SceneView& view) {
  return std::make_unique<ComparisonReplay>(trial, view);
}

namespace {

class PulseReplay final : public TrialReplay {
 public:
  PulseReplay(const ShownPulse& trial, scene::SceneView& view)
      : TrialReplay(trial, trial.length_s()),
        recorded_(trial),
        scene_({stage(view), anatomy::X_AP()}, bus_, channels_) {}

 private:
  void showAt(double t_s, std::int64_t now_ns) override {
    const PulseMoment& moment = recorded_.moments[momentAt(recorded_.moments, t_s)];
    task_pulse::PulseStatus status;
    fill(status, t_s);
    status.part = moment.part;
    status.artery = recorded_.patient.name;
    status.count_left_s = moment.count_left_s;
    status.force_N = moment.force_N;
    status.mark_P = moment.mark_P;
    bus_.haptic_to_scene.publish(moment.tool, now_ns);
    channels_.status_to_scene.publish(status, now_ns);
  }

  trial::TrialScene& scene() override { return scene_; }

  const ShownPulse& recorded_;
  task_pulse::PulseChannels channels_{runtime::TimeMode::virtual_time};
  task_pulse::PulseScene scene_;
};

}  // namespace

PulseReader::PulseReader(const haptics::TickConfig& config, const assess::PulseRules& rules,
                         int trial)
    : X_ET_(unpack(config.X_ET)),
      count_s_(rules.count_s),
      listener_(config, rules),
      trial_(static_cast<std::uint32_t>(trial)) {
  listener_.begin(trial_);
}

void PulseReader::add(const haptics::FlightRecord& record) {
  if (record.commands.trial != trial_ || !record.commands.armed) return;
  listener_.add(record);
  const double t_s = listener_.seconds();
  if (!moments_.empty() && t_s - moments_.back().t_s < kMomentStep - 1e-9) return;
  moments_.push_back({t_s, toolIn(record, X_ET_), task_pulse::partIn(record.commands),
                      listener_.now_N(), std::max(count_s_ - listener_.countedSeconds(), 0.0),
                      listener_.mark_P()});
}

std::unique_ptr<TrialReplay> pulseReplay(const ShownPulse& trial, scene::SceneView& view) {
  return std::make_unique<PulseReplay>(trial, view);
}

}  // namespace palpa::replay
