#pragma once

#include "apps/assess/needle/trial_assessment.h"
#include "apps/training/trial_clock.h"
#include "haptics/flight_record.h"

namespace palpa::assess {

/// Turns recorded ticks of one trial into samples in the patient's frame. The trial's clock runs
/// while the device is armed: pauses do not count.
class TrialSampler {
 public:
  TrialSampler(const Pose& X_AD, const PackedPose& X_ET) : X_AD_(X_AD), X_ET_(unpack(X_ET)) {}

  /// Starts a trial; ticks of other trials are then ignored.
  void begin(std::uint32_t trial);
  /// False when the tick does not belong to the trial, or while it is paused.
  bool add(const haptics::FlightRecord& record, TrialSample* sample);

 private:
  Pose X_AD_, X_ET_;
  std::uint32_t trial_ = 0;
  training::TrialClock clock_;
  std::uint32_t pending_events_ = 0;  ///< of ticks that were left out
};

}  // namespace palpa::assess
