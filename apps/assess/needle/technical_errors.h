#pragma once

#include "apps/assess/needle/trial_review.h"

namespace palpa::assess {

/// How far the needle was aimed from the taught direction, in the parts that have names.
struct Aim {
  double steeper = 0;  ///< rad, more toward the back
  /// Rad, in the frontal plane, scaled to a true angle; 0 where the needle is so steep that it
  /// points nowhere there
  double more_cephalad = 0;
};
Aim aimOf(const Vec3& axis_A, const anatomy::LandmarkFrame& frame,
          const calibration::TaughtPath& path);

/// The six common technical errors of subclavian access (Kilbourne et al., J. Am. Coll. Surg. 208,
/// 2009; PMID 19228511), each where it was made, in the order of the procedure. An error is named
/// once a trial, by its worst occurrence. What each is exactly: apps/assess/competence/README.md.
std::vector<TechnicalError> technicalErrors(const TrialReview& review,
                                            const anatomy::LandmarkFrame& frame,
                                            const calibration::TaughtPath& path,
                                            const ScoringRules& rules);

}  // namespace palpa::assess
