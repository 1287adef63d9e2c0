#pragma once

#include <filesystem>

#include "apps/station/json_file.h"
#include "haptics/augmentation/learned_part.h"

/// Parts of a task that were learned from recordings: a task's file names what `palpa calibrate
/// subtasks` left,
///   "learned": "../parts/calibration.json"
/// and the conditions of its parts may ask for one of its states, numbered as the page shows them:
/// {"cue": "learned", "is": 2}.
namespace palpa::station {

/// A task's file with the model itself where it named one, so that a recording has it whole. Paths
/// are relative to the task's file. Throws UsageError or Error: no such file, damaged, not of this
/// kind, one whose states do not repeat.
JsonFile readTaskFile(const std::filesystem::path& path);

/// No states where the task has no "learned". Throws UsageError naming the field.
haptics::LearnedModel learnedIn(const JsonFile& task);

}  // namespace palpa::station
