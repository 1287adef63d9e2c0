#pragma once

#include <cstdint>

#include "anatomy/base/random.h"
#include "apps/station/station_file.h"
#include "apps/twin/device_twin.h"
#include "apps/twin/hand.h"
#include "apps/twin/hand_motion.h"
#include "apps/twin/hand_senses.h"
#include "apps/twin/needle_plan.h"

namespace palpa::twin {

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
  void look(const Senses& senses);
  void feel(const Senses& senses);
  void think(const Senses& senses);
  void step(double now_s);
  void leaving(double now_s);
  void begin(NeedleStep step, double now_s, double pause_s);
  void beginTrial(int trial, double now_s);
  void goOn(double now_s);
  void approach(double now_s);
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
  Pose needleAt(const Vec3& tip_A, const Vec3& axis_A) const;
  double seenInsertion() const;

  OperatorSkill skill_;
  double vein_distance_;  ///< m, entry to vein, as far as he knows
  NeedlePlan plan_;
  Pose X_ET_, X_TE_;
  RandomStream noise_;
  Tremor tremor_, turn_tremor_;

  // What he believes: where the patient on the screen is for his hand, where the needle is.
  Bearings bearings_;
  Vec3 entry_seen_A_ = Vec3::Zero();
  Reaction reaction_;
  double peak_N_ = 0;
  bool told_ = false;  ///< what is aspirated, since the screen asked
  bool feels_ = true;  ///< the skin resisted: what is touched will be felt

  // What he is doing.
  NeedleStep step_ = NeedleStep::rest;
  double ready_s_ = 0;  ///< the current step's pause is over
  int trial_ = 0;
  bool running_ = false, interrupted_ = false;  ///< paused or over, and not by his own word
  int passes_ = 0;
  bool gives_up_ = false;
  Vec3 tip_A_ = Vec3::Zero(), axis_A_ = Vec3::UnitZ();  ///< wanted
  double insertion_ = 0;                                ///< wanted, along axis_A_ from the entry
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
