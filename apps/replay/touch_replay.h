#pragma once

#include <array>
#include <memory>
#include <optional>
#include <vector>

#include "apps/replay/trial_replay.h"
#include "apps/task_comparison/comparison_task.h"
#include "apps/task_palpation/palpation_task.h"
#include "apps/task_pulse/pulse_task.h"
#include "apps/task_search/search_task.h"
#include "apps/training/trial_clock.h"

namespace palpa::replay {

/// One in 10 ms of a palpation; so many samples were felt and marks made up to it.
struct PalpationMoment {
  double t_s = 0;                   ///< since the trial's start; pauses do not count
  runtime::ToolState tool, second;  ///< the second: of two tools
  std::size_t samples = 0, marks = 0;
};

/// A recorded palpation, ready to be shown at any moment. What lies inside is seen from the start:
/// who looks back may know it.
struct PalpationTrial : ShownTrial {
  assess::PalpationRules rules;
  double tip_radius = 0.008;             ///< m
  std::optional<Pose> X_AD2;             ///< the second device's base, of two
  bool estimated = false;                ///< what the second presses with is no sensor's
  std::optional<scene::SurfaceMap> map;  ///< of the phantom's stiffness
  std::vector<PalpationMoment> moments;  ///< not empty
  std::vector<assess::PalpationSample> samples;
  std::vector<assess::LumpMark> pressed;  ///< the lumps that were marked
  std::vector<task_palpation::SeenLump> lumps;
  double length_s() const { return moments.back().t_s; }
};

/// Takes a session's ticks in their order and keeps those of one trial.
class PalpationReader {
 public:
  PalpationReader(const haptics::TickConfig& config, const std::optional<haptics::PairConfig>& pair,
                  int trial);
  void add(const haptics::FlightRecord& record);
  double seconds() const { return listener_.seconds(); }
  void into(PalpationTrial& trial) const;  ///< moments, samples, marks

 private:
  Pose X_ET_;
  task_palpation::PalpationListener listener_;
  std::vector<PalpationMoment> moments_;
};

/// The trial and the view outlive what is answered.
std::unique_ptr<TrialReplay> palpationReplay(const PalpationTrial& trial, scene::SceneView& view);

struct SearchMoment {
  double t_s = 0;  ///< since the trial's start, the holding included; pauses do not count
  runtime::ToolState tool;
  bool held = false;
  double searched_s = 0;  ///< since the handle was let go
};

/// A recorded episode of a search, ready to be shown at any moment.
struct ShownSearch : ShownTrial {
  double side = 0.0144;               ///< m, of the floor in the hand
  double magnification = 10;          ///< of what is shown
  std::vector<SearchMoment> moments;  ///< not empty
  double length_s() const { return moments.back().t_s; }
};

/// Takes a session's ticks in their order and keeps of one trial a moment every 4 ms.
class SearchReader {
 public:
  SearchReader(const task_search::SearchSettings& task, const haptics::TickConfig& config,
               int trial);
  void add(const haptics::FlightRecord& record);
  const std::vector<SearchMoment>& moments() const { return moments_; }

 private:
  const haptics::TickConfig& config_;
  task_search::SearchListener listener_;
  std::uint32_t trial_;
  training::TrialClock clock_;
  std::vector<SearchMoment> moments_;
};

/// The trial and the view outlive what is answered.
std::unique_ptr<TrialReplay> searchReplay(const ShownSearch& trial, scene::SceneView& view);

struct ComparisonMoment {
  double t_s = 0;                           ///< since the trial's start; pauses do not count
  std::array<runtime::ToolState, 2> tools;  ///< the second: of two tools
  int thing = 0;                            ///< 0, 1, ...: which of them is felt
  double force_N = 0;
  bool touching = false;
};

/// A recorded comparison, ready to be shown at any moment.
struct ShownComparison : ShownTrial {
  std::optional<Pose> X_AD2;     ///< the second device's base, of two
  Vec3 middle_A = Vec3::Zero();  ///< of the object at rest, where something is held
  Vec3 up_A = Vec3(0, -1, 0);    ///< out of the surface that is stroked
  task_comparison::Comparison comparison;
  std::vector<ComparisonMoment> moments;  ///< not empty
  double length_s() const { return moments.back().t_s; }
};

/// Takes the ticks of one tool or both in their order and keeps of one trial a moment every 4 ms.
class ComparisonReader {
 public:
  /// `X_ET`: of each tool.
  ComparisonReader(double touch_N, const std::vector<Pose>& X_ET,
                   const task_comparison::Comparison& comparison, int trial);
  void add(const haptics::FlightRecord& record);
  const std::vector<ComparisonMoment>& moments() const { return moments_; }

 private:
  std::vector<Pose> X_ET_;
  task_comparison::ComparisonListener listener_;
  std::uint32_t trial_;
  runtime::ToolState first_;
  std::vector<ComparisonMoment> moments_;
};

/// The trial and the view outlive what is answered.
std::unique_ptr<TrialReplay> comparisonReplay(const ShownComparison& trial, scene::SceneView& view);

struct PulseMoment {
  double t_s = 0;  ///< since the trial's start; pauses do not count
  runtime::ToolState tool;
  task_pulse::PulsePart part = task_pulse::PulsePart::none;
  double force_N = 0, count_left_s = 0;
  std::optional<Vec3> mark_P;
};

/// A recorded examination of a pulse, ready to be shown at any moment.
struct ShownPulse : ShownTrial {
  task_pulse::PulseCase patient;
  std::vector<PulseMoment> moments;  ///< not empty
  double length_s() const { return moments.back().t_s; }
};

/// Takes a session's ticks in their order and keeps of one trial a moment every 4 ms.
class PulseReader {
 public:
  PulseReader(const haptics::TickConfig& config, const assess::PulseRules& rules, int trial);
  void add(const haptics::FlightRecord& record);
  const std::vector<PulseMoment>& moments() const { return moments_; }

 private:
  Pose X_ET_;
  double count_s_;
  task_pulse::PulseListener listener_;
  std::uint32_t trial_;
  std::vector<PulseMoment> moments_;
};

/// The trial and the view outlive what is answered.
std::unique_ptr<TrialReplay> pulseReplay(const ShownPulse& trial, scene::SceneView& view);

}  // namespace palpa::replay
