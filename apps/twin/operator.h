#pragma once

#include <cstdint>
#include <filesystem>
#include <string>

#include "anatomy/base/random.h"
#include "apps/station/station_file.h"
#include "apps/twin/device_twin.h"
#include "apps/twin/hand.h"
#include "apps/twin/hand_motion.h"
#include "apps/twin/hand_senses.h"

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

OperatorSkill readOperatorSkill(const std::filesystem::path& file);

/// What anybody can see or palpate on the displayed patient.
struct VisibleAnatomy {
  Vec3 entry_A;          ///< 1 cm below the junction of medial and middle thirds
  Vec3 normal_A;         ///< of the skin there
  Vec3 aim_A;            ///< where the needle is pointed: by the landmarks
  double vein_distance;  ///< m, entry to vein along the needle, as far as he knows
  Vec3 medial_A, posterior_A, cephalad_A;  ///< unit directions by the landmarks
  double most_lean = 1;  ///< rad, toward the bone: the middle half of the vein as it was seen
};

/// E above the entry, the needle pointing down and a little ahead: where a trainee picks it up, on
/// the side of the hand.
Pose needlePickedUp(const station::Station& station, const Pose& X_WA, const Vec3& entry_A,
                    bool left_handed);

/// A simulated person who performs the procedure. Knows what is on the screen (with a delay, with
/// noise) and what the hand feels; nothing else. Moves a hand; the device's mechanics do the rest.
class Operator final : public Hand {
 public:
  Operator(const OperatorSkill& skill, const VisibleAnatomy& anatomy, const Pose& X_ET,
           std::uint64_t seed);

  Action act(const Senses& senses, double dt) override;
  const HandGrip& grip() const override { return skill_.grip; }

 private:
  enum class NeedleStep {
    rest,
    approach,
    lower,
    push,
    settle,
    deepen,
    turn,
    advance,
    retreat,
    redirect,
    dwell,
    leave
  };

  int tells();
  Vec3 bevelOf(int trial) const;
  void look(const Senses& senses);
  void feel(const Senses& senses);
  void think(const Senses& senses);
  void step(double now_s);
  void leaving(double now_s);
  void begin(NeedleStep step, double now_s, double pause_s);
  void beginTrial(int trial, double now_s);
  void moveTo(const Pose& X_AT, double now_s, double speed);
  void aimAt(const Vec3& axis_A, double now_s, double duration_s);
  void pushing(double now_s);
  void advancing(double now_s);
  void retreating(double now_s);
  void dwelling(double now_s);
  void tryElsewhere(double now_s, double back);
  void dwell(double now_s);
  void turnAway(const Vec3& toward_A, double now_s);
  void holdHere();
  Vec3 firstAim();
  Pose needleAt(const Vec3& tip_A, const Vec3& axis_A) const;
  double seenInsertion() const;

  OperatorSkill skill_;
  VisibleAnatomy anatomy_;
  Pose X_ET_, X_TE_;
  std::uint64_t seed_;
  RandomStream judgement_, noise_;
  Tremor tremor_, turn_tremor_;

  // What he believes: where the patient on the screen is for his hand, where the needle is.
  Bearings bearings_;
  Vec3 entry_seen_A_ = Vec3::Zero();
  Reaction reaction_;
  double peak_N_ = 0;
  double depth_error_ = 0;
  bool told_ = false;  ///< what is aspirated, since the screen asked
  bool feels_ = true;  ///< the skin resisted: what is touched will be felt

  // What he is doing.
  NeedleStep step_ = NeedleStep::rest;
  double ready_s_ = 0;  ///< the current step's pause is over
  int trial_ = 0;
  bool running_ = false;
  int passes_ = 0;
  bool gives_up_ = false;
  Vec3 bevel_A_ = Vec3::UnitY();  ///< whither its opening is turned
  Vec3 plan_entry_A_ = Vec3::Zero(), plan_normal_A_ = Vec3::UnitZ(), axis_A_ = Vec3::UnitZ();
  Vec3 tip_A_ = Vec3::Zero();  ///< wanted
  double insertion_ = 0;       ///< wanted, along axis_A_ from the entry
  double retreat_to_ = 0;
  Vec3 turn_toward_A_ = Vec3::Zero();
  bool moving_ = false;
  MinJerk move_;
  double plunger_ = 0, plunger_wanted_ = 0;
  double dwell_since_s_ = 0, dwell_begun_s_ = 0;
  int nudges_ = 0;           ///< since the last redirection
  bool going_back_ = false;  ///< this place is given up: blood on the way back stops nobody
  std::int64_t next_thought_ns_ = 0, last_look_ns_ = 0;
  Vec3 p_last_D_ = Vec3::Zero();
  double hand_speed_ = 0;
  Pose X_DH_ = Pose::Identity();
};

}  // namespace palpa::twin
