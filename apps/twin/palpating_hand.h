#pragma once

#include <cstdint>
#include <vector>

#include "anatomy/base/random.h"
#include "anatomy/geometry/pose.h"
#include "apps/twin/hand.h"
#include "apps/twin/hand_motion.h"
#include "apps/twin/hand_senses.h"
#include "apps/twin/lump_search.h"

namespace palpa::twin {

/// A simulated person who searches a soft thing for lumps, in vertical strips: presses, judges how
/// far it gave way at each pressure against what the nearest ordinary places gave, looks closer
/// where it gave less, marks by holding still with the button, grades. Knows what is on the screen
/// and what the hand feels; nothing else.
class PalpatingHand final : public Hand {
 public:
  PalpatingHand(const PalpatingSkill& skill, const VisiblePhantom& phantom, const Pose& X_ET,
                std::uint64_t seed);

  Action act(const Senses& senses, double dt) override;
  const HandGrip& grip() const override { return skill_.grip; }

 private:
  enum class PalpationStep { rest, travel, press, overshoot, lift, mark, release };
  void think(const Senses& senses);
  void beginTrial(int trial, double now_s);
  void goTo(const Vec3& p_P, double now_s, PalpationStep next);
  void pressing(double now_s);
  void next(double now_s);

  PalpatingSkill skill_;
  Pose X_AP_, X_ET_, X_TE_;
  RandomStream noise_;
  Tremor tremor_;
  Bearings bearings_;
  double hand_speed_ = 0;
  Vec3 p_last_D_ = Vec3::Zero();
  std::int64_t next_thought_ns_ = 0, last_look_ns_ = 0;

  PalpationStep step_ = PalpationStep::rest, after_travel_ = PalpationStep::rest;
  int trial_ = 0;
  Vec3 tip_P_ = Vec3::Zero(), tip_now_P_ = Vec3::Zero();  ///< wanted, and where it is
  MinJerk move_;
  double since_s_ = 0;
  double felt_N_ = 0, air_N_ = 0, touched_z_ = 0, light_z_ = 0;
  double resistance_N_ = 0, z_ = 0;  ///< at the last thought
  bool touched_ = false;
  std::vector<double> depths_;  ///< of this press so far
  LumpSearch search_;
  Word word_;
  bool done_ = false;
};

}  // namespace palpa::twin
