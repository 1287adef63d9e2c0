#pragma once

#include <filesystem>
#include <optional>

#include "apps/doctor/finding.h"
#include "apps/station/station_file.h"

namespace palpa::doctor {

/// The station's file; nothing where it cannot be read (the finding says why).
std::optional<station::Station> readStation(const std::filesystem::path& file, Findings* findings);

/// Each calibration: there, passed, of this station, not replaced, rests on the others, not too old
/// on `now_utc`, not made later than it.
Findings judgeCalibrations(const station::Station& station, const std::string& now_utc);

/// The printed board's size: `bar_mm` is what a ruler says of the bar of 100 mm beside it; 0:
/// nobody measured. A registration by a tag on the tool has compared camera and device.
Finding judgePrint(const station::Station& station, double bar_mm);

/// The stop pedal, asked for whether it can be heard; a session does not start without one that the
/// station names.
Finding askPedal(const station::Station& station);

/// A store of records: its version, whether it is empty, damaged or cannot be reached, how many
/// sessions wait for it. A session starts without it; what was recorded is delivered later. It is
/// only looked at: nothing is made, filled or migrated.
Finding askRecords(const std::string& url, std::size_t waiting);

}  // namespace palpa::doctor
