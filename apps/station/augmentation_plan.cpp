#include "apps/station/task_sections.h"

#include <array>
#include <tuple>
#include <utility>

#include "anatomy/base/error.h"
#include "apps/station/station_file.h"
#include "apps/station/taken_away.h"
#include "haptics/flight_record.h"

namespace palpa::station {
namespace {

using haptics::Augmentation;
using haptics::AugmentationKind;
using haptics::Condition;
using haptics::Signal;

constexpr double kMilli = 1e-3;

template <typename Value, std::size_t N>
Value chosen(const JsonFile& file, const std::string& at,
             const std::array<std::pair<const char*, Value>, N>& known) {
  const std::string said = file.text(at);
  std::string all;
  for (const auto& [name, value] : known) {
    if (said == name) return value;
    all += (all.empty() ? "" : ", ") + std::string(name);
  }
  file.refuse(at, "is \"" + said + "\"; known: " + all);
}

Signal signalIn(const JsonFile& file) {
  const std::string said = file.text("cue");
  std::string all;
  for (int i = 1; i < haptics::kSignals; ++i) {
    const Signal signal = static_cast<Signal>(i);
    if (said == haptics::signalName(signal).name) return signal;
    all += (all.empty() ? "" : ", ") + std::string(haptics::signalName(signal).name);
  }
  file.refuse("cue", "is \"" + said + "\"; known: " + all);
}

/// "inserted" of the phases, "muscle" of the tissues: its number.
double countedIn(const JsonFile& file, Signal signal) {
  if (!file.json().at("is").is_string()) return file.number("is", 0, 255);
  const std::string said = file.text("is");
  static constexpr std::array<const char*, 3> kPhases{"outside", "indenting", "inserted"};
  if (signal == Signal::phase)
    for (std::size_t i = 0; i < kPhases.size(); ++i)
      if (said == kPhases[i]) return static_cast<double>(i);
  if (signal == Signal::tissue)
    for (int i = 0; i < kTissueCount; ++i)
      if (said == palpa::name(static_cast<Tissue>(i))) return i;
  file.refuse("is",
              "is \"" + said + "\", which \"" + haptics::signalName(signal).name + "\" never is");
}

/// A learned state that there is.
void needState(const JsonFile& file, const Condition& c, std::uint32_t states) {
  if (states == 0)
    file.refuse(
        "cue",
        "is \"learned\", but the task has no \"learned\": name what palpa calibrate subtasks made");
  if (c.compare != Condition::Compare::equal || c.threshold < 1 || c.threshold > states)
    file.refuse("cue", "is \"learned\": say beside it which state it \"is\", 1 to " +
                           std::to_string(states));
}

Condition conditionIn(const JsonFile& file, double hysteresis, std::uint32_t states) {
  constexpr double kLargest = 1e6;
  Condition c;
  c.signal = signalIn(file);
  c.hysteresis = hysteresis;
  const double unit = haptics::signalName(c.signal).si;
  if (file.has("at_least"))
    c.threshold = unit * file.number("at_least", -kLargest, kLargest);
  else if (file.has("below"))
    c.compare = Condition::Compare::below,
    c.threshold = unit * file.number("below", -kLargest, kLargest);
  else if (file.has("is"))
    c.compare = Condition::Compare::equal, c.threshold = countedIn(file, c.signal);
  else
    file.refuse("cue", "needs \"at_least\", \"below\" or \"is\" beside it");
  const auto milliseconds = [&](const char* key) {
    return file.has(key) ? file.integer(key, 0, 10'000) : 0;
  };
  c.hold_ms = static_cast<std::uint16_t>(milliseconds("hold_ms"));
  c.after_ms = static_cast<std::uint32_t>(milliseconds("after_ms"));
  if (c.signal == Signal::learned) needState(file, c, states);
  return c;
}

haptics::Subtask subtaskIn(const JsonFile& file, double hysteresis, std::uint32_t states) {
  haptics::Subtask subtask;
  const std::vector<JsonFile> conditions = file.entries("on");
  if (conditions.empty() || conditions.size() > haptics::kMostConditions)
    file.refuse("on", "must hold 1 to " + std::to_string(haptics::kMostConditions) + " conditions");
  for (const JsonFile& condition : conditions)
    subtask.conditions[subtask.count++] = conditionIn(condition, hysteresis, states);
  return subtask;
}

void readTrigger(const JsonFile& file, Augmentation* a) {
  using Trigger = Augmentation::Trigger;
  using Known = std::pair<const char*, std::pair<Trigger, std::uint32_t>>;
  static constexpr std::array<Known, 8> kTriggers{
      {{"begin", {Trigger::begin, 0}},
       {"rise", {Trigger::rise, 0}},
       {"bump", {Trigger::bump, 0}},
       {"skin_punctured", {Trigger::event, haptics::kSkinPunctured}},
       {"withdrawn", {Trigger::event, haptics::kWithdrawn}},
       {"wall_punctured", {Trigger::event, haptics::kWallPunctured}},
       {"bone_touched", {Trigger::event, haptics::kBoneTouched}},
       {"bone_left", {Trigger::event, haptics::kBoneLeft}}}};
  if (!file.has("trigger")) return;
  std::tie(a->trigger, a->events) = chosen(file, "trigger", kTriggers);
}

void readShape(const JsonFile& file, Augmentation* a, double* reach_U) {
  constexpr double kStrongest = 50;  // N
  switch (a->kind) {
    case AugmentationKind::none:
      return;
    case AugmentationKind::pulse:
      a->amplitude = file.number("force_N", 0, kStrongest);
      a->width_s = kMilli * file.number("width_ms", 1, 200);
      if (a->trigger == Augmentation::Trigger::none)
        file.refuse("kind", "is \"pulse\": say what triggers it, \"trigger\"");
      return;
    case AugmentationKind::vibration:
      a->amplitude = file.number("force_N", 0, kStrongest);
      if (file.has("wavelength_mm"))
        a->wavelength = kMilli * file.number("wavelength_mm", 0.01, 100);
      else
        a->frequency_Hz = file.number("frequency_Hz", 1, 500);
      if (a->trigger != Augmentation::Trigger::none)
        a->tau_s = kMilli * file.number("decay_ms", 1, 2000);
      else if (file.has("decay_ms"))
        file.refuse("decay_ms", "needs \"trigger\" beside it: after what does it decay?");
      return;
    case AugmentationKind::attraction:
      a->amplitude = file.number("force_N", 0, kStrongest);
      if (file.has("reach_U"))
        *reach_U = file.number("reach_U", 0.1, 1000);
      else
        a->reach = kMilli * file.number("reach_mm", 0.01, 100);
      return;
    case AugmentationKind::exaggeration:
      a->amplitude = file.number("times", 0, 5);
      a->tau_s = kMilli * file.number("tau_ms", 1, 2000);
      return;
    case AugmentationKind::relief:
      a->amplitude = file.number("force_N", 0, kStrongest);
      if (a->trigger != Augmentation::Trigger::none)
        file.refuse("trigger", "has no meaning for a relief: it is felt wherever a bump is");
      a->trigger = Augmentation::Trigger::bump;
      return;
    case AugmentationKind::fixture:
      a->amplitude = file.number("stiffness_N_per_m", 0, 1e4);
      if (file.has("reach_mm")) a->reach = kMilli * file.number("reach_mm", 0.01, 100);
      a->fades = file.flag("fades", false);
      return;
    case AugmentationKind::keep_out:
      a->amplitude = file.number("stiffness_N_per_m", 0, 1e4);
      a->fades = file.flag("fades", false);
      return;
    case AugmentationKind::steadying:
      a->amplitude = file.number("damping_Ns_per_m", 0, 100);
      a->from_Hz = file.number("from_Hz", 1, 50);
      a->to_Hz = file.number("to_Hz", 1, 100);
      if (a->to_Hz <= a->from_Hz) file.refuse("to_Hz", "must be more than from_Hz");
      return;
  }
}

Augmentation augmentationIn(const JsonFile& file, const NamedPlan& named, double* reach_U) {
  using Way = Augmentation::Way;
  static constexpr std::array<std::pair<const char*, AugmentationKind>, 8> kKinds{
      {{"pulse", AugmentationKind::pulse},
       {"vibration", AugmentationKind::vibration},
       {"attraction", AugmentationKind::attraction},
       {"exaggeration", AugmentationKind::exaggeration},
       {"fixture", AugmentationKind::fixture},
       {"relief", AugmentationKind::relief},
       {"keep_out", AugmentationKind::keep_out},
       {"steadying", AugmentationKind::steadying}}};
  static constexpr std::array<std::pair<const char*, Way>, 4> kWays{
      {{"up", Way::up},
       {"against_motion", Way::against_motion},
       {"along_tool", Way::along_tool},
       {"against_tool", Way::against_tool}}};
  Augmentation a;
  a.kind = chosen(file, "kind", kKinds);
  const bool heeds_way = a.kind == AugmentationKind::pulse ||
                         a.kind == AugmentationKind::vibration ||
                         a.kind == AugmentationKind::relief;
  if (heeds_way) a.way = chosen(file, "way", kWays);
  const std::string subtask = file.text("subtask");
  for (std::size_t i = 0; i < named.subtasks.size(); ++i)
    if (named.subtasks[i].name == subtask) a.subtask = static_cast<std::uint8_t>(i);
  if (a.subtask == haptics::kAnySubtask && subtask != "any")
    file.refuse("subtask", "is \"" + subtask + "\", which \"subtasks\" does not name");
  readTrigger(file, &a);
  if (a.trigger == Augmentation::Trigger::begin && a.subtask == haptics::kAnySubtask)
    file.refuse("trigger", "is \"begin\", but of no part: name one in \"subtask\"");
  if (file.has("blend_ms")) a.blend_s = kMilli * file.number("blend_ms", 0, 1000);
  readShape(file, &a, reach_U);
  return a;
}

}  // namespace

NamedPlan readPlan(const JsonFile& task) {
  NamedPlan named;
  if (!task.has("subtasks")) {
    if (task.has("augmentations"))
      task.refuse("augmentations", "needs \"subtasks\" beside it: in which parts of the task?");
    return named;
  }
  named.plan.learned = learnedIn(task);
  const double hysteresis = task.number("hysteresis", 0, 0.9);
  const std::vector<JsonFile> subtasks = task.entries("subtasks"),
                              augmentations = task.entries("augmentations");
  if (subtasks.size() > haptics::kMostSubtasks)
    task.refuse("subtasks", "holds more than " + std::to_string(haptics::kMostSubtasks));
  if (augmentations.size() > haptics::kMostAugmentations)
    task.refuse("augmentations", "holds more than " + std::to_string(haptics::kMostAugmentations));
  for (const JsonFile& subtask : subtasks) {
    named.subtasks.push_back({subtask.text("name"), subtask.text("means")});
    named.plan.subtasks.each[named.plan.subtasks.count++] =
        subtaskIn(subtask, hysteresis, named.plan.learned.states);
  }
  for (const JsonFile& augmentation : augmentations) {
    double reach_U = 0;
    named.plan.each[named.plan.count++] = augmentationIn(augmentation, named, &reach_U);
    named.augmentations.push_back({augmentation.text("name"), augmentation.text("means")});
    named.reach_U.push_back(reach_U);
  }
  named.limit_share = task.number("limit_share", 0, 1);
  return named;
}

haptics::AugmentationPlan onDevice(const NamedPlan& named, const Station& station, double unit) {
  haptics::AugmentationPlan plan = named.plan;
  plan.largest = named.limit_share * station.safety.max_force_N;
  plan.steepest = station.device.capabilities.stable_stiffness;
  constexpr double kSlowest_Hz = 1000;  // the least that any session runs at
  for (const SteadyingFigures& one : steadyingsOf(named, station, kSlowest_Hz))
    for (std::size_t i = 0; i < named.augmentations.size(); ++i)
      if (named.augmentations[i].name == one.name) plan.each[i].amplitude = one.band.damping;
  for (std::size_t i = 0; i < named.reach_U.size(); ++i) {
    if (named.reach_U[i] <= 0) continue;
    if (unit <= 0)
      throw UsageError("is given in units of a floor, and this task has none",
                       "augmentations/" + std::to_string(i) + "/reach_U", "Give reach_mm");
    plan.each[i].reach = unit * named.reach_U[i];
  }
  return plan;
}

}  // namespace palpa::station
