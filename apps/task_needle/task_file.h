#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "anatomy/base/json_file.h"
#include "anatomy/geometry/local_geometry.h"
#include "anatomy/geometry/pose.h"
#include "anatomy/patient.h"
#include "apps/assess/needle/assess_trial.h"
#include "apps/assess/needle/trial_assessment.h"
#include "apps/station/task_sections.h"

namespace palpa::task_needle {

/// What tissues and surfaces are called where the thing that is punctured is no patient:
///   "words": {"tissues": {"fat": "cancellous bone"}, "organs": {"skin": "bone"}}
/// Those not named keep their names.
struct TaskWords {
  std::array<std::string, kTissueCount> tissue;  ///< empty: its own name
  std::array<std::string, kOrganCount> organ;
  std::string of(Tissue t) const;
  std::string of(Organ o) const;
};

/// Throws UsageError for tissues and organs that there are not.
TaskWords wordsIn(const JsonFile& task);

/// What a trial is for, where no expert path is known: a part of the task to be in for a while.
///   "goal": {"part": "seated", "for_s": 1, "means": "the pin is seated in cancellous bone"}
struct Goal {
  std::size_t part = 0;  ///< of the task's subtasks
  double for_s = 0;      ///< at a stretch
  std::string means;
};

/// Follows a trial toward its goal, and tells its course: when which part was on, what was
/// punctured.
class GoalTrial {
 public:
  GoalTrial() = default;
  GoalTrial(const Goal& goal, std::vector<std::string> parts, const TaskWords& words)
      : goal_(goal), parts_(std::move(parts)), words_(words) {}

  void add(const assess::TrialSample& sample);  ///< every tick of the trial
  bool reached() const { return held_s_ >= goal_.for_s && in_goal_; }
  /// Of the parts that are on the last in the file; empty: none is.
  std::string step() const;
  /// Success and time, course, summary.
  void describe(assess::TrialAssessment* assessment) const;

 private:
  assess::Span spanOf(std::size_t part) const;  ///< that ends now

  Goal goal_;
  std::vector<std::string> parts_;
  TaskWords words_;
  std::uint32_t on_ = 0;
  bool in_goal_ = false;
  double held_s_ = 0, t_s_ = 0, deepest_ = 0;
  int punctures_ = 0;
  std::vector<double> since_s_;
  std::vector<assess::Span> spans_;
  std::vector<assess::Moment> moments_;
};

/// What is punctured where it is no patient: a block whose layers lie as a patient's do, entry in
/// the middle of its top.
struct PuncturedBlock {
  Vec3 size;  ///< m, x right, y away, z up
  anatomy::SoftLayers layers;
};

/// Needle passes after which the next one ends the trial; 0: no limit.
struct PassLimit {
  int assessed = 0, practice = 0;
};

/// An organ that a cue keeps the needle out of: a ball that touches it where it is nearest to the
/// target of the path, and `margin` around it.
struct KeepOutOrgan {
  Organ organ = Organ::none;
  double radius = 0, margin = 0;  ///< m
};

/// A needle task as its file says it (assets/tasks/*.json). A new site needs a file, not code. It
/// has an expert path ("expert_path", "scoring") or a goal of its own ("goal").
struct TaskSettings {
  std::string id, title, brief;
  double time_limit_s = 300;
  PassLimit most_passes;
  assess::ScoringRules rules;
  std::filesystem::path expert_path;  ///< where the expert path is; empty: there is none
  std::filesystem::path materials;
  std::string source;  ///< the file's text, for the evidence
  station::Taxonomy taxonomy;
  station::NamedPlan augmentations;     ///< empty: the task has no parts
  std::vector<KeepOutOrgan> keep_out;   ///< where a cue keeps out of something
  std::optional<Goal> goal;             ///< none: the vein
  std::optional<PuncturedBlock> block;  ///< none: a patient
  TaskWords words;
};

/// Throws UsageError naming file and field.
TaskSettings readTask(const std::filesystem::path& file);
/// The same from what was read of the file, as a recording holds it (with the model where the task
/// names one). Paths of other files are relative to `folder`; without one they stay as they stand.
TaskSettings readTask(const JsonFile& file, const std::filesystem::path& folder = {});

}  // namespace palpa::task_needle
