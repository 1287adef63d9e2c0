#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <string>
#include <vector>

#include "haptics/contact_parts.h"
#include "haptics/tick.h"

/// Recorded ticks as steps of what was felt and done, with the hand-written parts of the task beside them.
namespace palpa::calibrate {

inline constexpr std::int64_t kSubtaskStep_ns = 10'000'000;
inline constexpr double kLeastSpeed = 1e-3;       ///< m/s: below a hand's tremble speeds are alike [chosen]
inline constexpr double kLeastForce_N = 0.02;     ///< below what a fingertip tells forces are alike [chosen]; contact from here on
inline constexpr double kLeastShaking_N = 0.005;  ///< [chosen]
inline constexpr double kSpeedTau_s = 0.005;      ///< low-pass of the tip's velocity: encoders' steps
inline constexpr double kShakingTau_s = 0.008;    ///< what is faster than 1 / (2 pi tau) = 20 Hz is shaking: hands do not do it [chosen]

/// Columns of a step.
enum SubtaskFeature : int { kLogSpeed, kLogForce, kInContact, kLogShaking, kSubtaskFeatures };
struct SubtaskFeatureName {
  const char* name;    ///< in files
  const char* words;
};
const SubtaskFeatureName& subtaskFeatureName(int feature);

/// A stretch of a trial without gap. A row a step of 10 ms, of the step's mean speed v (m/s) of the tip, mean contact force f (N), share c of the time in contact and root mean square s (N)
/// of the force less its low-pass:  ln max(v, 1 mm/s)   ln max(f, 0.02 N)   c   ln max(s, 0.005 N)
struct SubtaskSequence {
  std::string trial;              ///< "search, trial 3"
  double begins_s = 0;            ///< of session time
  Eigen::MatrixXd features;       ///< steps x kSubtaskFeatures
  std::vector<int> labels;        ///< bits of the parts that were on for most of the step; of equals those that came first
};

/// Gathers the steps of one trial: every tick of tool 0 that was armed, not held and told finite numbers, in order. What is between is a gap: a new sequence. A step that is not full is left out.
class SubtaskSteps {
 public:
  explicit SubtaskSteps(const haptics::TickConfig& config) : config_(config) {}
  void add(const haptics::FlightRecord& record);
  /// What was gathered; empties.
  std::vector<SubtaskSequence> take();

 private:
  struct Sums {
    int ticks = 0;
    double speed = 0, force = 0, contact = 0, shaking2 = 0;
    std::vector<std::pair<int, int>> labels;   ///< bits, how often
  };
  void interrupt();
  void closeStep();
  void count(const haptics::FlightRecord& record);
  Vec3 forceOn(const haptics::FlightRecord& record) const;
  Vec3 tipOf(const haptics::DeviceReading& reading) const;   ///< in D

  haptics::TickConfig config_;
  bool running_ = false;
  std::int64_t begin_ns_ = 0, last_ns_ = 0, step_ = 0;
  haptics::PointMotion motion_;
  Vec3 slow_force_ = Vec3::Zero();
  Sums sums_;
  std::vector<Eigen::RowVectorXd> rows_;
  std::vector<int> labels_;
  std::vector<SubtaskSequence> done_;
};

}  // namespace palpa::calibrate
