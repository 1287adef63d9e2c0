#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "anatomy/base/json_file.h"
#include "haptics/augmentation/augmentation.h"
#include "haptics/augmentation/learned_part.h"

namespace palpa::station {

struct Station;

/// Where a task stands among visual and haptic augmented realities, in words (Jeon, Choi & Harders
/// 2015, their section 2): its file's "taxonomy".
struct Taxonomy {
  std::string visual, haptic;  ///< how much of what is seen, of what is felt, is real
  std::string purpose;         ///< artificial recreation, or augmented perception
  std::string property;        ///< within a property or between properties
};

/// Throws UsageError naming a field that is missing.
Taxonomy taxonomyOf(const JsonFile& task);

/// What the trainee is to do, a short sentence: the file's "brief"; empty where it has none. Throws
/// UsageError for one that is no text, or longer than the screen has room for.
std::string briefOf(const JsonFile& task);

}  // namespace palpa::station

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

/// A part of a task, or what is added in it, by name and in words.
struct NamedPart {
  std::string name, means;
};

/// A task's parts and what is added to the force in each, as its file says it:
///   "subtasks": [{"name": "scan", "means": "...",
///                 "on": [{"cue": "floor_speed", "at_least": 468.75}]}]
///       each condition: a cue (haptics/augmentation/subtasks.h, in its unit) with "at_least",
///       "below" or "is" (a number, or the phase's or tissue's name)
///   "learned": a model that parts may be told by (learnedIn)
///   "hysteresis": 0.05: a part is off again so far below its thresholds
///   "augmentations": [{"name": "edge", "kind": "pulse", "subtask": "scan", "trigger": "rise",
///                      "way": "up", "force_N": 0.8, "width_ms": 10}]
///       kind: pulse, vibration (frequency_Hz or wavelength_mm, decay_ms), attraction (reach_mm or
///       reach_U), exaggeration (times, tau_ms), fixture (stiffness_N_per_m, reach_mm), keep_out
///       (stiffness_N_per_m), steadying (damping_Ns_per_m, from_Hz, to_Hz), relief (force_N, at
///       the highest bumps); "fades": true of fixture and keep_out: less as the trainee gets better
///       trigger: begin, rise, bump, or an event (skin_punctured, withdrawn, wall_punctured,
///       bone_touched, bone_left)
///       way (of pulse, vibration, relief): up, against_motion, along_tool, against_tool
///   "limit_share": 0.5 of the device's force, for all together
struct NamedPlan {
  haptics::AugmentationPlan plan;  ///< forces as in the file, for no device yet
  std::vector<NamedPart> subtasks, augmentations;
  double limit_share = 0.5;
  /// of each augmentation, where it is given in units of a floor; else 0
  std::vector<double> reach_U;
  bool empty() const { return subtasks.empty(); }
  std::vector<std::string> subtaskNames() const {
    std::vector<std::string> names;
    for (const NamedPart& part : subtasks) names.push_back(part.name);
    return names;
  }
};

/// Empty where the file names no "subtasks". Throws UsageError naming the field.
NamedPlan readPlan(const JsonFile& task);

/// The plan on a station: never more than its share of the force limit, nothing steeper than the
/// largest wall that the device holds, no steadying stronger than is passive (taken_away.h);
/// lengths in units of a floor become metres by `unit`. Throws
/// UsageError where there are some and `unit` is 0.
haptics::AugmentationPlan onDevice(const NamedPlan& named, const Station& station, double unit = 0);

}  // namespace palpa::station
