#pragma once

#include <optional>

#include "apps/assess/palpation/coverage_map.h"

namespace palpa::task_palpation {

/// Help that fades: a ring on the phantom leads the hand along vertical strips to the next place
/// that was not felt, once nothing new was felt for a while. The better the trials, the longer the
/// wait; every second trial has no help at all (it is the unaided ones that count).
///     wait = 2 s / g,   0 (never) <= g <= 1,   g = 1 at first
/// after an aided or unaided trial g - 0.34 where the area was covered as the standard asks,
/// g + 0.17 where it was not
/// [chosen, after the finding that help as needed served retention and constant help hurt it]
class Guidance {
 public:
  explicit Guidance(bool on) : on_(on), amount_(on ? 1 : 0) {}

  /// Trials from 1: the odd ones are helped.
  bool helps(int trial) const { return on_ && trial % 2 == 1 && amount_ > 0; }
  void begin(int trial);
  /// What the hand is to feel next, or nothing; told at every step of the task. P.
  std::optional<Vec3> lead(const assess::CoverageMap& map, double t_s);
  void end(bool covered);

  double amount() const { return amount_; }
  double shown_s() const { return shown_s_; }  ///< how long it led in this trial

 private:
  bool on_;
  double amount_;
  bool helping_ = false;
  double felt_ = 0, felt_at_s_ = 0, last_s_ = 0, shown_s_ = 0;
};

/// The first place in the order of vertical strips (from the left, to and fro) that was not felt.
std::optional<Vec3> nextInStrips(const assess::CoverageMap& map);

}  // namespace palpa::task_palpation
