#include "apps/twin/learning_hand.h"

#include <cmath>

namespace palpa::twin {
namespace {

void mix(double& value, double to, double level) { value += level * (to - value); }
void mix(int& value, int to, double level) {
  value = static_cast<int>(std::lround(value + level * (to - value)));
}
void mix(Vec3& value, const Vec3& to, double level) { value += level * (to - value); }
void mix(HandGrip& value, const HandGrip& to, double level) {
  mix(value.stiffness, to.stiffness, level);
  mix(value.damping, to.damping, level);
  mix(value.mass, to.mass, level);
}
void mix(JoltSense::Limits& value, const JoltSense::Limits& to, double level) {
  mix(value.least, to.least, level);
  mix(value.contrast, to.contrast, level);
  mix(value.spread, to.spread, level);
  mix(value.rough_floor, to.rough_floor, level);
}

template <class Skill, class... Figures>
Skill mixed(const Skill& from, const Skill& to, double level, Figures Skill::*... figures) {
  Skill skill = from;
  skill.name = "learner";
  (mix(skill.*figures, to.*figures, level), ...);
  return skill;
}

}  // namespace

OperatorSkill between(const OperatorSkill& from, const OperatorSkill& to, double level) {
  using S = OperatorSkill;
  return mixed(from, to, level, &S::grip, &S::tremor_rms, &S::turn_tremor_rms, &S::look_sd,
               &S::depth_sd, &S::entry_sd, &S::normal_sd, &S::direction_sd, &S::travel_speed,
               &S::push_speed, &S::advance_speed, &S::withdraw_speed, &S::turn_time, &S::pause,
               &S::reaction, &S::notice_puncture_N, &S::notice_bone_N, &S::bevel_sd, &S::redirect,
               &S::redirect_sd, &S::guide, &S::redirections, &S::first_depth, &S::vein_distance,
               &S::search_margin, &S::aim_offset_L);
}

SearchingSkill between(const SearchingSkill& from, const SearchingSkill& to, double level) {
  using S = SearchingSkill;
  return mixed(from, to, level, &S::grip, &S::tremor_rms, &S::look_sd, &S::press, &S::stroke_press,
               &S::scan_speed, &S::stroke_speed, &S::settle_speed, &S::rounds, &S::jolts,
               &S::stroke_s, &S::strokes, &S::weber_roughness, &S::jolt);
}

LearningHand::LearningHand(Make make) : make_(std::move(make)), now_(make_(trial_)) {}

Hand::Action LearningHand::act(const Senses& senses, double dt) {
  if (senses.seen && senses.seen->running && senses.seen->trial != trial_) {
    trial_ = senses.seen->trial;
    now_ = make_(trial_);
  }
  return now_->act(senses, dt);
}

}  // namespace palpa::twin
