#include <algorithm>

#include <nlohmann/json.hpp>

#include "apps/record/force_columns.h"
#include "apps/runtime/flight_sink.h"

namespace palpa::record {
namespace {

using haptics::Augmentation;
using nlohmann::json;

const char* kindWord(haptics::AugmentationKind kind) {
  static constexpr const char* kWords[] = {"none",       "pulse",        "vibration",
                                           "attraction", "exaggeration", "fixture",
                                           "relief",     "keep_out",     "steadying"};
  const auto index = static_cast<std::size_t>(kind);
  return index < std::size(kWords) ? kWords[index] : "?";
}

const char* triggerWord(Augmentation::Trigger trigger) {
  static constexpr const char* kWords[] = {"none", "begin", "event", "rise", "bump"};
  const auto index = static_cast<std::size_t>(trigger);
  return index < std::size(kWords) ? kWords[index] : "?";
}

const char* wayWord(Augmentation::Way way) {
  static constexpr const char* kWords[] = {"up", "against_motion", "along_tool", "against_tool"};
  const auto index = static_cast<std::size_t>(way);
  return index < std::size(kWords) ? kWords[index] : "?";
}

const char* compareWord(haptics::Condition::Compare compare) {
  static constexpr const char* kWords[] = {"at_least", "below", "equal"};
  const auto index = static_cast<std::size_t>(compare);
  return index < std::size(kWords) ? kWords[index] : "?";
}

json jsonOf(const haptics::Condition& condition) {
  return {{"signal", haptics::signalName(condition.signal).name},
          {"compare", compareWord(condition.compare)},
          {"threshold", condition.threshold},
          {"hysteresis", condition.hysteresis},
          {"hold_ms", condition.hold_ms},
          {"after_ms", condition.after_ms}};
}

json partOf(const haptics::Subtask& part, const NamedForExport& named) {
  json conditions = json::array();
  for (std::size_t i = 0; i < std::min<std::size_t>(part.count, part.conditions.size()); ++i)
    conditions.push_back(jsonOf(part.conditions[i]));
  return {{"name", named.name}, {"means", named.means}, {"on", conditions}};
}

/// Figures of the plan as the device had it; those that a kind has no use for are 0 or as by
/// default.
json cueOf(const Augmentation& cue, const NamedForExport& named, const std::string& column) {
  json told{{"name", named.name},
            {"column", column},
            {"means", named.means},
            {"kind", kindWord(cue.kind)},
            {"trigger", triggerWord(cue.trigger)},
            {"way", wayWord(cue.way)},
            {"amplitude", cue.amplitude},
            {"width_s", cue.width_s},
            {"frequency_Hz", cue.frequency_Hz},
            {"wavelength_m", cue.wavelength},
            {"reach_m", cue.reach},
            {"tau_s", cue.tau_s},
            {"blend_s", cue.blend_s},
            {"band_Hz", {cue.from_Hz, cue.to_Hz}},
            {"fades", cue.fades != 0}};
  if (cue.subtask != haptics::kAnySubtask) told["part"] = cue.subtask;  // from 0
  return told;
}

json jsonOf(const haptics::FloorGains& gains) {
  return {{"stiffness_N_per_m", gains.stiffness}, {"damping_Ns_per_m", gains.damping}};
}

/// Every episode as its event says it, by the trial's number.
json episodesIn(const SessionReader& reader) {
  json episodes = json::object();
  for (const runtime::Event& event : reader.events()) {
    if (!event.is(runtime::EventKind::trial_case)) continue;
    const json said = json::parse(event.text, nullptr, false);
    if (!said.is_discarded()) episodes[std::to_string(event.trial)] = said;
  }
  return episodes;
}

json floorOf(const SessionReader& reader) {
  const haptics::TickConfig& config = reader.info().tick_config;
  const json task = json::parse(reader.info().task_json, nullptr, false);
  json floor{{"unit_m", config.floor.unit},
             {"real", jsonOf(config.floor.real)},
             {"degraded", jsonOf(config.floor.degraded)},
             {"handle_N", config.floor.weight_N},
             {"X_DF", {{"p_m", config.X_DF.p}, {"q_wxyz", config.X_DF.q}}},
             {"episodes", episodesIn(reader)}};
  if (task.is_object() && task.contains("stimulus")) floor["stimulus"] = task["stimulus"];
  return floor;
}

}  // namespace

nlohmann::json cueLaws(const SessionReader& reader) {
  const SessionInfo& info = reader.info();
  const haptics::TickConfig& config = info.tick_config;
  const haptics::AugmentationPlan& plan = config.augmentations;
  const TaskNames names = namesIn(info);
  json parts = json::array(), cues = json::array();
  for (std::size_t i = 0; i < names.parts.size(); ++i)
    parts.push_back(partOf(plan.subtasks.each[i], names.parts[i]));
  for (std::size_t i = 0; i < names.cues.size(); ++i)
    cues.push_back(cueOf(plan.each[i], names.cues[i], cueColumn(i)));
  json laws{{"period_s", 1e-9 * static_cast<double>(config.period_ns)},
            {"adds_up", addsUp(info)},
            {"limits",
             {{"force_N", config.safety.max_force_N},
              {"slew_N_per_s", config.safety.max_slew_N_per_s},
              {"continuous_N", config.safety.continuous_force_N},
              {"thermal_tau_s", config.safety.thermal_tau},
              {"coupling_N_per_m", config.coupling.stiffness}}},
            {"parts", parts},
            {"cues", cues},
            {"cues_largest_N", plan.largest},
            {"cues_steepest_N_per_m", plan.steepest}};
  if (config.contact_mode == haptics::ContactMode::floor) laws["floor"] = floorOf(reader);
  return laws;
}

}  // namespace palpa::record
