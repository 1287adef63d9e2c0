#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <string>
#include <vector>

#include "calibration/parts/interaction_features.h"
#include "haptics/augmentation/learned_part.h"
#include "haptics/contact/contact_parts.h"
#include "haptics/loop/tick_config.h"

/// Recorded ticks as steps of what was felt and done, with the hand-written parts of the task
/// beside them.
namespace palpa::calibrate {

/// A step and its columns are the tick's own (haptics/augmentation/learned_part.h): what was
/// learned here means the same there.
using haptics::kInContact, haptics::kLogForce, haptics::kLogShaking, haptics::kLogSpeed;
using haptics::kLeastForce_N, haptics::kLeastShaking_N, haptics::kLeastSpeed;
inline constexpr int kSubtaskFeatures = haptics::kLearnedFeatures;
inline constexpr std::int64_t kSubtaskStep_ns = haptics::kLearnedStep_ns;
inline constexpr double kSpeedTau_s = 0.005;  ///< low-pass of the tip's velocity: encoders' steps
inline constexpr double kBuzzTau_s = 0.002;   ///< what is faster than 80 Hz buzzes [chosen]

struct SubtaskFeatureName {
  const char* name;  ///< in files
  const char* words;
};
const SubtaskFeatureName& subtaskFeatureName(int feature);

/// A stretch of a trial without gap; a row a step of 10 ms.
struct SubtaskSequence {
  std::string trial;         ///< "search, trial 3"
  double begins_s = 0;       ///< of session time
  Eigen::MatrixXd features;  ///< steps x kSubtaskFeatures
  /// steps x kInteractionFeatures: what was done, for the library of interactive procedures
  Eigen::MatrixXd motion;
  /// Bits of the parts that were on for most of the step; of equals those that came first
  std::vector<int> labels;
  /// Number of the part that the task itself said was on, of most of the step (TickCommands)
  std::vector<int> parts;
};

/// Gathers the steps of one trial: every tick of tool 0 that was armed, not held and told finite
/// numbers, in order. What is between is a gap: a new sequence. A step that is not full is left
/// out.
class SubtaskSteps {
 public:
  explicit SubtaskSteps(const haptics::TickConfig& config) : config_(config) {}
  void add(const haptics::FlightRecord& record);
  /// What was gathered; empties.
  std::vector<SubtaskSequence> take();

 private:
  void interrupt();
  void closeStep();
  void count(const haptics::FlightRecord& record);
  Vec3 forceOn(const haptics::FlightRecord& record) const;
  Vec3 tipOf(const haptics::DeviceReading& reading) const;   ///< in D
  Vec3 axisOf(const haptics::DeviceReading& reading) const;  ///< in D, unit, toward the tip
  void closeTool(std::uint32_t ticks, double log_shaking, double contact);

  haptics::TickConfig config_;
  bool running_ = false;
  std::int64_t begin_ns_ = 0, last_ns_ = 0, step_ = 0;
  haptics::PointMotion motion_;
  haptics::StepSums sums_;
  /// bits of the parts that were on in this step, how often
  std::vector<std::pair<int, int>> counted_, parts_counted_;
  std::vector<Eigen::RowVectorXd> rows_;
  std::vector<int> labels_, parts_;
  calibration::ToolStep tool_;      ///< sums over the step's ticks
  Vec3 below_buzz_ = Vec3::Zero();  ///< N, low-passed force
  std::vector<calibration::ToolStep> tools_;
  std::vector<SubtaskSequence> done_;
};

}  // namespace palpa::calibrate
