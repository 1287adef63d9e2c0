#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "anatomy/patient.h"
#include "apps/station/calibrations.h"
#include "apps/station/station_sections.h"
#include "ar/boards/board.h"
#include "calibration/camera_model.h"
#include "haptics/contact/contact_parts.h"
#include "haptics/contact/needle_materials.h"
#include "haptics/loop/workspace_correction.h"
#include "haptics/safety/passivity.h"
#include "haptics/safety/safety_limiter.h"

namespace palpa::station {

/// A point that a tip can be put on, and whether it serves to fit or, untouched by the fit, to
/// judge it.
struct Landmark {
  std::string name;
  Vec3 p_W = Vec3::Zero();
  bool for_check = false;
};

/// A soft sample on the table, and the round tip that feels it. P: origin in the middle of its top,
/// z up.
struct SoftSample {
  Pose X_WP = Pose::Identity();
  double tip_radius = 0.008;  ///< m
};

/// Where a floor to be searched lies in the workspace, and what the device must carry. F: origin in
/// its middle, z up.
struct FloorSetup {
  Pose X_WF = Pose::Identity();
  /// m in the hand for one unit of the floor; coarse devices need a larger one
  double unit = 60e-6;
  double handle_weight_N = 0;  ///< held up by the device
};

/// Where pictures come from; bench: simulated.
enum class CameraDriver { bench, webcam };

/// Whose pictures the station watches.
struct CameraSetup {
  CameraDriver driver = CameraDriver::bench;
  std::string device = "/dev/video0";
  double exposure_ms = 10;
  double gain = -1, focus = -1;  ///< the driver's units; negative: as it is
};

/// What a station's file says of its geometry before anything was calibrated. The virtual bench
/// draws its truth around these.
struct Design {
  calibration::CameraModel camera;
  Pose X_WD = Pose::Identity(), X_ET = Pose::Identity();
  double camera_latency_s = 0.05;
  std::optional<ForceSensorSetup> force_sensor;
};

/// One training place: its devices and what is believed about them. Relative paths in the file
/// start at the file. A virtual bench draws its truth around these figures.
struct Station {
  std::string id, title;
  bool simulated = true;  ///< something that is seen or felt is the bench's
  DeviceSetup device;
  std::optional<ForceSensorSetup> force_sensor;
  calibration::CameraModel camera;
  CameraSetup camera_setup;
  std::optional<TrackerSetup> tracker;  ///< says where the camera is, in place of the board
  ar::TagGridSpec board;
  double decimate = 2;
  std::string stop_pedal;  ///< the kernel's device of a foot switch: an emergency stop; or none
  double camera_rate_Hz = 15;
  double camera_latency_s = 0.05;
  std::vector<OtherBoard> boards;  ///< besides the table's
  std::vector<RealThing> things;   ///< that hide virtual ones in the picture
  /// a small grid of tags on the end effector, for registration and latency
  std::optional<ar::TagGridSpec> marker;
  std::optional<SoftSample> sample;  ///< what palpation, squeezing and their calibrations touch
  std::optional<FloorSetup> floor;   ///< what a search explores
  std::vector<Landmark> landmarks;   ///< known points that a tip can be put on
  /// more of them, evenly through the workspace: for the device's position error
  std::vector<Landmark> grid;
  haptics::WorkspaceCorrection workspace;  ///< of the device's readings
  Pose X_WD = Pose::Identity();            ///< haptic base on the table: registration
  Pose X_ET = Pose::Identity();            ///< needle tip in the end effector: tool calibration
  haptics::ToolShape tool_shape = haptics::ToolShape::point;  ///< that presses on the skin
  /// of another device of the same make, for what takes two tools
  std::optional<Pose> second_X_WD;
  /// Where the patient's entry point lies: within the hand's reach, whoever the patient is
  Vec3 entry_W = Vec3::Zero();
  haptics::SafetyLimits safety;
  haptics::CouplingLimits coupling;
  haptics::PassivityLimits passivity;  ///< sized from the device's mass and friction
  std::string calibration_verdict;  ///< kPassed, or what is wrong: a session is then "not scored"
  std::string calibration_date;     ///< of the oldest
  /// in the order of the file; what they found stands in the figures above
  std::vector<AppliedCalibration> calibrations;
  Design design;
  JsonFile file;  ///< for parts that only others read (the twin's spreads)

  bool calibrated() const { return calibration_verdict == kPassed; }
  /// What is wrong with its calibration; empty: nothing.
  std::string calibrationProblem() const { return calibrated() ? "" : calibration_verdict; }
};

/// Throws UsageError naming file and field.
Station readStation(const std::filesystem::path& file);

/// Puts what the station's calibrations found into its figures, and their verdict into
/// `calibration_verdict`: the first that failed, belongs to another station, was replaced since the
/// station's file was written, or rests on another calibration than the station's.
void applyCalibrations(Station& station);

/// The station with these in place of its calibrations of the same kind.
Station withCalibrations(const Station& station,
                         const std::vector<AppliedCalibration>& calibrations);

/// Finds the first calibration that is older than it is good for on `date` (UTC, as in a
/// calibration file).
void judgeAge(Station& station, const std::string& date);

/// Supine, head away from the reader (+y_W), the entry point at `entry_W` (its mirror image across
/// x = 0 for the left side): a device that stands still reaches it in every patient. Throws Error
/// when the patient has none.
Pose placePatient(const anatomy::Patient& patient, const Vec3& entry_W);

/// Supine on the board, back at z_W = 0, centred.
Pose placePatientOnBoard(const anatomy::Patient& patient);

}  // namespace palpa::station
