#pragma once

#include <string>
#include <vector>

#include "apps/calibrate/sequence.h"
#include "apps/twin/setup_bench.h"

namespace palpa::bench {

/// How far a set-up on the virtual bench is from the simulated truth, and how far it thought it
/// was. For reports and tests only: nothing of it flows back.
struct SetupAccuracy {
  double tip_mm = 0;                    ///< the needle's tip on the end effector
  double target_mm = 0, target_px = 0;  ///< the tip at the entry point: in W, and in the picture
  double predicted_mm = 0, predicted_px = 0;  ///< root mean square, by the covariances
  double offset_ms = 0, offset_sd_ms = 0;  ///< between the clocks, at the middle of the recording
  double seconds = 0;
};

/// `calibrated`: the station with the set-up's calibrations applied.
SetupAccuracy measureAccuracy(const station::Station& before, const station::Station& calibrated,
                              const calibrate::SetupResult& setup, twin::SetupBench& bench);

std::vector<std::string> inWords(const SetupAccuracy& accuracy);
std::string inJson(const SetupAccuracy& accuracy);

}  // namespace palpa::bench
