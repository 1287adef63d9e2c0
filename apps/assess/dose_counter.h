#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "apps/assess/trial.h"
#include "apps/training/trial_clock.h"
#include "haptics/augmentation/augmentation.h"
#include "haptics/flight_record.h"

namespace palpa::assess {

/// Adds up over recorded ticks how long each part of a task was on, how often it came on, and how
/// much was added to the force meanwhile. What is added counts for every part that an active
/// augmentation belongs to. Augmentations of no part in particular have a row of their own, the
/// last, "any part", which is always on. A hand that trembles across a part's limit does it once,
/// on one occasion, however often it comes on: it was not left for kLeft_s.
class DoseCounter {
 public:
  static constexpr double kLeft_s = 0.25;  ///< [chosen] no hand leaves and comes back faster

  DoseCounter() = default;
  DoseCounter(const haptics::AugmentationPlan& plan, const std::vector<std::string>& subtasks);
  /// The next tick of the trial, `dt` seconds after the one before.
  void add(const haptics::FlightRecord& record, double dt);
  const std::vector<SubtaskDose>& doses() const { return doses_; }

 private:
  std::vector<SubtaskDose> doses_;
  std::array<std::uint8_t, haptics::kMostAugmentations> part_of_{};  ///< of each augmentation
  std::size_t parts_ = 0;                                            ///< named ones
  std::vector<double> left_s_;  ///< for how long each has not been on; at first for ever
};

/// The doses of one trial after another, from every tick as it was recorded.
class TrialDoses {
 public:
  TrialDoses() = default;
  TrialDoses(const haptics::AugmentationPlan& plan, std::vector<std::string> subtasks)
      : plan_(plan), subtasks_(std::move(subtasks)) {}
  void begin(std::uint32_t trial);
  /// Counts while the trial is on and forces may be rendered; what lies between two ticks far apart
  /// was a pause.
  void add(const haptics::FlightRecord& record);
  const std::vector<SubtaskDose>& doses() const { return counter_.doses(); }

 private:
  haptics::AugmentationPlan plan_;
  std::vector<std::string> subtasks_;
  DoseCounter counter_;
  std::uint32_t trial_ = 0;
  training::TrialClock clock_;
};

}  // namespace palpa::assess
