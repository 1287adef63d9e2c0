#pragma once

#include <array>
#include <cstdint>
#include <optional>

#include <Eigen/Core>

#include "anatomy/geometry/pose.h"

namespace palpa::ar {

using Vector6 = Eigen::Matrix<double, 6, 1>;
using Matrix6 = Eigen::Matrix<double, 6, 6>;
using Matrix18 = Eigen::Matrix<double, 18, 18>;

/// What takes b to a: (w, v) with a = (exp([w]) R_b, p_b + v), as BoardPose has its covariance.
Vector6 difference(const Pose& a, const Pose& b);
/// And applied.
Pose stepped(const Pose& X, const Vector6& step);

/// A pose in motion: (turning rate, speed) and their derivatives, all in the frame that the pose is
/// in; rad, m, s. `covariance`: of (pose, rate, acceleration), six of each, the pose's as
/// `difference` has it.
struct PoseMotion {
  Pose X = Pose::Identity();
  Vector6 rate = Vector6::Zero(), acceleration = Vector6::Zero();
  Matrix18 covariance = Matrix18::Zero();
};

/// What moves a pose. `still`: it stands, but for a slow random walk of `walk` per square root of a
/// second. Otherwise Singer's model (1970) of a hand that steers: an acceleration of standard
/// deviation `acceleration` that dies away with `memory` while new ones come.
struct MotionModel {
  bool still = false;
  double walk_rad = 0, walk_m = 0;
  double acceleration_rad = 0, acceleration_m = 0;  ///< rad/s^2, m/s^2
  double memory = 0.3;                              ///< s
};

/// `dt` later (s, not negative).
PoseMotion predicted(const PoseMotion& motion, const MotionModel& model, double dt);

/// Joined with a measured pose (Kalman). `log_likelihood` of the measurement, but for a constant;
/// may be null.
PoseMotion updated(const PoseMotion& motion, const Pose& X_measured, const Matrix6& covariance,
                   double* log_likelihood = nullptr);

/// Squared Mahalanobis distance of a measured pose from where it is expected: chi-squared of six
/// degrees of freedom if it belongs there.
double surprise(const PoseMotion& motion, const Pose& X_measured, const Matrix6& covariance);

/// A pose measured from time to time, of something that stands still or is moved by a hand: no
/// jitter while it stands, no lag while it moves. An interacting multiple model filter (Blom &
/// Bar-Shalom 1988): three Kalman filters that believe it stands, is carried gently, is swung
/// briskly
/// (`MotionModel`); how well each predicted the measurements decides how much each is believed, and
/// each starts every step from a mixture of all.
///
/// A measurement that is too surprising for the briskest (chi-squared, 1 in a million) is left out;
/// two in a row that agree with each other are a jump: the filter starts anew there.
class PoseFilter {
 public:
  static constexpr std::size_t kModels = 3;
  struct Settings {
    // [chosen] by `palpa bench tracking`: accelerations of a hand that reaches (Flash & Hogan 1985:
    // 4 m/s^2 over 0.3 m in 0.6 s) and of one that carries.
    std::array<MotionModel, kModels> models{
        {{true, 2e-4, 5e-5, 0, 0, 0}, {false, 0, 0, 1, 0.3, 0.5}, {false, 0, 0, 12, 4, 0.2}}};
    double stays = 1;          ///< [chosen] s for which one model typically holds
    double longest_gap = 0.5;  ///< [chosen] s; after a longer one the filter starts anew
  };

  PoseFilter() : PoseFilter(Settings{}) {}
  explicit PoseFilter(const Settings& settings) : settings_(settings) {}

  enum class Taken {
    left_out,
    taken,
    started_anew
  };  ///< started_anew: the first pose, one after a long gap, one that jumped
  /// Takes the pose of time `t_ns` in, or leaves it out: where it is foreign, or its time does not
  /// advance.
  Taken update(const Pose& X, const Matrix6& covariance, std::int64_t t_ns);

  /// Whether the filter, at that time, would take this pose for a gross error.
  bool isForeign(const Pose& X, const Matrix6& covariance, std::int64_t t_ns) const;

  double moving() const { return 1 - belief_[0]; }  ///< how likely it moves, 0 to 1
  const PoseMotion& now() const { return mixed_; }  ///< at that time
  /// At a time not before it.
  PoseMotion at(std::int64_t t_ns) const;
  void reset() { started_ = false; }

 private:
  void start(const Pose& X, const Matrix6& covariance, std::int64_t t_ns);
  void mix(double dt);

  Settings settings_;
  bool started_ = false;
  std::int64_t t_ns_ = 0;
  std::array<PoseMotion, kModels> motion_;
  std::array<double, kModels> belief_{};
  PoseMotion mixed_;
  struct Outlier {
    Pose X;
    std::int64_t t_ns;
  };
  std::optional<Outlier> outlier_;  ///< the last measurement, if it was left out
};

}  // namespace palpa::ar
