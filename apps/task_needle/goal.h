#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "apps/assess/trial_assessment.h"
#include "apps/task_needle/task_words.h"

namespace palpa::task_needle {

/// What a trial is for, where no optimal path is known: a part of the task to be in for a while.
///   "goal": {"part": "seated", "for_s": 1, "means": "the pin is seated in cancellous bone"}
struct Goal {
  std::size_t part = 0;  ///< of the task's subtasks
  double for_s = 0;      ///< at a stretch
  std::string means;
};

/// Follows a trial toward its goal, and tells its course: when which part was on, what was
/// punctured.
class GoalTrial {
 public:
  GoalTrial() = default;
  GoalTrial(const Goal& goal, std::vector<std::string> parts, const TaskWords& words)
      : goal_(goal), parts_(std::move(parts)), words_(words) {}

  void add(const assess::TrialSample& sample);  ///< every tick of the trial
  bool reached() const { return held_s_ >= goal_.for_s && in_goal_; }
  /// Of the parts that are on the last in the file; empty: none is.
  std::string step() const;
  /// Success and time, course, summary.
  void tell(assess::TrialAssessment* assessment) const;

 private:
  Goal goal_;
  std::vector<std::string> parts_;
  TaskWords words_;
  std::uint32_t on_ = 0;
  bool in_goal_ = false;
  double held_s_ = 0, t_s_ = 0, deepest_ = 0;
  int punctures_ = 0;
  std::vector<double> since_s_;
  std::vector<assess::Span> spans_;
  std::vector<assess::Moment> moments_;
};

}  // namespace palpa::task_needle
