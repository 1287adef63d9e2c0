#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "anatomy/geometry/pose.h"
#include "apps/twin/beat_sense.h"
#include "apps/twin/device_twin.h"
#include "apps/twin/hand_senses.h"

/// How simulated persons differ: what assets/operators/*.json say of each, fixed beforehand, every
/// figure with unit and source. SI units here.
namespace palpa::twin {

/// A simulated operator's hand, senses and knowledge.
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
  double bevel_sd = 0.17;          ///< rad, turning the bevel up, per trial
  double redirect = 0.06;          ///< rad, turning away after bone or a dry pass
  double redirect_sd = 0.01;       ///< rad
  double guide = 0;         ///< rad, first aimed this much toward the clavicle, to find it by touch
  double guide_unfelt = 0;  ///< rad, the same where the skin was not felt
  int redirections = 8;     ///< then gives up
  double first_depth = 0.010;    ///< m, taught depth of phase 1
  double vein_distance = 0.042;  ///< m, entry to vein along the needle in the mean anatomy
  double search_margin = 0.008;  ///< m beyond it before the pass counts as dry
  /// from the sternal end's posterior-superior angle: mean anatomy
  Vec3 aim_offset_L = Vec3::Zero();
};

/// How a simulated person palpates.
struct PalpatingSkill {
  std::string name;
  HandGrip grip;
  double tremor_rms = 0, look_sd = 0;  ///< m
  double strip = 0, step = 0;          ///< m, between vertical strips, between presses along one
  double wander = 0;                   ///< m, how far from the planned place a press is
  double skip = 0;                     ///< share of places that are left out
  double area_share = 1;               ///< of the area, from the left, that is searched at all
  double travel_speed = 0, press_speed = 0;  ///< m/s
  /// N, rising, at each of which it is judged how far the surface gave way
  std::vector<double> pressures;
  double reaction = 0;                      ///< s
  double weber = 0;                         ///< standard deviation of ln of a judged depth
  double looks_closer = 0, marks_from = 0;  ///< ln of how much less it gives way than around
  int again = 0;  ///< presses of a place that seemed firm, before a closer look
  /// Of five presses about the place, at most, in a closer look that follows what is firmer;
  /// presses at the firmest place by which it is decided, 0: by those that led there
  int rounds = 0, confirms = 0;
  double closer_force = 1;  ///< how much harder a closer look presses
  double size_sd = 0;       ///< share
  double hard_from = 0;     ///< ln, as `marks_from`: from here on a lump is called hard
  /// What seemed firm waits until all about it has been felt; else a closer look begins at once
  bool feels_around = false;
  bool knows_anatomy = false;  ///< what belongs there is not taken for a lump
};

/// How a simulated person searches a floor.
struct SearchingSkill {
  std::string name;
  HandGrip grip;
  double tremor_rms = 0, look_sd = 0;  ///< m, in the hand
  double press = 0, stroke_press = 0;  ///< N, on the floor: to find edges, to tell a texture
  double scan_speed = 0, stroke_speed = 0,
         settle_speed = 0;     ///< m/s: going round, stroking over a texture, looking for a pit
  int rounds = 0;              ///< at most, before deciding where the elements are
  int jolts = 0;               ///< that make a round worth deciding by
  double stroke_s = 0;         ///< on each texture, each time
  int strokes = 0;             ///< times over each texture before deciding
  double weber_roughness = 0;  ///< standard deviation of ln of what is felt
  JoltSense::Limits jolt;
};

/// How a simulated person compares two things between two fingers.
struct SqueezingSkill {
  std::string name;
  HandGrip grip;                       ///< of each finger's tool
  double tremor_rms = 0, look_sd = 0;  ///< m
  double close_speed = 0;              ///< m/s, of each finger, when it closes and squeezes
  double hold = 0, squeeze = 0;        ///< N: to lift; to tell how hard it is
  double weber_stiffness = 0, weber_weight = 0;  ///< standard deviation of ln of what is felt
};

/// How a simulated person strokes over surfaces.
struct StrokingSkill {
  std::string name;
  HandGrip grip;
  double tremor_rms = 0, look_sd = 0;  ///< m
  double press = 0;                    ///< N
  double stroke_speed = 0;             ///< m/s, mean
  double stroke_length = 0;            ///< m
  int strokes = 0;                     ///< over each surface
  double weber_friction = 0;           ///< standard deviation of ln of what is felt
};

/// How a simulated person examines a pulse.
struct PulseSkill {
  std::string name;
  HandGrip grip;
  double tremor_rms = 0, look_sd = 0;  ///< m
  double press = 0;                    ///< N: how hard it is looked for
  double step = 0, reach = 0;          ///< m, across the artery's usual line
  double listens_s = 0;                ///< at each place
  BeatSense::Limits beat;
  bool adjusts = false;  ///< varies the pressure until the beats are strongest
  double slips = 0;      ///< share of the beats that are lost in counting, or counted twice
  double rhythm_sd = 0;  ///< error of an interval as it is remembered, in itself
};

/// They throw UsageError naming file and field.
OperatorSkill readOperatorSkill(const std::filesystem::path& file);
PalpatingSkill readPalpatingSkill(const std::filesystem::path& file);
SearchingSkill readSearchingSkill(const std::filesystem::path& file);
SqueezingSkill readSqueezingSkill(const std::filesystem::path& file);
StrokingSkill readStrokingSkill(const std::filesystem::path& file);
PulseSkill readPulseSkill(const std::filesystem::path& file);

}  // namespace palpa::twin
