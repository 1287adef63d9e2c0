#pragma once

#include "anatomy/patient.h"
#include "apps/assess/needle/assess_trial.h"
#include "apps/assess/needle/contacts.h"
#include "apps/assess/needle/phases.h"

namespace palpa::assess {

/// PHASE_1: where the skin was punctured and how deep before the turn, against the experts.
struct EntryError {
  bool punctured = false;
  Vec3 offset_L = Vec3::Zero();  ///< entry minus optimum: medial, posterior, cephalad, m
  double depth_error = 0;        ///< m, positive: too deep
  double value_mm = 0;           ///< |offset| + |depth error|
};

/// With a pass: the tip at the puncture; depth at the end of phase 1, without a turn the deepest
/// before phase 2. Never punctured: distance of the last tip from the optimal entry, at most 50 mm,
/// plus the whole optimal depth.
EntryError entryError(const Pass* pass, Samples samples, const anatomy::LandmarkFrame& frame,
                      const calibration::TaughtPath& path);

/// PHASE_2: direction at the start of phase 2 against the experts' mean.
struct DirectionError {
  enum class Judged { at_phase_2, at_last_insertion, never };
  Judged judged = Judged::never;
  double angle = 0;          ///< rad
  double steeper = 0;        ///< rad, more toward the back than taught
  double more_cephalad = 0;  ///< rad, in the frontal plane, scaled to a true angle
  double value = 0;          ///< 1000 x angle / acceptable
};

/// A direction against the taught one; `judged` and the cap of `value` are the caller's.
DirectionError comparedWith(const Vec3& axis_L, const calibration::TaughtPath& path);

/// Phase 2 not reached: the last direction while inserted, value at most 5000; never inserted:
/// 5000.
DirectionError directionError(const Pass* pass, Samples samples,
                              const anatomy::LandmarkFrame& frame,
                              const calibration::TaughtPath& path);

/// ECON: in phase 2, mean and variance over its samples of
///   e = (d(tip) + d(shaft point)) / 2,
/// d the distance from the infinite line through the experts' line_from and line_to. Zero without
/// phase 2.
struct Economy {
  double mean_mm = 0, variance_mm2 = 0;
  double largest_mm = 0, largest_s = 0;
};
Economy economy(const Pass* pass, Samples samples, const anatomy::LandmarkFrame& frame,
                const calibration::TaughtPath& path, double shaft_point);

/// Everything measured in a trial, once; the sentences, the timeline and the summary read it.
struct TrialReview {
  TrialReview() = default;
  TrialReview(TrialReview&&) = default;  // `pass` points into `history`: movable, not copyable

  Samples samples;      ///< up to the end that is scored
  double end_s = 0;     ///< moment of success, else the last sample
  bool asked = false;   ///< what was aspirated
  double waited_s = 0;  ///< until then, for an answer: not in TIME
  double time_s() const { return end_s - waited_s; }
  bool success = false;
  PhaseHistory history;
  const Pass* pass = nullptr;  ///< the scored one, in `history`; null: never punctured
  FinalStay stay;              ///< found only after success
  EntryError entry;
  std::vector<double> entry_distances;  ///< of every pass from the optimal entry, m
  DirectionError direction;
  Economy economy;
  bool has_lung = true, has_artery = true;  ///< the patient
  std::vector<Interval> lung_touched, lung, artery, ribcage, clavicle, clavicle_struck;
  std::vector<Interval> vein_unneeded, vein_lumen, back_wall;
  ClosestApproach pleura_miss, artery_miss;
  ParacentesisValues values;
};

/// `all`, `path` and `rules` must outlive the review. Throws Error on samples or a path that cannot
/// be scored (not finite, time running backward, no acceptable deviation).
TrialReview review(const TrialFacts& facts, Samples all, const anatomy::LandmarkFrame& frame,
                   const OrganDistance& distance, const calibration::TaughtPath& path,
                   const ScoringRules& rules);

/// Largest force on bone in some stretches, N.
double peakBoneForce(Samples samples, const std::vector<Interval>& stretches);

}  // namespace palpa::assess
