#include "apps/station/json_file.h"
#include "apps/twin/palpating_hand.h"

namespace palpa::twin {
namespace {
constexpr double kPalpatingMm = 1e-3;
constexpr std::size_t kMostPressures = 3;
}  // namespace

PalpatingSkill readPalpatingSkill(const std::filesystem::path& path) {
  const station::JsonFile file(path);
  file.needVersion(1);
  PalpatingSkill s;
  s.name = file.text("name");
  s.grip = {file.number("grip_stiffness_N_per_m", 1, 10000),
            file.number("grip_damping_Ns_per_m", 0, 100), file.number("grip_mass_kg", 0.01, 5)};
  s.tremor_rms = kPalpatingMm * file.number("tremor_rms_mm", 0, 5);
  s.look_sd = kPalpatingMm * file.number("look_sd_mm", 0, 50);
  s.strip = kPalpatingMm * file.number("strip_mm", 1, 200);
  s.step = kPalpatingMm * file.number("step_mm", 1, 200);
  s.wander = kPalpatingMm * file.number("wander_mm", 0, 50);
  s.skip = file.number("skip", 0, 0.9);
  s.travel_speed = kPalpatingMm * file.number("travel_speed_mm_per_s", 1, 2000);
  s.press_speed = kPalpatingMm * file.number("press_speed_mm_per_s", 0.1, 500);
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
  s.looks_closer = file.number("looks_closer", 0, 2);
  s.marks_from = file.number("marks_from", 0, 2);
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

}  // namespace palpa::twin
