#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "anatomy/geometry/local_geometry.h"
#include "anatomy/geometry/pose.h"
#include "apps/assess/metrics/metric_table.h"
#include "apps/assess/needle/paracentesis_score.h"
#include "apps/assess/trial.h"
#include "apps/training/trial_words.h"
#include "haptics/flight_record.h"

namespace palpa::assess {

/// One recorded tick in the patient's frame A.
struct TrialSample {
  double t_s = 0;  ///< since the trial's start
  Vec3 tip_A = Vec3::Zero();
  Vec3 axis_A = Vec3::UnitZ();  ///< unit, toward the tip
  Vec3 bevel_A = Vec3::Zero();  ///< unit, whither the bevel's opening faces; zero: not known
  haptics::NeedlePhase phase = haptics::NeedlePhase::outside;
  Tissue tissue = Tissue::air;
  Organ wall = Organ::none;
  Organ bone = Organ::none;
  bool wall_leaving = false;  ///< the wall is the far one: tip inside, pressing outward
  double depth = 0;           ///< m
  double bone_force = 0;      ///< N
  double f_contact = 0;       ///< N, magnitude computed
  double f_command = 0;       ///< N, magnitude rendered
  double plunger = 0;
  bool waiting = false;        ///< for the answer what was aspirated: not in TIME
  std::uint32_t events = 0;    ///< haptics::TickEvent bits, merged over the samples left out
  std::uint32_t subtasks = 0;  ///< bit i: part i of the task is on
};

/// One line of the score with its reason.
struct Penalty {
  std::string code;      ///< "COL_LUNG", ...
  std::string title;     ///< "Lung touched"
  std::string sentence;  ///< "The needle was in the lung for 0.4 s, first at 12.4 s."
  double value = 0;
  double weight = 0;
  double points = 0;              ///< weight x value
  std::vector<double> moments_s;  ///< when it happened (starts of the spans); may be empty
  std::string unit = {};          ///< of the value
};

/// One of the six common errors of subclavian access that was made.
struct TechnicalError {
  std::string code;   ///< "site", "landmarks", "periosteum", "shallow", "cephalad", "left_vein"
  std::string title;  ///< "Too cephalad"
  /// "The needle was aimed 14° too far toward the head over 12.0 mm, from 8.2 s on (...): ..."
  std::string sentence;
  double t_s = 0;
  double value = 0, threshold = 0;
  std::string unit;  ///< of both
  int times = 1;
};

/// What a stretch of the trial means: a phase of the procedure, or what was touched in it. In the
/// order of the rows of a timeline.
enum class SpanKind : std::uint8_t { phase, guide, good, bad };

/// A stretch of the trial for the timeline.
struct Span {
  std::string label;  ///< "phase 1", "in the vein", "clavicle", ...
  SpanKind kind = SpanKind::phase;
  double from_s = 0, to_s = 0;
};

struct Moment {
  double t_s = 0;
  std::string kind;  ///< "puncture", "reorient", "vein", "flash", "success", "bone", "lung", ...
  std::string text;  ///< clinical words
};

struct TrialAssessment {
  int trial = 0;
  training::Role role = training::Role::none;
  bool simulated = false;
  bool force_feedback = true;
  std::uint64_t seed = 0;
  training::Outcome outcome = training::Outcome::none;
  std::string summary;  ///< one or two plain sentences
  std::string rules;    ///< their version
  ParacentesisValues values;
  double total = 0;
  std::vector<Penalty> penalties;
  /// "lung", "artery": what the patient's model lacks, so that no line of the score is about it
  std::vector<std::string> not_judged = {};
  std::vector<TechnicalError> errors = {};  ///< in the order of the procedure
  std::vector<Span> spans;
  std::vector<Moment> moments;
  /// Of the tip while inserted; negative: inside. Infinite, with moment -1, when the needle was
  /// never inserted or the patient has no such organ.
  double closest_pleura_mm = 0, closest_artery_mm = 0;
  double closest_pleura_s = 0, closest_artery_s = 0;
  int skin_punctures = 0;
  bool by_path = true;  ///< false: the task has a goal of its own, and only success and time tell
  bool augmented = false;          ///< the task's augmentations added force
  std::vector<SubtaskDose> doses;  ///< of the task's parts
  /// in phase 2: drawn back > 3 mm, advanced > 3 mm again, > 3 degrees apart
  int redirections = 0;
  std::vector<metrics::MetricValue> metrics = {};  ///< by the names of metric_table
};

}  // namespace palpa::assess
