#pragma once

#include <string>

#include "apps/doctor/finding.h"
#include "apps/link/igtl/tracker_client.h"
#include "apps/station/tracker_setup.h"

namespace palpa::doctor {

/// What came of a tracking system in some time after its first message, or while it was waited for.
struct TrackerFacts {
  igt::TrackerCounts counts;
  double seconds = 0;
  std::string trouble = {};  ///< it could not even be asked: why
};
Finding judgeTracker(const TrackerFacts& facts, const station::TrackerSetup& setup);

/// The tracking system that a station names, listened to for a second; given up when nothing has
/// come in `wait_s`.
Finding askTracker(const station::TrackerSetup& setup, double wait_s = 3);

}  // namespace palpa::doctor
