#pragma once

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

/// Changes of direction in phase 2: the tip drawn back by more than 3 mm toward the entry, then
/// advanced by more than 3 mm along a direction more than 3 degrees from that before.
int countRedirections(Samples samples, const std::vector<Pass>& passes);

}  // namespace palpa::assess
