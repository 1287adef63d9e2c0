#pragma once

#include <string>
#include <vector>

#include "apps/assess/needle/intervals.h"
#include "apps/assess/needle/trial_review.h"

namespace palpa::assess {

std::string millimetres(double metres);  ///< "4.1 mm"
std::string degrees(double radians);     ///< "8°"; one decimal below 2°
std::string seconds(double s);           ///< "0.4 s"; two decimals below 0.1 s
std::string newtons(double n);           ///< "2.2 N"
std::string counted(int n, const std::string& one, const std::string& many);  ///< "2 punctures"

/// "for 0.4 s at 12.4 s", "for 1.2 s in 3 contacts, first at 12.4 s".
std::string duration(const std::vector<Interval>& stretches);

/// " (3.0 mm too lateral, 2.8 mm too caudal)" from an offset (medial, posterior, cephalad), largest
/// first; parts below 0.5 mm are left out; empty when all are.
std::string offsetWords(const Vec3& offset_L);

/// "a", "a and b", "a, b and c".
std::string list(const std::vector<std::string>& parts);

/// The nine lines of the score, in the order of Tzafestas et al. 2008, each with its reason in
/// clinical words. A line without penalty says briefly what was right; of an organ that the patient
/// lacks there is none.
std::vector<Penalty> explain(const TrialReview& review, const calibration::TaughtPath& path,
                             const ScoringRules& rules);

/// The same in parts: COL_*, and the rest.
std::vector<Penalty> explainCollisions(const TrialReview& review, const ScoringRules& rules);
std::vector<Penalty> explainPath(const TrialReview& review, const calibration::TaughtPath& path,
                                 const ScoringRules& rules);

/// Verdict first, then the largest penalty.
std::string summarise(const TrialFacts& facts, const TrialReview& review,
                      const std::vector<Penalty>& penalties);

/// Stretches for the timeline: phases, then what was touched. Ordered by kind of thing, then time.
std::vector<Span> timelineSpans(const TrialReview& review, const ScoringRules& rules);

/// What happened when, in clinical words, in order of time.
std::vector<Moment> timelineMoments(const TrialFacts& facts, const TrialReview& review,
                                    const ScoringRules& rules);

}  // namespace palpa::assess
