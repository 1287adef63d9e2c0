#include "apps/task_needle/task_file.h"

#include <algorithm>
#include <cmath>

#include <nlohmann/json.hpp>

#include "anatomy/base/enum_names.h"
#include "anatomy/base/file_schema.h"
#include "anatomy/base/units.h"
#include "apps/station/task_sections.h"
#include "apps/training/engine.h"
#include "haptics/flight_record.h"

namespace palpa::task_needle {
namespace {

template <typename Thing, std::size_t N>
void readNames(const JsonFile& task, const std::string& group, std::array<std::string, N>* words) {
  if (!task.has("words/" + group)) return;
  for (const auto& [key, value] : task.json().at("words").at(group).items()) {
    std::size_t i = 0;
    while (i < N && key != name(static_cast<Thing>(i))) ++i;
    if (i == N) task.refuse("words/" + group + "/" + key, "names something that does not exist");
    (*words)[i] = task.text("words/" + group + "/" + key);
  }
}

}  // namespace

std::string TaskWords::of(Tissue t) const {
  const std::string& own = tissue[static_cast<std::size_t>(t)];
  if (!own.empty()) return own;
  return t == Tissue::connective ? "connective tissue" : name(t);
}

std::string TaskWords::of(Organ o) const {
  const std::string& own = organ[static_cast<std::size_t>(o)];
  return own.empty() ? name(o) : own;
}

TaskWords wordsIn(const JsonFile& task) {
  TaskWords words;
  readNames<Tissue>(task, "tissues", &words.tissue);
  readNames<Organ>(task, "organs", &words.organ);
  return words;
}

assess::Span GoalTrial::spanOf(std::size_t part) const {
  return {parts_[part], part == goal_.part ? assess::SpanKind::good : assess::SpanKind::guide,
          since_s_[part], t_s_};
}

void GoalTrial::add(const assess::TrialSample& sample) {
  const std::uint32_t on = sample.subtasks;
  since_s_.resize(parts_.size());
  const bool in_goal = on >> goal_.part & 1u;
  held_s_ = in_goal && in_goal_ ? held_s_ + sample.t_s - t_s_ : 0;
  in_goal_ = in_goal;
  t_s_ = sample.t_s;
  deepest_ = std::max(deepest_, sample.depth);
  for (std::size_t i = 0; i < parts_.size(); ++i) {
    const bool is = on >> i & 1u, was = on_ >> i & 1u;
    if (is && !was) since_s_[i] = t_s_;
    if (was && !is) spans_.push_back(spanOf(i));
  }
  on_ = on;
  if (sample.events & haptics::kSkinPunctured) {
    ++punctures_;
    moments_.push_back({t_s_, "puncture", "Through the surface of the " + words_.of(Organ::skin)});
  }
  if (sample.events & haptics::kWallPunctured && sample.wall != Organ::none)
    moments_.push_back({t_s_, "bone", "Through the " + words_.of(sample.wall)});
}

std::string GoalTrial::step() const {
  for (std::size_t i = parts_.size(); i-- > 0;)
    if (on_ >> i & 1u) return parts_[i];
  return {};
}

void GoalTrial::describe(assess::TrialAssessment* a) const {
  a->by_path = false;
  a->values.success = reached();
  a->values.time_ms = std::round(1e3 * t_s_);
  a->skin_punctures = punctures_;
  a->spans = spans_;
  for (std::size_t i = 0; i < since_s_.size(); ++i)
    if (on_ >> i & 1u) a->spans.push_back(spanOf(i));
  a->moments = moments_;
  if (a->values.success) a->moments.push_back({t_s_, "success", "Done: " + goal_.means});
  const std::string after = std::to_string(std::lround(t_s_)) + " s",
                    deepest = std::to_string(std::lround(1e3 * deepest_)) + " mm";
  a->summary = (a->values.success ? "Done after " + after + ": " + goal_.means
                                  : "Not done after " + after + "; the goal: " + goal_.means) +
               ". It went " + deepest + " deep at most.";
}

namespace {

/// A penalty an error: never a reward.
double weight(const JsonFile& file, const char* field) { return file.number(field, 0, 1e6); }

const EnumNames<assess::BoneUnit> kBoneUnits{"samples", "contacts"};
const EnumNames<assess::Phase2Weight> kPhase2Weights{"steps", "continuous"};

/// Recordings made before rules had names say nothing of them: those of then.
void readVersion(const JsonFile& file, assess::ScoringRules* rules) {
  if (!file.has("scoring/rules")) {
    for (const char* newer :
         {"scoring/COL_RIB_counts", "scoring/PHASE_2_weight", "scoring/told_within_s"})
      if (file.has(newer)) file.refuse(newer, "needs a name of the rules beside it, \"rules\"");
    return;
  }
  rules->version = file.text("scoring/rules");
  rules->bone_unit = kBoneUnits.in(file, "scoring/COL_RIB_counts");
  rules->weights.phase_2 = kPhase2Weights.in(file, "scoring/PHASE_2_weight");
  if (file.has("scoring/told_within_s"))
    rules->told_within_s = file.number("scoring/told_within_s", 1, 300);
}

assess::ScoringRules readRules(const JsonFile& file) {
  assess::ScoringRules rules;
  readVersion(file, &rules);
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

/// Recordings made before the errors were named carry no figures for them: the usual ones.
assess::ErrorRules readErrors(const JsonFile& file) {
  assess::ErrorRules rules;
  if (!file.has("errors")) return rules;
  rules.site_off = kMm * file.number("errors/site_off_mm", 1, 100);
  rules.landmark_off = kMm * file.number("errors/landmark_off_mm", 1, 100);
  rules.too_shallow = kDegree * file.number("errors/too_shallow_deg", 1, 90);
  rules.too_cephalad = kDegree * file.number("errors/too_cephalad_deg", 1, 90);
  rules.too_caudal = kDegree * file.number("errors/too_caudal_deg", 1, 90);
  rules.aim_travel = kMm * file.number("errors/aim_travel_mm", 0, 50);
  rules.periosteum_N = file.number("errors/periosteum_N", 0, 100);
  rules.periosteum_s = file.number("errors/periosteum_s", 0, 10);
  rules.blood_s = file.number("errors/blood_s", 0, 10);
  return rules;
}

Goal goalIn(const JsonFile& file, const station::NamedPlan& parts) {
  Goal goal;
  const std::string part = file.text("goal/part");
  while (goal.part < parts.subtasks.size() && parts.subtasks[goal.part].name != part) ++goal.part;
  if (goal.part == parts.subtasks.size())
    file.refuse("goal/part", "is \"" + part + "\", which \"subtasks\" does not name");
  goal.for_s = file.number("goal/for_s", 0, 60);
  goal.means = file.text("goal/means");
  return goal;
}

/// "keep_out": [{"organ": "lung", "ball_mm": 30, "margin_mm": 3}]
std::vector<KeepOutOrgan> keepOutIn(const JsonFile& file, const station::NamedPlan& parts) {
  std::vector<KeepOutOrgan> all;
  const haptics::AugmentationPlan& plan = parts.plan;
  const bool wall =
      std::any_of(plan.each.begin(), plan.each.begin() + plan.count,
                  [](const auto& a) { return a.kind == haptics::AugmentationKind::keep_out; });
  if (wall != file.has("keep_out"))
    file.refuse("keep_out", wall ? "is missing: name the organs that the augmentation keeps out of"
                                 : "needs an augmentation of this kind beside it");
  if (!wall) return all;
  for (const JsonFile& one : file.entries("keep_out")) {
    const std::string name = one.text("organ");
    KeepOutOrgan organ{Organ::none, kMm * one.number("ball_mm", 1, 200),
                       kMm * one.number("margin_mm", 0, 50)};
    for (int i = 1; i < kOrganCount; ++i)
      if (name == palpa::name(static_cast<Organ>(i))) organ.organ = static_cast<Organ>(i);
    if (organ.organ == Organ::none) one.refuse("organ", "is \"" + name + "\", which is none");
    all.push_back(organ);
  }
  if (all.empty() || all.size() > haptics::kMostKeptOut)
    file.refuse("keep_out", "must name 1 or " + std::to_string(haptics::kMostKeptOut) + " organs");
  return all;
}

PuncturedBlock blockIn(const JsonFile& file) {
  const auto mm = [&](const std::string& field, double low, double high) {
    return kMm * file.number("phantom/" + field, low, high);
  };
  return {{mm("across_mm", 20, 500), mm("away_mm", 20, 500), mm("high_mm", 20, 300)},
          {mm("layers/skin_mm", 0.1, 100), mm("layers/fat_mm", 0, 200),
           mm("layers/muscle_mm", 0, 200)}};
}

}  // namespace

TaskSettings readTask(const std::filesystem::path& path) {
  const JsonFile file = station::readTaskFile(path);
  training::needEngine(file, training::Engine::needle);
  needKind(file, "task_needle", 1);
  return readTask(file, path.parent_path());
}

TaskSettings readTask(const JsonFile& file, const std::filesystem::path& folder) {
  file.needVersion(1);
  training::needEngine(file, training::Engine::needle);
  TaskSettings task;
  task.id = file.text("id");
  task.title = file.text("title");
  task.brief = station::briefOf(file);
  task.time_limit_s = file.number("end/time_limit_s", 1, 3600);
  if (file.has("end/most_passes"))
    task.most_passes = {file.integer("end/most_passes/assessed", 0, 100),
                        file.integer("end/most_passes/practice", 0, 100)};
  task.materials = folder / file.text("materials");
  task.source = file.json().dump();
  task.augmentations = station::readPlan(file);
  task.words = wordsIn(file);
  if (file.has("phantom")) task.block = blockIn(file);
  if (task.block && !file.has("goal"))
    file.refuse("phantom", "needs \"goal\" beside it: no expert path leads through a block");
  if (file.has("goal")) {
    task.goal = goalIn(file, task.augmentations);
  } else {
    task.keep_out = keepOutIn(file, task.augmentations);
    task.rules = readRules(file);
    task.rules.errors = readErrors(file);
    task.expert_path = folder / file.text("expert_path");
  }
  if (file.has("taxonomy"))
    task.taxonomy = station::taxonomyOf(file);  // older recordings carry none
  return task;
}

}  // namespace palpa::task_needle
