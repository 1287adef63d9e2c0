#pragma once

#include <functional>
#include <string>
#include <vector>

#include "anatomy/patient.h"
#include "anatomy/query/surface_query.h"
#include "apps/assess/needle/trial_assessment.h"
#include "apps/training/trial_words.h"
#include "calibration/expert_path.h"

namespace palpa::assess {

/// From where on the six common errors of subclavian access are named (see
/// apps/assess/competence/README.md). Ours; set in the task's file under "errors".
struct ErrorRules {
  double site_off = 0.008;       ///< m, of the puncture from the taught one, across the clavicle
  double landmark_off = 0.012;   ///< m, the same along the clavicle
  double too_shallow = 0.1745;   ///< rad (10 deg), flatter than taught
  double too_cephalad = 0.1745;  ///< rad, more toward the head than taught
  double too_caudal = 0.2618;    ///< rad (15 deg): aimed below the notch, which was not found
  double aim_travel = 0.005;     ///< m that the needle must be advanced so
  double periosteum_N = 5.0;     ///< on the clavicle ...
  double periosteum_s = 0.1;     ///< ... at a stretch
  double blood_s = 0.2;          ///< plunger drawn in the lumen: the vein was reached
};

/// The newest scoring rules, by which a trial is scored unless its task says otherwise.
inline constexpr char kNewestRules[] = "2";
/// Those of the source: one path, steps in a weight, scoring samples.
inline constexpr char kPublishedRules[] = "as published";

/// Settings that are ours, where Tzafestas et al. 2008 are silent. Every figure can be set in the
/// task's file.
struct ScoringRules {
  /// Scores under different ones are not compared. "1": of tasks written before rules had names.
  std::string version = "1";
  double sample_rate_Hz = 20;  ///< COL_* counts samples at this rate
  /// contact with the clavicle below this guides, and is not counted
  double clavicle_guide_N = 3.0;
  double dwell_s = 1.0;         ///< tip in the lumen with the plunger drawn this long: success
  double plunger_drawn = 0.25;  ///< fraction that counts as drawn
  double shaft_point = 0.070;   ///< m behind the tip, second point of ECON
  BoneUnit bone_unit = BoneUnit::samples;
  /// s: so soon after `dwell_s` it must be said what was aspirated; 0: nobody asks
  double told_within_s = 0;
  ScoreWeights weights;
  ErrorRules errors;
};

struct TrialFacts {
  int trial = 0;
  training::Role role = training::Role::none;
  bool simulated = false, force_feedback = true;
  std::uint64_t seed = 0;
  training::Outcome outcome = training::Outcome::none;
};

/// The patient's own teaching line: from the entry point, along the skin's normal there, to the
/// vein's target, as its landmarks and its skin say. Throws Error where one of them is missing.
calibration::TeachingLine teachingLineOf(const anatomy::Patient& patient,
                                         const anatomy::SurfaceQuery& query);

/// The score of one trial with its reasons. Reads the record only: `samples` are all ticks of the
/// trial in A (1 kHz or any rate), nothing of the simulation's truth.
TrialAssessment assessTrial(const TrialFacts& facts, const std::vector<TrialSample>& samples,
                            const anatomy::Patient& patient, const anatomy::SurfaceQuery& query,
                            const calibration::TaughtPath& path, const ScoringRules& rules);

/// Signed distance of a point from an organ of the patient (negative inside), metres; infinite when
/// he has none.
using OrganDistance = std::function<double(Organ organ, const Vec3& p_A)>;

/// The same with the distances given by a function; the one above asks the meshes.
TrialAssessment assessTrial(const TrialFacts& facts, const std::vector<TrialSample>& samples,
                            const anatomy::Patient& patient, const OrganDistance& distance,
                            const calibration::TaughtPath& path, const ScoringRules& rules);

/// What an expert's trial on a body with this line says about the path; false when it has no
/// complete phase 2: the needle was turned, advanced, and its tip was in the lumen of the vein at
/// the end.
bool expertTrial(const std::vector<TrialSample>& samples, const anatomy::LandmarkFrame& frame,
                 const calibration::TeachingLine& line, const std::string& expert,
                 calibration::ExpertTrial* trial);

}  // namespace palpa::assess
