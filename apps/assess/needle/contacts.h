#pragma once

#include "apps/assess/needle/assess_trial.h"
#include "apps/assess/needle/intervals.h"

namespace palpa::assess {

/// What a sample touches, judged on the computed geometry and force, so that it means the same with
/// force feedback on and off.
bool touchesLung(const TrialSample& s);    ///< tip in the lung or pressing on the pleura
bool inLung(const TrialSample& s);         ///< tip past the pleura
bool touchesArtery(const TrialSample& s);  ///< tip in the lumen or pressing on the wall
bool touchesVein(const TrialSample& s);
bool inVein(const TrialSample& s);           ///< tip in the lumen
bool touchesBackWall(const TrialSample& s);  ///< of the vein, from inside
bool touchesRibcage(const TrialSample& s);   ///< rib or sternum
bool touchesClavicle(const TrialSample& s);
bool strikesClavicle(const TrialSample& s, const ScoringRules& rules);  ///< above the guiding limit
bool aspirates(const TrialSample& s, const ScoringRules& rules);  ///< plunger drawn in the lumen

bool entersArtery(Samples samples);     ///< the tip was in the lumen of an artery at any time
bool piercesBackWall(Samples samples);  ///< of the vein

/// Sample at which the tip had been in the lumen with the plunger drawn for `dwell_s`; the last one
/// when that never happened.
std::size_t successSample(Samples samples, const ScoringRules& rules);

/// The successful entry: the last stay at the vein (wall or lumen, gaps of tremor bridged) in which
/// the tip was in the lumen. Null when the tip never was.
struct FinalStay {
  bool found = false;
  Interval interval;
  bool covers(std::size_t sample) const {
    return found && sample >= interval.first && sample <= interval.last;
  }
};
FinalStay finalStay(Samples samples);

struct CollisionCounts {
  int lung = 0, rib = 0, artery = 0, vein = 0;
};

/// Scoring samples in contact; of bone in the rules' unit. `stay` is where contact with the vein is
/// wanted (not found: nowhere); its back wall counts everywhere.
CollisionCounts countCollisions(Samples samples, const FinalStay& stay, const ScoringRules& rules);

/// Closest the tip came to an organ while inserted, looked at `rate_Hz` times a second.
struct ClosestApproach {
  double distance;  ///< m; negative: inside; infinite when never inserted or no such organ
  double t_s = -1;
};
ClosestApproach nearMiss(Samples samples, Organ organ, const OrganDistance& distance,
                         double rate_Hz);

}  // namespace palpa::assess
