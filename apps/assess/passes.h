#pragma once

#include <algorithm>
#include <vector>

#include "apps/assess/intervals.h"
#include "apps/assess/phase_detector.h"

namespace palpa::assess {

/// One pass: from a puncture of the skin to complete withdrawal or the end.
struct Pass {
  std::size_t first = 0, last = 0;  ///< samples, inclusive
  bool reoriented = false;          ///< turned between puncture and advance
  bool advanced = false;            ///< phase 2 was reached
  std::size_t phase_2 = 0;          ///< its first sample
  TrialSample puncture, end_of_phase_1, start_of_phase_2;
  double deepest = 0;  ///< m, before phase 2
};

struct PhaseHistory {
  std::vector<ProcedurePhase> phases;  ///< one a sample
  std::vector<Pass> passes;
};

PhaseHistory detectPhases(Samples samples);

/// The pass that is scored: after success the last one; otherwise the last that reached phase 2,
/// else the last. Null when the skin was never punctured.
const Pass* scoredPass(const std::vector<Pass>& passes, bool success);

/// Follows how far the tip is from the entry; a turning point must be left by more than 3 mm.
/// Counts changes of direction: the tip drawn back, then advanced again along a direction more than
/// 3 degrees from that before.
class RedirectionCounter {
 public:
  void add(double reach, const Vec3& axis);
  int count() const { return count_; }

 private:
  double peak_ = -1, low_ = 0;
  Vec3 axis_at_peak_ = Vec3::UnitZ();
  bool retreating_ = false;
  int count_ = 0;
};

/// Changes of direction in phase 2 of all passes.
int countRedirections(Samples samples, const std::vector<Pass>& passes);

/// Needle passes while they are made: skin punctures and redirections, as the score counts them
/// afterwards.
class PassCounter {
 public:
  void add(const TrialSample& sample);  ///< every tick of the trial
  int passes() const {
    return std::max(punctures_, insertions_) + redirections_ + current_.count();
  }

 private:
  PhaseDetector detector_;
  ProcedurePhase before_ = ProcedurePhase::approach;
  RedirectionCounter current_;  ///< of the pass that is on
  int punctures_ = 0, insertions_ = 0, redirections_ = 0;
};

}  // namespace palpa::assess
