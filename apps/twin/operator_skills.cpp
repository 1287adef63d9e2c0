#include "apps/twin/operator_skills.h"

#include <numbers>

#include "anatomy/base/file_schema.h"
#include "anatomy/base/json_file.h"
#include "anatomy/base/units.h"

namespace palpa::twin {
namespace {

constexpr std::size_t kMostPressures = 3;

/// The figures that every hand has.
template <typename Skill>
Skill handOf(const JsonFile& file, const char* kind) {
  needKind(file, kind, 1);
  Skill s;
  s.name = file.text("name");
  s.grip = {file.number("grip_stiffness_N_per_m", 1, 10000),
            file.number("grip_damping_Ns_per_m", 0, 100), file.number("grip_mass_kg", 0.01, 5)};
  s.tremor_rms = kMm * file.number("tremor_rms_mm", 0, 5);
  s.look_sd = kMm * file.number("look_sd_mm", 0, 50);
  return s;
}

}  // namespace

OperatorSkill readOperatorSkill(const std::filesystem::path& path) {
  const JsonFile file(path);
  auto s = handOf<OperatorSkill>(file, "operator_needle");
  s.turn_tremor_rms = kDegree * file.number("turn_tremor_rms_deg", 0, 10);
  s.depth_sd = kMm * file.number("depth_sd_mm", 0, 50);
  s.entry_sd = kMm * file.number("entry_sd_mm", 0, 50);
  s.normal_sd = kDegree * file.number("normal_sd_deg", 0, 90);
  s.direction_sd = kDegree * file.number("direction_sd_deg", 0, 90);
  s.bevel_sd = kDegree * file.number("bevel_sd_deg", 0, 180);
  s.travel_speed = kMm * file.number("travel_speed_mm_per_s", 1, 2000);
  s.push_speed = kMm * file.number("push_speed_mm_per_s", 0.1, 500);
  s.advance_speed = kMm * file.number("advance_speed_mm_per_s", 0.1, 500);
  s.withdraw_speed = kMm * file.number("withdraw_speed_mm_per_s", 0.1, 500);
  s.turn_time = file.number("turn_time_s", 0.1, 60);
  s.pause = file.number("pause_s", 0, 60);
  s.reaction = file.number("reaction_s", 0, 0.6);
  s.notice_puncture_N = file.number("notice_puncture_N", 0, 20);
  s.notice_bone_N = file.number("notice_bone_N", 0, 20);
  s.redirect = kDegree * file.number("redirect_deg", 0.1, 45);
  s.redirect_sd = kDegree * file.number("redirect_sd_deg", 0, 45);
  s.guide = kDegree * file.number("guide_deg", 0, 45);
  s.guide_unfelt = kDegree * file.number("guide_unfelt_deg", 0, 45);
  s.redirections = file.integer("redirections", 0, 50);
  s.first_depth = kMm * file.number("first_depth_mm", 0.5, 70);
  s.vein_distance = kMm * file.number("vein_distance_mm", 1, 150);
  s.search_margin = kMm * file.number("search_margin_mm", 0, 100);
  s.aim_offset_L = kMm * unpack(file.triple("aim_offset_mm"));
  return s;
}

PalpatingSkill readPalpatingSkill(const std::filesystem::path& path) {
  const JsonFile file(path);
  auto s = handOf<PalpatingSkill>(file, "operator_palpation");
  s.strip = kMm * file.number("strip_mm", 1, 200);
  s.step = kMm * file.number("step_mm", 1, 200);
  s.wander = kMm * file.number("wander_mm", 0, 50);
  s.skip = file.number("skip", 0, 0.9);
  s.area_share = file.number("area_share", 0.1, 1);
  s.travel_speed = kMm * file.number("travel_speed_mm_per_s", 1, 2000);
  s.press_speed = kMm * file.number("press_speed_mm_per_s", 0.1, 500);
  for (const nlohmann::json& pressure : file.json().value("pressures_N", nlohmann::json::array())) {
    if (!pressure.is_number() ||
        pressure.get<double>() <= (s.pressures.empty() ? 0 : s.pressures.back()))
      file.refuse("pressures_N", "must hold rising numbers above 0");
    s.pressures.push_back(pressure.get<double>());
  }
  if (s.pressures.empty() || s.pressures.size() > kMostPressures)
    file.refuse("pressures_N", "must hold one to three numbers");
  s.reaction = file.number("reaction_s", 0, 0.6);
  s.weber = file.number("weber", 0, 1);
  s.looks_closer = file.number("looks_closer", -2, 2);
  s.marks_from = file.number("marks_from", -2, 2);
  s.again = file.integer("again", 0, 10);
  s.rounds = file.integer("rounds", 0, 10);
  s.confirms = file.integer("confirms", 0, 10);
  s.closer_force = file.number("closer_force", 1, 2);
  s.size_sd = file.number("size_sd", 0, 1);
  s.hard_from = file.number("hard_from", 0, 2);
  s.feels_around = file.integer("feels_around", 0, 1) == 1;
  s.knows_anatomy = file.integer("knows_anatomy", 0, 1) == 1;
  return s;
}

SearchingSkill readSearchingSkill(const std::filesystem::path& path) {
  const JsonFile file(path);
  auto s = handOf<SearchingSkill>(file, "operator_search");
  s.press = file.number("press_N", 0.05, 20);
  s.stroke_press = file.number("stroke_press_N", 0.05, 20);
  s.scan_speed = kMm * file.number("scan_speed_mm_per_s", 1, 500);
  s.stroke_speed = kMm * file.number("stroke_speed_mm_per_s", 1, 500);
  s.settle_speed = kMm * file.number("settle_speed_mm_per_s", 0.1, 100);
  s.rounds = file.integer("rounds", 2, 20);
  s.jolts = file.integer("jolts", 1, 100);
  s.stroke_s = file.number("stroke_s", 0.1, 10);
  s.strokes = file.integer("strokes", 1, 10);
  s.weber_roughness = file.number("weber_roughness", 0, 2);
  s.jolt = {kMm * file.number("jolt_least_mm_per_s", 0, 100), file.number("jolt_contrast", 0, 20),
            file.number("jolt_spread", 0, 1), kMm * file.number("rough_floor_mm_per_s", 0, 100)};
  return s;
}

SqueezingSkill readSqueezingSkill(const std::filesystem::path& path) {
  const JsonFile file(path);
  auto s = handOf<SqueezingSkill>(file, "operator_squeeze");
  s.close_speed = kMm * file.number("close_speed_mm_per_s", 0.1, 500);
  s.hold = file.number("hold_N", 0.05, 20);
  s.squeeze = file.number("squeeze_N", 0.05, 20);
  if (s.squeeze <= s.hold) file.refuse("squeeze_N", "must be more than hold_N");
  s.weber_stiffness = file.number("weber_stiffness", 0, 1);
  s.weber_weight = file.number("weber_weight", 0, 1);
  return s;
}

StrokingSkill readStrokingSkill(const std::filesystem::path& path) {
  const JsonFile file(path);
  auto s = handOf<StrokingSkill>(file, "operator_friction");
  s.press = file.number("press_N", 0.05, 20);
  s.stroke_speed = kMm * file.number("stroke_speed_mm_per_s", 1, 500);
  s.stroke_length = kMm * file.number("stroke_length_mm", 5, 60);
  s.strokes = file.integer("strokes", 1, 20);
  s.weber_friction = file.number("weber_friction", 0, 1);
  return s;
}

PulseSkill readPulseSkill(const std::filesystem::path& path) {
  const JsonFile file(path);
  auto s = handOf<PulseSkill>(file, "operator_pulse");
  s.press = file.number("press_N", 0.05, 5);
  s.step = kMm * file.number("step_mm", 0.5, 30);
  s.reach = kMm * file.number("reach_mm", 1, 45);
  s.listens_s = file.number("listens_s", 0.5, 10);
  s.beat = {file.number("least_beat_N", 0.001, 0.5), file.number("beat_contrast", 0, 1),
            file.number("beat_spread", 0, 1)};
  s.adjusts = file.integer("adjusts", 0, 1) == 1;
  s.slips = file.number("slips", 0, 0.5);
  s.rhythm_sd = file.number("rhythm_sd", 0, 0.5);
  return s;
}

}  // namespace palpa::twin
