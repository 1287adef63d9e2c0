#include "apps/task_needle/task_file.h"

#include "apps/station/learned_model.h"

namespace palpa::task_needle {
namespace {

/// A penalty an error: never a reward.
double weight(const station::JsonFile& file, const char* field) { return file.number(field, 0, 1e6); }

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
  task.rules = readRules(file);
  task.expert_path = path.parent_path() / file.text("expert_path");
  task.materials = path.parent_path() / file.text("materials");
  task.source = file.json().dump();
  task.augmentations = station::readPlan(file);
  if (file.has("taxonomy")) task.taxonomy = station::taxonomyOf(file);   // older recordings carry none
  return task;
}

}  // namespace palpa::task_needle
