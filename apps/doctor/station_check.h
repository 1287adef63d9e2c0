#pragma once

#include <filesystem>
#include <optional>

#include "apps/doctor/finding.h"
#include "apps/station/station_file.h"

namespace palpa::doctor {

/// The station's file; nothing where it cannot be read (the finding says why).
std::optional<station::Station> readStation(const std::filesystem::path& file, Findings* findings);

/// Each calibration: there, passed, of this station, not replaced, rests on the others, not too old on `now_utc`, not made later than it.
Findings judgeCalibrations(const station::Station& station, const std::string& now_utc);

/// A store of records: can be opened, how many trials wait for it. A session starts without it; what was recorded is delivered later.
/// A file that is not there yet is not made.
Finding askRecords(const std::string& url, std::size_t waiting);

}  // namespace palpa::doctor
