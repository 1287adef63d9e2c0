#pragma once

#include <cstdint>
#include <deque>

#include "ar/pose_filter.h"

namespace palpa::ar {

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

  enum class Lookup { none, exact, interpolated, predicted };
  struct Answer {
    Lookup how =
        Lookup::none;  ///< none: before what is remembered, or too long after the last pose
    Pose X = Pose::Identity();
    Matrix6 covariance = Matrix6::Zero();
  };
  /// At any time: as it was filtered then, between two such by Hermite's cubic (poses and rates),
  /// or foretold.
  Answer at(std::int64_t t_ns) const;

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

}  // namespace palpa::ar
