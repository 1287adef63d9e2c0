#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "apps/calibrate/collect.h"
#include "apps/station/calibrations.h"

namespace palpa::calibrate {

/// What a whole set-up found.
struct SetupResult {
  std::vector<Result> results;                                ///< in the order of their making
  std::vector<station::AppliedCalibration> calibrations;      ///< the files written
  double seconds = 0;                                         ///< of the program's clock
};

/// Camera, tool, registration (landmarks and tag), time and, where there is one, force sensor: one after the other, each with what the former
/// ones found; every result is written to `folder` as it is made. Throws Error for data that cannot tell an answer: nothing is written of it.
SetupResult setUp(const Scene& scene, Origin origin, const std::filesystem::path& folder);

/// A result as the calibration that a station refers to: written to `folder` as "<kind>.json".
station::AppliedCalibration keep(const Result& result, const std::filesystem::path& folder);

/// The station's file with these calibrations in place of those of the same kind, its paths relative to `file`'s folder. Written whole.
void writeStation(const station::Station& station, const std::vector<station::AppliedCalibration>& calibrations, const std::filesystem::path& file);

}  // namespace palpa::calibrate
