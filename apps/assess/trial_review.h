#pragma once

#include "apps/assess/contacts.h"
#include "apps/assess/near_miss.h"
#include "apps/assess/passes.h"
#include "apps/assess/path_errors.h"

namespace palpa::assess {

/// Everything measured in a trial, once; the sentences, the timeline and the summary read it.
struct TrialReview {
  TrialReview() = default;
  TrialReview(TrialReview&&) = default;  // `pass` points into `history`: movable, not copyable

  Samples samples;   ///< up to the end that is scored
  double end_s = 0;  ///< moment of success, else the last sample
  bool success = false;
  PhaseHistory history;
  const Pass* pass = nullptr;  ///< the scored one, in `history`; null: never punctured
  FinalStay stay;              ///< found only after success
  EntryError entry;
  std::vector<double> entry_distances;  ///< of every pass from the optimal entry, m
  DirectionError direction;
  Economy economy;
  std::vector<Interval> lung_touched, lung, artery, ribcage, clavicle, clavicle_struck;
  std::vector<Interval> vein_unneeded, vein_lumen, back_wall;
  NearMiss pleura_miss, artery_miss;
  ParacentesisValues values;
};

/// `all`, `path` and `rules` must outlive the review. Throws Error on samples or a path that cannot
/// be scored (not finite, time running backward, no acceptable deviation).
TrialReview review(const TrialFacts& facts, Samples all, const anatomy::LandmarkFrame& frame,
                   const OrganDistance& distance, const calibration::ExpertPath& path,
                   const ScoringRules& rules);

/// Largest force on bone in some stretches, N.
double peakBoneForce(Samples samples, const std::vector<Interval>& stretches);

}  // namespace palpa::assess
