#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "anatomy/patient.h"
#include "apps/assess/assess_trial.h"
#include "apps/station/augmentation_plan.h"
#include "apps/station/json_file.h"
#include "apps/station/taxonomy.h"
#include "apps/task_needle/goal.h"
#include "apps/task_needle/task_words.h"

namespace palpa::task_needle {

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

/// A needle task as its file says it (assets/tasks/*.json). A new site needs a file, not code. It
/// has an optimal path ("expert_path", "scoring") or a goal of its own ("goal").
struct TaskSettings {
  std::string id, title;
  double time_limit_s = 300;
  PassLimit most_passes;
  assess::ScoringRules rules;
  std::filesystem::path expert_path;  ///< where the optimal path is; empty: there is none
  std::filesystem::path materials;
  std::string source;  ///< the file's text, for the evidence
  station::Taxonomy taxonomy;
  station::NamedPlan augmentations;     ///< empty: the task has no parts
  std::optional<Goal> goal;             ///< none: the vein
  std::optional<PuncturedBlock> block;  ///< none: a patient
  TaskWords words;
};

/// Throws UsageError naming file and field.
TaskSettings readTask(const std::filesystem::path& file);

}  // namespace palpa::task_needle
