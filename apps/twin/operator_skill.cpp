#include "apps/twin/operator_skill.h"

#include <numbers>

#include "apps/station/json_file.h"

namespace palpa::twin {
namespace {
constexpr double kSkillMm = 1e-3;
constexpr double kSkillDeg = std::numbers::pi / 180;
}  // namespace

OperatorSkill readOperatorSkill(const std::filesystem::path& path) {
  const station::JsonFile file(path);
  file.needVersion(1);
  OperatorSkill s;
  s.name = file.text("name");
  s.grip = {file.number("grip_stiffness_N_per_m", 1, 10000),
            file.number("grip_damping_Ns_per_m", 0, 100), file.number("grip_mass_kg", 0.01, 5)};
  s.tremor_rms = kSkillMm * file.number("tremor_rms_mm", 0, 5);
  s.turn_tremor_rms = kSkillDeg * file.number("turn_tremor_rms_deg", 0, 10);
  s.look_sd = kSkillMm * file.number("look_sd_mm", 0, 50);
  s.depth_sd = kSkillMm * file.number("depth_sd_mm", 0, 50);
  s.entry_sd = kSkillMm * file.number("entry_sd_mm", 0, 50);
  s.normal_sd = kSkillDeg * file.number("normal_sd_deg", 0, 90);
  s.direction_sd = kSkillDeg * file.number("direction_sd_deg", 0, 90);
  s.travel_speed = kSkillMm * file.number("travel_speed_mm_per_s", 1, 2000);
  s.push_speed = kSkillMm * file.number("push_speed_mm_per_s", 0.1, 500);
  s.advance_speed = kSkillMm * file.number("advance_speed_mm_per_s", 0.1, 500);
  s.withdraw_speed = kSkillMm * file.number("withdraw_speed_mm_per_s", 0.1, 500);
  s.turn_time = file.number("turn_time_s", 0.1, 60);
  s.pause = file.number("pause_s", 0, 60);
  s.reaction = file.number("reaction_s", 0, 0.6);
  s.notice_puncture_N = file.number("notice_puncture_N", 0, 20);
  s.notice_bone_N = file.number("notice_bone_N", 0, 20);
  s.redirect = kSkillDeg * file.number("redirect_deg", 0.1, 45);
  s.redirect_sd = kSkillDeg * file.number("redirect_sd_deg", 0, 45);
  s.guide = kSkillDeg * file.number("guide_deg", 0, 45);
  s.redirections = file.integer("redirections", 0, 50);
  s.first_depth = kSkillMm * file.number("first_depth_mm", 0.5, 70);
  s.vein_distance = kSkillMm * file.number("vein_distance_mm", 1, 150);
  s.search_margin = kSkillMm * file.number("search_margin_mm", 0, 100);
  s.aim_offset_L = kSkillMm * file.vector("aim_offset_mm");
  return s;
}

}  // namespace palpa::twin
