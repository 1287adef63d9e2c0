#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "anatomy/base/json_file.h"
#include "anatomy/geometry/pose.h"
#include "ar/boards/board.h"
#include "haptics/device.h"
#include "haptics/devices/driver.h"
#include "haptics/sensors/net_ft_sensor.h"
#include "haptics/sensors/tool_load.h"

namespace palpa::station {

/// Who moves the tool: "virtual" (the bench's device, held by a simulated operator or led by a
/// person's mouse), the name of one of haptics::drivers(), "mouse" (no haptic device: forces are
/// drawn, not felt), "replay" (the hand of a recorded session).
enum class DeviceDriver { bench, real, mouse, replay };

struct DeviceSetup {
  DeviceDriver driver = DeviceDriver::bench;
  haptics::DeviceCapabilities capabilities;
  double angle_resolution = 0;    ///< rad, of its gimbal's encoders; 0: not known
  double continuous_force_N = 0;  ///< what its drives bear for long; 0: not known
  double thermal_tau = 60;        ///< s
  const haptics::DriverDescription* real = nullptr;  ///< the driver of a real one, and
  haptics::DriverSettings settings;                  ///< its own fields
  std::filesystem::path recording;                   ///< replay: a session.palpa
  /// bits of DeviceReading::buttons; 0: the device has a plunger of its own
  std::uint32_t plunger_button = 0;
};

/// Section "device". Relative paths start at `folder`. Throws UsageError.
DeviceSetup readDevice(const JsonFile& file, const std::filesystem::path& folder);

/// What measures the force; bench: simulated.
enum class ForceSensorDriver { bench, net_ft };

/// A force sensor between the device's last link and the tool: "virtual" (the bench's), "net_ft"
/// (ATI Net F/T or Ethernet Axia over UDP).
struct ForceSensorSetup {
  ForceSensorDriver driver = ForceSensorDriver::bench;
  haptics::NetFtSettings net_ft;  ///< its capabilities hold for every driver
  haptics::ToolLoad tool;         ///< that it carries, and
  haptics::Wrench bias;           ///< what it shows with nothing on it: as calibrated
  double cutoff_Hz = 100;         ///< of the low-pass that takes noise away; not used where
  /// the standard deviation of a sample's force is known: a Kalman filter does it
  std::optional<double> noise_N;
  Pose X_ES = Pose::Identity();  ///< the sensor on the end effector
};

/// Section "force_sensor", where there is one. Throws UsageError.
std::optional<ForceSensorSetup> readForceSensor(const JsonFile& file);

/// {"position_mm": [...], "rotation_vector_deg": [...]} at `at`.
Pose readPose(const JsonFile& file, const std::string& at);

/// A tracking system that measures where the camera is on the table, in place of the board in its
/// pictures: "plus", a PLUS server or any other that speaks OpenIGTLink. K: the marker on the
/// camera, R: the marker on the table; the server sends X_KR. X_CW = X_CK X_KR X_RW.
struct TrackerSetup {
  std::string host = "localhost";
  std::uint16_t port = 18944;
  std::string transform;         ///< as the server names X_KR: "ReferenceToCamera"
  Pose X_CK = Pose::Identity();  ///< the camera's marker in the camera
  Pose X_RW = Pose::Identity();  ///< the board's frame W in the table's marker
  double latency_s = 0;          ///< from the measurement to its arrival here
  double stale_s = 0.1;          ///< beyond, the camera counts as lost
  double sigma = 0.3e-3,
         sigma_rad = 2e-3;  ///< standard deviation of each component of X_CW, m and rad
  /// for servers that send tracking data only when asked; 0: they send by themselves
  int ask_tdata_ms = 0;
};

/// Section "tracker", where there is one. Throws UsageError.
std::optional<TrackerSetup> readTracker(const JsonFile& file);

/// A grid of tags: columns, rows, tag_size_mm, spacing_mm, first_id.
ar::TagGridSpec readBoard(const JsonFile& file, const std::string& at);

/// A board that the camera looks for besides the table's, on the phantom or on the instrument:
/// "boards" of a station's file, a list of
/// {"name", the grid's fields, "X_WB", "tolerance_mm"}. B: the frame of its grid, as W is the
/// table's.
struct OtherBoard {
  std::string name;
  ar::TagGridSpec grid;
  /// where it belongs, if it belongs anywhere: it is told when it is elsewhere
  std::optional<Pose> X_WB;
  double tolerance = 0.003;  ///< m
};

/// A real thing that hides virtual ones in the camera's picture: "real_things", a list of {"mesh":
/// FILE, "unit": "mm", "on": "table" | "tool" | a board's name, "X": pose}.
struct RealThing {
  enum class On { table, tool, board };
  std::filesystem::path mesh;
  double metres = 1e-3;  ///< of the file's unit
  On on = On::table;
  std::size_t board = 0;      ///< index of "boards"
  Pose X = Pose::Identity();  ///< of the mesh in W, T or B
};

/// Throw UsageError: two boards with one name, tags that two boards share, a board that is not
/// there.
std::vector<OtherBoard> readOtherBoards(const JsonFile& file,
                                        const std::vector<ar::TagGridSpec>& others);
std::vector<RealThing> readRealThings(const JsonFile& file, const std::filesystem::path& base,
                                      const std::vector<OtherBoard>& boards);

}  // namespace palpa::station
