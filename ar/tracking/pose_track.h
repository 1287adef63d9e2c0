#pragma once

#include <cstdint>
#include <deque>

#include "ar/tracking/pose_filter.h"

namespace palpa::ar {

/// none: before what is remembered, or too long after the last pose.
enum class Lookup { none, exact, interpolated, predicted };

/// A pose at a time that was asked for, and how it was found.
struct PoseLookup {
  Lookup how = Lookup::none;
  Pose X = Pose::Identity();
  Matrix6 covariance = Matrix6::Zero();
};

/// A filtered pose that remembers where it was and tells where it will be.
class PoseTrack {
 public:
  struct Settings {
    PoseFilter::Settings filter;
    double remembers = 2;              ///< s
    double longest_prediction = 0.25;  ///< s beyond the last pose
  };
  PoseTrack() : PoseTrack(Settings{}) {}
  explicit PoseTrack(const Settings& settings) : settings_(settings), filter_(settings.filter) {}

  /// Takes a measured pose in; false where the filter left it out.
  bool add(const Pose& X, const Matrix6& covariance, std::int64_t t_ns);

  /// At any time: as it was filtered then, between two such by Hermite's cubic (poses and rates),
  /// or predicted.
  PoseLookup at(std::int64_t t_ns) const;

  const PoseFilter& filter() const { return filter_; }
  void forget();

 private:
  struct Entry {
    std::int64_t t_ns;
    PoseMotion motion;
  };
  Settings settings_;
  PoseFilter filter_;
  std::deque<Entry> past_;  ///< in the order of time
};

/// From poses that come now and then a pose for every tick of the haptic loop: each is carried on
/// by its rate and dying acceleration, and where a new one contradicts what was said before, the
/// difference fades (smoothstep, no step of the pose or of its speed) within `blend`. Never further
/// than `longest` ahead: then it stands. Allocates nothing.
class PoseUpsampler {
 public:
  struct Settings {
    double blend = 0.033, longest = 0.1, memory = 0.3;  ///< s
  };
  PoseUpsampler() : PoseUpsampler(Settings{}) {}
  explicit PoseUpsampler(const Settings& settings) : settings_(settings) {}

  /// A newer estimate, of time `t_ns`, known since `now_ns`.
  void take(const PoseMotion& motion, std::int64_t t_ns, std::int64_t now_ns);
  /// Identity before the first estimate.
  Pose at(std::int64_t now_ns) const;
  bool started() const { return started_; }

 private:
  Pose carriedTo(std::int64_t now_ns) const;

  Settings settings_;
  bool started_ = false;
  Pose X_ = Pose::Identity();
  Vector6 rate_ = Vector6::Zero(), acceleration_ = Vector6::Zero();
  Vector6 contradiction_ = Vector6::Zero();  ///< what was said less the new estimate, when it came
  std::int64_t t_ns_ = 0, taken_ns_ = 0;
};

}  // namespace palpa::ar
