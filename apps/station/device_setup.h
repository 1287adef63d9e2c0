#pragma once

#include <filesystem>
#include <optional>

#include "apps/station/json_file.h"
#include "haptics/device.h"
#include "haptics/sensors/net_ft_sensor.h"
#include "haptics/sensors/wrench_filter.h"

namespace palpa::station {

/// Who moves the tool: "virtual" (the bench's device, held by a simulated operator or led by a
/// person's mouse), "falcon" (a Novint Falcon on USB), "mouse" (no haptic device: forces are drawn,
/// not felt), "replay" (the hand of a recorded session).
enum class DeviceDriver { bench, falcon, mouse, replay };

struct DeviceSetup {
  DeviceDriver driver = DeviceDriver::bench;
  haptics::DeviceCapabilities capabilities;
  double continuous_force_N = 0;    ///< what its drives bear for long; 0: not known
  double thermal_tau = 60;          ///< s
  std::filesystem::path firmware;   ///< falcon: its maker's file; empty: it must be running
  std::filesystem::path recording;  ///< replay: a session.palpa
  std::uint32_t plunger_button =
      0;  ///< bits of DeviceReading::buttons; 0: the device has a plunger of its own
};

/// Section "device". Relative paths start at `folder`. Throws UsageError.
DeviceSetup readDevice(const JsonFile& file, const std::filesystem::path& folder);

/// A force sensor between the device's last link and the tool: "virtual" (the bench's), "net_ft"
/// (ATI Net F/T or Ethernet Axia over UDP).
struct ForceSensorSetup {
  enum class Driver { bench, net_ft };
  Driver driver = Driver::bench;
  haptics::NetFtSettings net_ft;  ///< its capabilities hold for every driver
  haptics::WrenchFilter
      filter;  ///< bias and tool, as calibrated; its rate and low-pass are the loop's to set
  double cutoff_Hz = 100;
  Pose X_ES = Pose::Identity();  ///< the sensor on the end effector
};

/// Section "force_sensor", where there is one. Throws UsageError.
std::optional<ForceSensorSetup> readForceSensor(const JsonFile& file);

/// {"position_mm": [...], "rotation_vector_deg": [...]} at `at`.
Pose readPose(const JsonFile& file, const std::string& at);

}  // namespace palpa::station
