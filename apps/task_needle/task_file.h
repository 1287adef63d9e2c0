#pragma once

#include <filesystem>
#include <string>

#include "apps/assess/assess_trial.h"
#include "apps/station/augmentation_plan.h"
#include "apps/station/json_file.h"
#include "apps/station/taxonomy.h"

namespace palpa::task_needle {

/// A needle task as its file says it (assets/tasks/*.json). A new site needs a file, not code.
struct TaskSettings {
  std::string id, title;
  double time_limit_s = 300;
  assess::ScoringRules rules;
  std::filesystem::path expert_path;   ///< where the optimal path is
  std::filesystem::path materials;
  std::string source;                  ///< the file's text, for the evidence
  station::Taxonomy taxonomy;
  station::NamedPlan augmentations;    ///< empty: the task has no parts
};

/// Throws UsageError naming file and field.
TaskSettings readTask(const std::filesystem::path& file);

}  // namespace palpa::task_needle
