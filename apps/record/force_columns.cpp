#include "apps/record/force_columns.h"

#include <algorithm>
#include <charconv>

#include <nlohmann/json.hpp>

namespace palpa::record {
namespace {

using haptics::ContactMode;
using haptics::FlightRecord;
using haptics::TickForces;
using nlohmann::json;

/// A force of which another one is made.
struct ForcePart {
  const char* name;
  const char* meaning;
  Vec3 TickForces::*force;
};
bool touchesReal(const SessionInfo& info) {
  return info.tick_config.contact_mode == ContactMode::sensed_object;
}

bool onFloor(const SessionInfo& info) {
  return info.tick_config.contact_mode == ContactMode::floor;
}

/// Forces of the contact that there can be in the session.
std::vector<ForcePart> contactParts(const SessionInfo& info) {
  if (!touchesReal(info))
    return {{"f_body_D", "of a virtual body on the tool: patient or floor", &TickForces::body}};
  const haptics::TouchAugmentation& touch = info.tick_config.touch;
  const bool squeezing = info.pair_config && info.pair_config->squeezing;
  const bool lumps = !squeezing && touch.kinds[0].l0 > 0;
  std::vector<ForcePart> parts{
      {"f_stiffness_D", "added: another stiffness than the real object's", &TickForces::stiffness}};
  const auto add = [&parts](bool there, const ForcePart& part) {
    if (there) parts.push_back(part);
  };
  add(touch.other_friction,
      {"f_friction_D", "added: another friction than the real surface's", &TickForces::friction});
  add(squeezing,
      {"f_weight_D", "added: another weight than that of what is squeezed", &TickForces::weight});
  add(lumps && !info.pair_config,
      {"f_taken_D", "added: takes a real lump away", &TickForces::taken});
  add(touch.texture.speeds > 0, {"f_texture_D", "added: texture", &TickForces::texture});
  add(lumps, {"f_lumps_D", "added: virtual lumps, with what they add to the friction",
              &TickForces::lumps});
  return parts;
}

/// Besides the augmentations.
std::vector<ForcePart> pulseParts(const SessionInfo& info) {
  if (!touchesReal(info) || info.pair_config) return {};
  return {{"f_pulse_D", "added: an artery's pulse", &TickForces::pulse}};
}

/// What is wanted besides contact and augmentations.
std::vector<ForcePart> wantedParts(const SessionInfo& info) {
  std::vector<ForcePart> parts{{"f_damping_D", "of the passivity control", &TickForces::damping}};
  if (onFloor(info))
    parts.push_back(
        {"f_held_D", "carries the handle, or holds it where an episode starts", &TickForces::held});
  return parts;
}

template <typename Vector>
void addThree(std::vector<ForceColumn>& columns, const std::string& name, const std::string& unit,
              const std::string& meaning, Vector of) {
  for (int i = 0; i < 3; ++i)
    columns.push_back(
        {{name + '_' + "xyz"[i] + (unit.empty() ? "" : '_' + unit), meaning},
         [of, i](const FlightRecord& r, const TickForces& f) { return shortest(of(r, f)[i]); }});
}

void addPart(std::vector<ForceColumn>& columns, const ForcePart& part) {
  addThree(columns, part.name, "N", part.meaning,
           [force = part.force](const FlightRecord&, const TickForces& f) { return f.*force; });
}

void addMember(std::vector<ForceColumn>& columns, const char* name, const char* unit,
               const char* meaning, Vec3 TickForces::*member) {
  addThree(columns, name, unit, meaning,
           [member](const FlightRecord&, const TickForces& f) { return f.*member; });
}

void addNumber(std::vector<ForceColumn>& columns, const char* name, const char* meaning,
               double TickForces::*member) {
  columns.push_back({{name, meaning}, [member](const FlightRecord&, const TickForces& f) {
                       return shortest(f.*member);
                     }});
}

void addEachCue(std::vector<ForceColumn>& columns, const SessionInfo& info) {
  const std::vector<NamedForExport> cues = namesIn(info).cues;
  for (std::size_t i = 0; i < cues.size(); ++i)
    addThree(columns, cueColumn(i), "N", "added: the cue " + cues[i].name + ", " + cues[i].means,
             [i](const FlightRecord&, const TickForces& f) { return f.cues[i]; });
}

bool hasCue(const SessionInfo& info, haptics::AugmentationKind kind) {
  const haptics::AugmentationPlan& plan = info.tick_config.augmentations;
  return std::any_of(plan.each.begin(), plan.each.end(),
                     [kind](const haptics::Augmentation& a) { return a.kind == kind; });
}

/// Where the cues were: what they follow from.
void addPlaces(std::vector<ForceColumn>& columns, const SessionInfo& info) {
  if (info.tick_config.augmentations.count > 0)
    addMember(columns, "up_D", "", "unit: the way of cues that push up", &TickForces::up);
  if (hasCue(info, haptics::AugmentationKind::fixture))
    addMember(columns, "to_line_D", "m", "to a guide's line, across it; 0: no line",
              &TickForces::to_line);
  if (hasCue(info, haptics::AugmentationKind::keep_out))
    addMember(columns, "out_of_D", "m", "the way out of regions to be kept out of",
              &TickForces::out_of);
  if (!onFloor(info)) return;
  addMember(columns, "on_floor", "U", "the probe in the floor's frame", &TickForces::on_floor_U);
  addNumber(columns, "footprint", "height of the bump under the probe, of the highest bump's",
            &TickForces::footprint);
  addMember(columns, "to_valley_D", "m", "to the nearest valley of the floor; 0: none is near",
            &TickForces::to_valley);
  addNumber(columns, "valley_radius_U", "of curvature across it; 0: none is near",
            &TickForces::valley_radius_U);
}

/// Of a real object as it was felt.
void addFelt(std::vector<ForceColumn>& columns, const SessionInfo& info) {
  if (!touchesReal(info)) return;
  const haptics::TouchAugmentation& touch = info.tick_config.touch;
  addMember(columns, "normal_D", "", "unit, outward, of the real surface, as estimated",
            &TickForces::normal);
  if (touch.other_friction || touch.texture.speeds > 0)
    addMember(columns, "slid_D", "m", "how far the tip slid over it in this tick",
              &TickForces::slid);
}

json namesOf(const std::vector<ForcePart>& parts) {
  json names = json::array();
  for (const ForcePart& part : parts) names.push_back(part.name);
  return names;
}

/// As a recorded plan says, which may be damaged.
std::size_t atMost(std::uint32_t count, int most) {
  return std::min(count, static_cast<std::uint32_t>(most));
}

std::vector<NamedForExport> namesUnder(const json& task, const char* key, std::size_t count) {
  std::vector<NamedForExport> names;
  const json list = task.is_object() ? task.value(key, json::array()) : json::array();
  for (std::size_t i = 0; i < count; ++i) {
    const json entry = i < list.size() && list[i].is_object() ? list[i] : json::object();
    names.push_back({entry.value("name", std::to_string(i + 1)), entry.value("means", "")});
  }
  return names;
}

}  // namespace

std::string shortest(double value) {
  char text[32];
  return {text, std::to_chars(text, text + sizeof(text), value).ptr};
}

std::string cueColumn(std::size_t i) { return "f_cue_" + std::to_string(i + 1) + "_D"; }

TaskNames namesIn(const SessionInfo& info) {
  const json task = json::parse(info.task_json, nullptr, false);
  const haptics::AugmentationPlan& plan = info.tick_config.augmentations;
  return {namesUnder(task, "subtasks", atMost(plan.subtasks.count, haptics::kMostSubtasks)),
          namesUnder(task, "augmentations", atMost(plan.count, haptics::kMostAugmentations))};
}

std::vector<ForceColumn> forceColumns(const SessionInfo& info) {
  std::vector<ForceColumn> columns;
  for (const ForcePart& part : contactParts(info)) addPart(columns, part);
  for (const ForcePart& part : pulseParts(info)) addPart(columns, part);
  addEachCue(columns, info);
  addNumber(columns, "rendered",
            "share of contact and cues that goes out, by the age of the geometry; 0 without force "
            "feedback",
            &TickForces::rendered);
  for (const ForcePart& part : wantedParts(info)) addPart(columns, part);
  addThree(columns, "f_limiter_D", "N", "what the safety limiter changed of f_wanted_D",
           [](const FlightRecord& r, const TickForces&) {
             return Vec3(unpack(r.f_command_D) - unpack(r.f_wanted_D));
           });
  addFelt(columns, info);
  addPlaces(columns, info);
  return columns;
}

nlohmann::json addsUp(const SessionInfo& info) {
  json cues = namesOf(pulseParts(info));
  for (std::size_t i = 0; i < namesIn(info).cues.size(); ++i) cues.push_back(cueColumn(i));
  return {{"f_contact_D", namesOf(contactParts(info))},
          {"f_augmentation_D", cues},
          {"f_wanted_D", namesOf(wantedParts(info))},
          {"f_command_D", json::array({"f_limiter_D"})}};
}

}  // namespace palpa::record
