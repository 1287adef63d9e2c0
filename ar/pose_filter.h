#pragma once

#include <array>
#include <cstdint>
#include <optional>

#include "ar/pose_motion.h"

namespace palpa::ar {

/// A pose measured from time to time, of something that stands still or is moved by a hand: no
/// jitter while it stands, no lag while it moves. An interacting multiple model filter (Blom &
/// Bar-Shalom 1988): three Kalman filters that believe it stands, is carried gently, is swung
/// briskly
/// (`MotionModel`); how well each foretold the measurements decides how much each is believed, and
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
