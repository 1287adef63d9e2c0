#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "calibration/parts/interaction_features.h"

/// A library of interactive procedures, and recordings matched to it: which procedure a hand was
/// performing, step by step.
///
///   ln p(x | procedure) = ln sum_i share_i prod_d [ (1 - e) N(x_d; centre_id, spread_id)
///                                                   + e N(x_d; any_d) ]
///
/// over the procedure's profiles i and the features d; "any" is what hands do at large, and stands
/// in for a feature that a profile does not name; e = 0.02, so that no one feature decides alone.
/// A recording becomes the likeliest row of visits (Viterbi 1967, with least durations: a hidden
/// semi-Markov model, Rabiner 1989, section IV.D): each visit is as long as its procedure at
/// least, then goes on by chance with the procedure's mean duration; any may follow any. Steps that
/// follow each other tell nearly the same: their likelihood counts by step / independent_s. Pure
/// functions.
/// Source of the idea: Edmunds and Pai, Perceptually augmented simulator design (2012), section 5.
namespace palpa::calibration {

/// What a feature is like in one form of a procedure.
struct FeatureRange {
  double centre = 0, spread = 0;  ///< spread 0: the profile does not say
};

struct ProcedureProfile {
  std::string from;                    ///< recordings it was made of, or "written"
  double share = 1;                    ///< of its procedure's time
  double seconds = 0;                  ///< of recordings; 0: written
  std::vector<FeatureRange> features;  ///< kInteractionFeatures
};

/// As in a task's file; "none": nothing helps, or would disturb.
inline constexpr std::array<const char*, 7> kCueKinds{
    "none", "pulse", "vibration", "attraction", "exaggeration", "fixture", "relief"};

/// What is added to the force while a procedure is performed.
struct ProcedureCue {
  std::string kind;  ///< one of kCueKinds
  std::string means, source;
};

struct InteractiveProcedure {
  std::string name, means, source;
  ProcedureCue cue;
  double least_s = 0.1, mean_s = 1;  ///< of a visit
  std::vector<ProcedureProfile> profiles;
};

/// A task's label in the library's words. The first that fits counts.
struct LabelRule {
  std::string task;                ///< its id
  std::vector<std::string> parts;  ///< all on; empty: none is on
  int part = -1;                   ///< number that the task itself says; -1: any
  std::string procedure;           ///< empty: the label does not say what the hand does
  std::string why;
};

struct ProcedureLibrary {
  std::string source, made_by;
  bool simulated = false;
  double independent_s = 0.1;  ///< steps so far apart count as independent
  std::vector<FeatureRange> any;
  std::vector<InteractiveProcedure> procedures;
  std::vector<LabelRule> labels;

  int indexOf(const std::string& procedure) const;  ///< -1: none
};

/// The library as JSON (assets/interactions): a profile's feature as the two figures between which
/// it lies two thirds of the time, in the unit of its name. Throws UsageError or Error with file
/// and field; the file is written whole.
ProcedureLibrary readProcedures(const std::filesystem::path& file);
void writeProcedures(const ProcedureLibrary& library, const std::filesystem::path& file);

/// ln p(x | procedure): a row a step, a column a procedure.
Eigen::MatrixXd procedureLikelihoods(const ProcedureLibrary& library,
                                     const Eigen::MatrixXd& features);

/// Procedure of each step, as the library counts them. Throws Error for a library without
/// procedures or features of another width.
std::vector<int> matchProcedures(const ProcedureLibrary& library, const Eigen::MatrixXd& features);

/// What hands do at large: mean and spread of each feature. Throws Error for no step.
std::vector<FeatureRange> rangesOf(const std::vector<Eigen::MatrixXd>& features);

/// Profiles of steps of one kind, by expectation and maximisation of a mixture of Gaussians
/// (Dempster, Laird, Rubin 1977), features independent within each; `most` at most, fewer where a
/// profile would have less than `least_s` seconds. Spreads are no narrower than the feature's
/// least. Same seed, same bits.
std::vector<ProcedureProfile> fitProfiles(const Eigen::MatrixXd& steps, const std::string& from,
                                          const std::vector<FeatureRange>& any, int most,
                                          double step_s, double least_s, std::uint64_t seed);

}  // namespace palpa::calibration
