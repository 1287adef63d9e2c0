#pragma once

#include <algorithm>
#include <numbers>
#include <utility>

#include "anatomy/base/random.h"
#include "apps/twin/hand.h"
#include "apps/twin/hand_motion.h"
#include "apps/twin/hand_senses.h"

namespace palpa::twin {

/// What a simulated person does who holds one upright tool over a block, whatever for: looks where
/// it is, feels the force, leads the tip. Frame P: middle of the block's top, z up; m, N, s.
class UprightTool {
 public:
  static constexpr std::int64_t kThinks_ns = 10'000'000, kLooks_ns = 100'000'000;  // 100, 10 Hz
  static constexpr double kThinks_s = 0.01;

  UprightTool(const Pose& X_AP, const Pose& X_ET, double look_sd, RandomStream noise, Tremor tremor)
      : X_AP_(X_AP), X_ET_(X_ET), look_sd_(look_sd), noise_(noise), tremor_(std::move(tremor)) {}

  /// `anew`: it may correct where it takes the block to lie. False: it has not seen it yet.
  bool look(const Hand::Senses& senses, double dt, bool anew) {
    const Vec3 p_D = senses.X_DE.translation();
    speed_ += ((p_D - p_last_D_).norm() / dt - speed_) * std::min(1.0, dt / 0.05);
    p_last_D_ = p_D;
    const bool first = !bearings_.taken();
    if (senses.seen && (first || (anew && senses.now_ns - last_look_ns_ >= kLooks_ns))) {
      last_look_ns_ = senses.now_ns;
      bearings_.look(senses.seen->X_AT, senses.X_DE * X_ET_, look_sd_, speed_, noise_);
    }
    if (!bearings_.taken()) return false;
    const Pose X_PD = (bearings_.X_DA() * X_AP_).inverse();
    if (first) at_P = X_PD * (senses.X_DE * X_ET_).translation();
    felt_P_ += kSharp * dt / kThinks_s * (X_PD.rotation() * senses.f_fingers_D - felt_P_);
    return true;
  }
  /// A hundred times a second.
  bool thinks(const Hand::Senses& senses) {
    if (senses.now_ns < next_thought_ns_) return false;
    next_thought_ns_ = senses.now_ns + kThinks_ns;
    return true;
  }
  /// Where the end effector is wanted.
  Pose wanted(double dt) {
    const Mat3 down = Eigen::AngleAxisd(std::numbers::pi, Vec3::UnitX()).toRotationMatrix();
    return bearings_.X_DA() * X_AP_ * makePose(down, at_P + tremor_.next(dt)) * X_ET_.inverse();
  }

  /// A step begins, here.
  void begin(double now_s) {
    since_s = now_s;
    from_P = at_P;
  }
  /// Minimum jerk from where the step began; true: it is there.
  bool moved(double now_s, double seconds, const Vec3& to_P) {
    const MinJerk way(makePose(Mat3::Identity(), from_P), makePose(Mat3::Identity(), to_P), since_s,
                      seconds);
    at_P = way.at(now_s).translation();
    return way.done(now_s);
  }
  const Vec3& felt_P() const { return felt_P_; }  ///< what the fingers feel

  Vec3 at_P = Vec3::Zero(), from_P = Vec3::Zero();  ///< where the tip is wanted; a step began
  double since_s = 0;

 private:
  static constexpr double kSharp = 0.3;  // touch is not sharper than about 25 ms

  Pose X_AP_, X_ET_;
  double look_sd_;
  RandomStream noise_;
  Tremor tremor_;
  Bearings bearings_;
  std::int64_t last_look_ns_ = -kLooks_ns, next_thought_ns_ = 0;
  Vec3 p_last_D_ = Vec3::Zero(), felt_P_ = Vec3::Zero();
  double speed_ = 0;
};

}  // namespace palpa::twin
