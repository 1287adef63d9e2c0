#pragma once

#include <algorithm>
#include <vector>

#include "anatomy/base/pinned_math.h"
#include "apps/assess/needle/intervals.h"
#include "apps/assess/needle/trial_assessment.h"

namespace palpa::assess {

enum class ProcedurePhase { approach, puncture, reorient, advance };
const char* clinicalName(ProcedurePhase phase);

/// Thresholds of the phases, metres, radians, seconds. Ours; Tzafestas et al. 2008
/// name the two phases only.
struct PhaseRules {
  double smoothing_s = 0.1;     ///< first-order; leaves 1/6 of a 10 Hz tremor
  double turn_begins = 0.0873;  ///< 5 deg from the puncture's direction: the needle is being turned
  double turn_undone = 0.0524;  ///< 3 deg: turned back (hysteresis)
  double turned = 0.1745;       ///< 10 deg: reoriented; no more drift of the hand
  double steady_s = 0.5;        ///< slower smoothing, to tell turning from holding a direction ...
  double steady = 0.0262;       ///< ... 1.5 deg between the two: turns faster than about 4 deg/s
  double settled = 0.0873;      ///< 5 deg: an advance within this cone has a direction
  double advance = 0.002;       ///< of the tip along the needle: phase 2
  double straight = 0.025;      ///< tip this far from the puncture without the above: phase 2, too
};

/// Which part of the procedure a trial is in, sample by sample, from the record alone; the HUD and
/// the score use this same machine, so they cannot disagree.
///
/// - approach: the needle is not inserted.
/// - puncture (phase 1): inserted, within 5 degrees of its direction when the skin gave way.
/// - reorient: turned by more than 5 degrees (back below 3 degrees: puncture again).
/// - advance (phase 2): begins with the first of
///   (a) turned by 10 degrees or more, and the tip 2 mm further along the needle while the
///   direction stayed within 5 degrees: the turn is over and the needle goes somewhere (a pull
///   back or a further turn starts the 2 mm afresh);
///   (b) the tip 25 mm from the puncture: advanced without turning, or turning all the way (taken
///   back when the tip has returned to half of that and the needle is turned);
///   (c) the tip in the lumen of the vein.
///   It lasts for the rest of the pass; later redirections are counted elsewhere.
///
/// A complete withdrawal starts again. Progress is that of the tip along the needle, not the
/// inserted length, which grows when the needle is merely tilted about its tip. Tip and axis are
/// smoothed before they are compared (tremor of 50-200 um at 8-12 Hz is far below every threshold);
/// the samples kept are the raw ones. Any sampling rate from about 20 Hz.
class PhaseDetector {
 public:
  PhaseDetector() = default;
  explicit PhaseDetector(const PhaseRules& rules) : rules_(rules) {}

  void add(const TrialSample& sample);
  ProcedurePhase phase() const { return phase_; }
  /// The needle was turned by 10 degrees in this pass and not back (false while advancing: it went
  /// straight on).
  bool reoriented() const { return reoriented_; }
  bool advancing() const { return phase_ == ProcedurePhase::advance; }
  /// Valid once reached in the current pass. Phase 1 ends with the last sample within 10 degrees at
  /// which the direction was held steady: its depth is that before the turn, even when the hand
  /// drifted a few degrees on the way in. Without a turn it ends where phase 2 begins.
  const TrialSample& puncture() const { return puncture_; }
  const TrialSample& endOfPhase1() const { return end_of_phase_1_; }
  const TrialSample& startOfPhase2() const { return start_of_phase_2_; }

 private:
  void smooth(const TrialSample& sample);
  void beginPass(const TrialSample& sample);
  void followTurn();
  void followProgress();
  bool advanceBegins(const TrialSample& sample, bool* straight) const;
  void beginAdvance(const TrialSample& sample, bool straight);
  void maybeTakeBack(const TrialSample& sample);
  void setAnchor();
  double turn() const;
  bool steady() const;

  PhaseRules rules_;
  ProcedurePhase phase_ = ProcedurePhase::approach;
  bool started_ = false, reoriented_ = false, straight_ = false;
  double t_s_ = 0;
  Vec3 tip_ = Vec3::Zero(), axis_ = Vec3::UnitZ(), slow_axis_ = Vec3::UnitZ();  // smoothed
  Vec3 anchor_tip_ = Vec3::Zero(), anchor_axis_ = Vec3::UnitZ();  // the 2 mm are counted from here
  TrialSample puncture_, before_turn_, end_of_phase_1_, start_of_phase_2_;
};

/// Angle between two directions, radians, accurate at 0 and pi.
inline double angleBetween(const Vec3& a, const Vec3& b) {
  return pinned::atan2(a.cross(b).norm(), a.dot(b));
}

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
