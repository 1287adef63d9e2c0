#include "apps/task_needle/task_file.h"

#include "apps/station/learned_model.h"

namespace palpa::task_needle {
namespace {

/// A penalty an error: never a reward.
double weight(const station::JsonFile& file, const char* field) {
  return file.number(field, 0, 1e6);
}

assess::ScoringRules readRules(const station::JsonFile& file) {
  assess::ScoringRules rules;
  rules.sample_rate_Hz = file.number("scoring/sample_rate_Hz", 1, 1000);
  rules.clavicle_guide_N = file.number("scoring/clavicle_guide_N", 0, 100);
  rules.dwell_s = file.number("scoring/dwell_s", 0, 60);
  rules.plunger_drawn = file.number("scoring/plunger_drawn", 0, 1);
  rules.shaft_point = 1e-3 * file.number("scoring/shaft_point_mm", 0, 200);
  assess::ScoreWeights& w = rules.weights;
  w.lung = weight(file, "scoring/weights/COL_LUNG");
  w.rib = weight(file, "scoring/weights/COL_RIB");
  w.artery = weight(file, "scoring/weights/COL_ART");
  w.vein = weight(file, "scoring/weights/COL_VEIN");
  w.phase_1 = weight(file, "scoring/weights/PHASE_1");
  w.phase_2_low = weight(file, "scoring/weights/PHASE_2_below_1000");
  w.phase_2_middle = weight(file, "scoring/weights/PHASE_2_below_2000");
  w.phase_2_high = weight(file, "scoring/weights/PHASE_2_from_2000");
  w.econ_mean = weight(file, "scoring/weights/ECON_MEAN");
  w.econ_var = weight(file, "scoring/weights/ECON_VAR");
  w.time = weight(file, "scoring/weights/TIME");
  return rules;
}

constexpr double kFileMm = 1e-3;
constexpr double kFileDeg = 0.017453292519943295;

/// Recordings made before the errors were named carry no figures for them: the usual ones.
assess::ErrorRules readErrors(const station::JsonFile& file) {
  assess::ErrorRules rules;
  if (!file.has("errors")) return rules;
  rules.site_off = kFileMm * file.number("errors/site_off_mm", 1, 100);
  rules.landmark_off = kFileMm * file.number("errors/landmark_off_mm", 1, 100);
  rules.too_shallow = kFileDeg * file.number("errors/too_shallow_deg", 1, 90);
  rules.too_cephalad = kFileDeg * file.number("errors/too_cephalad_deg", 1, 90);
  rules.too_caudal = kFileDeg * file.number("errors/too_caudal_deg", 1, 90);
  rules.aim_travel = kFileMm * file.number("errors/aim_travel_mm", 0, 50);
  rules.periosteum_N = file.number("errors/periosteum_N", 0, 100);
  rules.periosteum_s = file.number("errors/periosteum_s", 0, 10);
  rules.blood_s = file.number("errors/blood_s", 0, 10);
  return rules;
}

Goal goalIn(const station::JsonFile& file, const station::NamedPlan& parts) {
  Goal goal;
  const std::string part = file.text("goal/part");
  while (goal.part < parts.subtasks.size() && parts.subtasks[goal.part].name != part) ++goal.part;
  if (goal.part == parts.subtasks.size())
    file.refuse("goal/part", "is \"" + part + "\", which \"subtasks\" does not name");
  goal.for_s = file.number("goal/for_s", 0, 60);
  goal.means = file.text("goal/means");
  return goal;
}

PuncturedBlock blockIn(const station::JsonFile& file) {
  const auto mm = [&](const std::string& field, double low, double high) {
    return kFileMm * file.number("phantom/" + field, low, high);
  };
  return {{mm("across_mm", 20, 500), mm("away_mm", 20, 500), mm("high_mm", 20, 300)},
          {mm("layers/skin_mm", 0.1, 100), mm("layers/fat_mm", 0, 200),
           mm("layers/muscle_mm", 0, 200)}};
}

}  // namespace

TaskSettings readTask(const std::filesystem::path& path) {
  const station::JsonFile file = station::readTaskFile(path);
  file.needVersion(1);
  if (const std::string engine = file.text("engine"); engine != "needle")
    file.refuse("engine", "is \"" + engine + "\"; known: needle");
  TaskSettings task;
  task.id = file.text("id");
  task.title = file.text("title");
  task.time_limit_s = file.number("end/time_limit_s", 1, 3600);
  if (file.has("end/most_passes"))
    task.most_passes = {file.integer("end/most_passes/assessed", 0, 100),
                        file.integer("end/most_passes/practice", 0, 100)};
  task.materials = path.parent_path() / file.text("materials");
  task.source = file.json().dump();
  task.augmentations = station::readPlan(file);
  task.words = wordsIn(file);
  if (file.has("phantom")) task.block = blockIn(file);
  if (task.block && !file.has("goal"))
    file.refuse("phantom", "needs \"goal\" beside it: no optimal path leads through a block");
  if (file.has("goal")) {
    task.goal = goalIn(file, task.augmentations);
  } else {
    task.rules = readRules(file);
    task.rules.errors = readErrors(file);
    task.expert_path = path.parent_path() / file.text("expert_path");
  }
  if (file.has("taxonomy"))
    task.taxonomy = station::taxonomyOf(file);  // older recordings carry none
  return task;
}

}  // namespace palpa::task_needle
