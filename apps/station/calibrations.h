#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "anatomy/base/json_file.h"
#include "apps/station/calibration_file.h"

namespace palpa::station {

/// A calibration that a station refers to.
struct AppliedCalibration {
  CalibrationFile file;
  std::filesystem::path path;
  std::string sha256;         ///< of the file as it is
  std::string sha256_wanted;  ///< of the file that the station was set up with
};

/// Section "calibrations" of a station file: [{"kind", "path", "sha256", "date", "verdict"}], paths
/// relative to `folder`. Throws UsageError for a wrong section, Error for a calibration that is
/// damaged or foreign.
std::vector<AppliedCalibration> readCalibrations(const JsonFile& file,
                                                 const std::filesystem::path& folder);

/// Of a kind; nullptr when the station has none.
const AppliedCalibration* calibrationOf(const std::vector<AppliedCalibration>& calibrations,
                                        CalibrationKind kind);

/// The same section for a station file that refers to `calibrations`, paths relative to `folder`.
nlohmann::json toJson(const std::vector<AppliedCalibration>& calibrations,
                      const std::filesystem::path& folder);

/// What is wrong with one among a station's ("the tool calibration failed: ..."), age apart; empty:
/// nothing.
std::string faultIn(const AppliedCalibration& one,
                    const std::vector<AppliedCalibration>& calibrations,
                    const std::string& station);
/// The first of them with which something is wrong.
std::string faultOf(const std::vector<AppliedCalibration>& calibrations,
                    const std::string& station);

/// Whether one is older than it is good for on `date`; empty: none is.
std::string outdatedOn(const std::vector<AppliedCalibration>& calibrations,
                       const std::string& date);

}  // namespace palpa::station
