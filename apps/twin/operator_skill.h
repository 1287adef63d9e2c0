#pragma once

#include <filesystem>
#include <string>

#include "apps/twin/device_twin.h"

namespace palpa::twin {

/// A simulated operator's hand, senses and knowledge; fixed beforehand in assets/operators/*.json,
/// each figure with unit and source. SI units here.
struct OperatorSkill {
  std::string name;  ///< "expert", "novice"
  HandGrip grip;
  double tremor_rms = 60e-6;       ///< m, 8-12 Hz
  double turn_tremor_rms = 0.002;  ///< rad
  double look_sd = 0.0005;         ///< m, one look at the needle on the screen
  double depth_sd = 0.001;         ///< m, judging how deep the needle is
  double entry_sd = 0.0015;        ///< m, finding the entry point by the landmarks, per trial
  double normal_sd = 0.03;         ///< rad, holding the needle along the skin's normal, per trial
  double direction_sd = 0.03;      ///< rad, aiming, per trial
  double travel_speed = 0.08;      ///< m/s in the air
  double push_speed = 0.006;       ///< m/s through the skin
  double advance_speed = 0.006;    ///< m/s behind the clavicle
  double withdraw_speed = 0.012;   ///< m/s
  double turn_time = 1.5;          ///< s, turning the needle after phase 1
  double pause = 0.4;              ///< s, before each step of the procedure
  double reaction = 0.2;           ///< s, from seeing or feeling to acting
  double notice_puncture_N = 0.4;  ///< loss of resistance that is felt
  double notice_bone_N = 0.7;      ///< sideways force that is felt as bone
  double redirect = 0.06;          ///< rad, turning away after bone or a dry pass
  double redirect_sd = 0.01;       ///< rad
  double guide = 0;      ///< rad, first aimed this much toward the clavicle, to find it by touch
  int redirections = 8;  ///< then gives up
  double first_depth = 0.010;    ///< m, taught depth of phase 1
  double vein_distance = 0.042;  ///< m, entry to vein along the needle in the mean anatomy
  double search_margin = 0.008;  ///< m beyond it before the pass counts as dry
  Vec3 aim_offset_L =
      Vec3::Zero();  ///< from the sternal end's posterior-superior angle: mean anatomy
};

OperatorSkill readOperatorSkill(const std::filesystem::path& file);

}  // namespace palpa::twin
