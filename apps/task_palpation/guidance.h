#pragma once

#include <optional>

#include "apps/assess/palpation/coverage_map.h"
#include "apps/training/fading_support.h"

namespace palpa::task_palpation {

/// Help that fades: a ring on the phantom leads the hand along vertical strips to the next place
/// that was not felt, once nothing new was felt for a while. The better the trials, the longer the
/// wait:
///     wait = 2 s / g      g: training::FadingSupport; good: covered as the standard asks
class Guidance {
 public:
  explicit Guidance(bool on) : support_(on) {}

  /// Trials from 1: the odd ones are helped.
  bool helps(int trial) const { return support_.helps(trial); }
  void begin(int trial);
  /// What the hand is to feel next, or nothing; told at every step of the task. P.
  std::optional<Vec3> lead(const assess::CoverageMap& map, double t_s);
  void end(bool covered);

  double amount() const { return support_.amount(); }
  double shown_s() const { return shown_s_; }  ///< how long it led in this trial

 private:
  training::FadingSupport support_;
  bool helping_ = false;
  double felt_ = 0, felt_at_s_ = 0, last_s_ = 0, shown_s_ = 0;
};

/// The first place in the order of vertical strips (from the left, to and fro) that was not felt.
std::optional<Vec3> nextInStrips(const assess::CoverageMap& map);

}  // namespace palpa::task_palpation
