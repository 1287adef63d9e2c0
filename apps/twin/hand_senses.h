#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>

#include "anatomy/base/random.h"
#include "anatomy/geometry/local_geometry.h"
#include "anatomy/geometry/pose.h"

namespace palpa::twin {

/// How a simulated person knows where the patient on the screen is for the own hand: looks at the
/// tool there, now and then, and compares.
class Bearings {
 public:
  /// One look: the tool as drawn (with a delay), the tool as the hand holds it, how well one look
  /// tells (m), how fast the hand is (m/s).
  void look(Pose X_AT, const Pose& X_DT, double look_sd, double hand_speed, RandomStream& noise) {
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

/// What a person felt and saw a reaction time ago: only now can the hand answer it. 100 Hz.
class Reaction {
 public:
  static constexpr double kStep = 0.01;  ///< s
  explicit Reaction(double delay_s) : delay_(static_cast<std::size_t>(delay_s / kStep)) {
    felt_.fill(Vec3::Zero());  // Eigen's own vectors start with anything
  }

  /// What the screen shows.
  struct Sight {
    Tissue flows = Tissue::air;  ///< whose blood or air enters the syringe
    bool injury = false;         ///< it says that something is hurt
    bool asks = false;           ///< it asks what is aspirated
  };

  /// One step: the force on the hand, and what is seen.
  void perceive(const Vec3& f_A, const Sight& sight) {
    const std::size_t slot = count_ % felt_.size(),
                      before = (count_ + felt_.size() - 1) % felt_.size();
    felt_[slot] = 0.7 * felt_[before] + 0.3 * f_A;  // touch is not sharper than about 25 ms
    sight_[slot] = sight;
    ++count_;
  }
  const Vec3& felt() const { return felt_[answered()]; }  ///< frame A, N
  const Sight& seen() const { return sight_[answered()]; }
  bool bloodFlows() const { return seen().flows == Tissue::vein_lumen; }  ///< dark, steadily
  /// Said, or seen in the syringe.
  bool injury() const {
    return seen().injury || seen().flows == Tissue::artery_lumen || seen().flows == Tissue::lung;
  }

 private:
  std::size_t answered() const { return (count_ + felt_.size() - 1 - delay_) % felt_.size(); }

  std::size_t delay_, count_ = 0;
  std::array<Vec3, 64> felt_;
  std::array<Sight, 64> sight_{};
};

/// What fingers notice of a handle that shakes in them. Of its velocity against what the hand
/// itself does, v,
///   shake = |v_fast - v_slow|,   v_fast, v_slow: low-passed with 1 ms and 3 ms: about 50 to 160 Hz
/// A jolt is noticed where shake > (v_0 + c b) (1 + s n), b the root mean square of the shaking of
/// the last second, n standard normal; at most once in 25 ms. Roughness is the root mean square of
/// the shaking over a stroke, with a floor: r = sqrt(mean shake^2 + r_0^2). Velocity, because what
/// is just felt through a held stylus is, above 20 Hz, about the same velocity at every frequency.
class JoltSense {
 public:
  struct Limits {
    double least = 0.002;         ///< v_0, m/s
    double contrast = 2;          ///< c
    double spread = 0.15;         ///< s
    double rough_floor = 0.0005;  ///< r_0, m/s
  };
  JoltSense(const Limits& limits, RandomStream noise) : limits_(limits), noise_(noise) {}

  /// The next `dt` seconds; true: a jolt is noticed now.
  bool feel(const Vec3& v, double dt) {
    constexpr double kFast = 0.001, kSlow = 0.003, kBackground = 1.0, kRest = 0.025;  // s
    fast_ += (v - fast_) * (dt / (kFast + dt));
    slow_ += (v - slow_) * (dt / (kSlow + dt));
    const double shake = (fast_ - slow_).norm(), square = shake * shake;
    const double least = (limits_.least + limits_.contrast * std::sqrt(background_)) *
                         (1 + limits_.spread * noise_.normal());
    background_ += (square - background_) * (dt / (kBackground + dt));
    squares_ += square * dt;
    seconds_ += dt;
    rest_ -= dt;
    if (rest_ > 0 || shake <= std::max(least, 0.0)) return false;
    rest_ = kRest;
    return true;
  }
  void beginStroke() { squares_ = seconds_ = 0; }
  double roughness() const {
    return std::sqrt((seconds_ > 0 ? squares_ / seconds_ : 0) +
                     limits_.rough_floor * limits_.rough_floor);
  }

 private:
  Limits limits_;
  RandomStream noise_;
  Vec3 fast_ = Vec3::Zero(), slow_ = Vec3::Zero();
  double background_ = 0, squares_ = 0, seconds_ = 0, rest_ = 0;
};

}  // namespace palpa::twin
