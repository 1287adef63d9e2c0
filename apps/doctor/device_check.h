#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "apps/doctor/finding.h"
#include "apps/link/igtl/tracker_client.h"
#include "apps/station/station_file.h"
#include "apps/station/station_sections.h"
#include "haptics/devices/driver.h"

namespace palpa::doctor {

/// What a driver says after its device has been tried; `words`: what is wrong, or what to do.
Finding judgeDriver(const haptics::DriverStatus& status, const std::string& device,
                    const std::string& words);

/// What a driver found of the things that its device needs.
Findings askNeeds(const station::DeviceSetup& setup);

/// Where udev finds its rules; of two files of one name the first counts.
const std::vector<std::filesystem::path>& udevFolders();
/// The rule that lets whoever sits at the station open a device on USB.
Finding askUdevRule(const std::vector<std::filesystem::path>& folders,
                    const haptics::DriverDescription& device);

/// What becomes of the device's force when the program dies.
Finding sayWatchdog(const haptics::DeviceCapabilities& device);

/// The station's haptic device, tried for a second or two; nothing is moved by it, no force is
/// rendered.
Finding askDevice(const station::DeviceSetup& setup);

/// What came of a force sensor in some time.
struct SensorFacts {
  std::uint64_t records = 0, lost = 0, faults = 0;
  double seconds = 0;
  std::string trouble;  ///< it could not be opened: why
};
Finding judgeSensor(const SensorFacts& facts);

/// The station's force sensor, listened to for half a second.
Finding askSensor(const station::Station& station);

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
