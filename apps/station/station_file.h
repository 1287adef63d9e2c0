#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "anatomy/patient.h"
#include "apps/station/device_setup.h"
#include "ar/board.h"
#include "calibration/camera_model.h"
#include "haptics/tick.h"

namespace palpa::station {

/// One training place: its devices and what is believed about them. Relative paths in the file start at
/// the file. A virtual bench draws its truth around these figures.
struct Station {
  std::string id, title;
  bool simulated = true;           ///< something that is seen or felt is the bench's: so far always the camera
  DeviceSetup device;
  std::optional<ForceSensorSetup> force_sensor;
  calibration::CameraModel camera;
  ar::TagGridSpec board;
  double decimate = 2;
  double camera_rate_Hz = 15;
  double camera_latency_s = 0.05;
  Pose X_WD = Pose::Identity();    ///< haptic base on the table: registration
  Pose X_ET = Pose::Identity();    ///< needle tip in the end effector: tool calibration
  Vec3 entry_W = Vec3::Zero();     ///< where the patient's entry point lies: within the hand's reach, whoever the patient is
  haptics::SafetyLimits safety;
  haptics::CouplingLimits coupling;
  haptics::PassivityLimits passivity;   ///< sized from the device's mass and friction
  std::string calibration_verdict; ///< "pass", or what is wrong: a session is then "not scored"
  std::string calibration_date;
  JsonFile file;                   ///< for parts that only others read (the twin's spreads)
};

/// Throws UsageError naming file and field.
Station readStation(const std::filesystem::path& file);

/// Supine, head away from the reader (+y_W), the entry point at `entry_W` (its mirror image across x = 0 for the left
/// side): a device that stands still reaches it in every patient. Throws Error when the patient has none.
Pose placePatient(const anatomy::Patient& patient, const Vec3& entry_W);

/// Supine on the board, back at z_W = 0, centred.
Pose placePatientOnBoard(const anatomy::Patient& patient);

}  // namespace palpa::station
