#pragma once

#include "anatomy/geometry/pose.h"
#include "apps/runtime/random.h"

namespace palpa::twin {

/// How a simulated person knows where the patient on the screen is for the own hand: looks at the
/// tool there, now and then, and compares.
class Bearings {
 public:
  /// One look: the tool as drawn (with a delay), the tool as the hand holds it, how well one look
  /// tells (m), how fast the hand is (m/s).
  void look(Pose X_AT, const Pose& X_DT, double look_sd, double hand_speed,
            runtime::RandomStream& noise) {
    constexpr double kStillEnough =
        0.010;  // m/s: the picture lags, so only a slow hand is compared with it
    constexpr double kTrust = 0.2;  // weight of one look against what is believed
    X_AT.translation() += look_sd * Vec3(noise.normal(), noise.normal(), noise.normal());
    X_AT_ = X_AT;
    const Pose X_DA = X_DT * X_AT.inverse();
    if (!taken_) {
      X_DA_ = X_DA;
      taken_ = true;
    } else if (hand_speed < kStillEnough) {
      const Quat q = Quat(X_DA_.rotation()).slerp(kTrust, Quat(X_DA.rotation()));
      const Vec3 p = X_DA_.translation() + kTrust * (X_DA.translation() - X_DA_.translation());
      X_DA_ = makePose(q.normalized().toRotationMatrix(), p);
    }
  }
  bool taken() const { return taken_; }
  const Pose& X_DA() const { return X_DA_; }  ///< as believed
  const Pose& X_AT() const { return X_AT_; }  ///< as seen last

 private:
  bool taken_ = false;
  Pose X_DA_ = Pose::Identity(), X_AT_ = Pose::Identity();
};

}  // namespace palpa::twin
