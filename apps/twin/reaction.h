#pragma once

#include <array>
#include <cstdint>

#include "anatomy/geometry/pose.h"

namespace palpa::twin {

/// What a person felt and saw a reaction time ago: only now can the hand answer it. 100 Hz.
class Reaction {
 public:
  static constexpr double kStep = 0.01;  ///< s
  explicit Reaction(double delay_s) : delay_(static_cast<std::size_t>(delay_s / kStep)) {
    felt_.fill(Vec3::Zero());  // Eigen's own vectors start with anything
  }

  /// One step: the force on the hand, and what the screen shows.
  void perceive(const Vec3& f_A, bool blood_flows, bool injury) {
    const std::size_t slot = count_ % felt_.size(),
                      before = (count_ + felt_.size() - 1) % felt_.size();
    felt_[slot] = 0.7 * felt_[before] + 0.3 * f_A;  // touch is not sharper than about 25 ms
    flow_[slot] = blood_flows;
    injury_[slot] = injury;
    ++count_;
  }
  const Vec3& felt() const { return felt_[answered()]; }  ///< frame A, N
  bool bloodFlows() const { return flow_[answered()]; }
  bool injury() const { return injury_[answered()]; }

 private:
  std::size_t answered() const { return (count_ + felt_.size() - 1 - delay_) % felt_.size(); }

  std::size_t delay_, count_ = 0;
  std::array<Vec3, 64> felt_;
  std::array<bool, 64> flow_{}, injury_{};
};

}  // namespace palpa::twin
