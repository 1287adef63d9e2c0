#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "anatomy/geometry/pose.h"
#include "calibration/camera_model.h"

namespace palpa::station {

/// The verdict of what is good; every other one says what is wrong.
inline constexpr std::string_view kPassed = "pass";

/// What is calibrated, each by the routine of its name: `palpa calibrate force-sensor`.
enum class CalibrationKind : std::uint8_t {
  camera,
  tool,
  workspace,
  registration,
  latency,
  force_sensor,
  material,
  friction,
  inclusion,
  object,
  texture,
  subtasks
};

/// "camera", ..., "force-sensor", ...: in files, of commands and on pages.
const std::string& nameOf(CalibrationKind kind);

/// None for an unknown name.
std::optional<CalibrationKind> calibrationKindNamed(std::string_view name);

/// What a calibration routine leaves behind: parameters, how sure they are, what is left over, from
/// which data, when, and the verdict. JSON, format "palpa calibration"; the unit is the end of a
/// number's name ("position_m", "fx_px"). The file carries a checksum of itself, so that a damaged
/// or edited one is told from a true one.
struct CalibrationFile {
  struct Numbers {
    std::string name;  ///< ends with the unit
    std::vector<double> values;
  };
  struct Residuals {
    std::string unit;
    double rms = 0;
    std::vector<double> values;  ///< one a measurement
    std::vector<int> left_out;   ///< measurements that did not fit the others, from 0
  };
  struct Data {
    int samples = 0, used = 0;
    std::string source;  ///< "virtual bench, seed 5", "recorded files"
    struct File {
      std::string name, sha256;
    };
    std::vector<File> files;  ///< that the samples were recorded in
  };
  struct Check {
    std::string name;  ///< in words: "tip at points not used"
    double value = 0, limit = 0;
    std::string unit;
    bool passed() const { return value <= limit; }
  };
  struct Rest {
    std::string kind, sha256;  ///< another calibration that this one was computed with, as written
  };

  CalibrationKind kind = CalibrationKind::camera;
  std::string station;  ///< its id
  std::string date;     ///< UTC, "2026-03-01T12:30:00Z"
  std::string made_by;  ///< the command
  bool simulated = false;
  int valid_days = 0;
  std::vector<Numbers> parameters;
  std::vector<std::string> coordinates;  ///< of the covariance: name and unit of each
  Eigen::MatrixXd covariance;            ///< SI units, px for what is in px
  Residuals residuals;
  Data data;
  std::vector<Check> checks;
  std::vector<Rest> rests_on;
  std::string verdict;  ///< kPassed, or what is wrong

  bool passed() const { return verdict == kPassed; }
  /// Throws Error when there is none of that name and size.
  const std::vector<double>& at(const std::string& name, std::size_t size) const;
};

/// Throws Error naming file and field: foreign, newer, damaged, changed by hand, or with
/// invalid figures.
CalibrationFile readCalibration(const std::filesystem::path& file);

/// The file's text. Throws Error for figures that are not finite or a covariance that is none.
std::string textOf(const CalibrationFile& calibration);

/// Written beside and renamed. Throws Error.
void writeCalibration(const CalibrationFile& calibration, const std::filesystem::path& file);

/// A pose as two entries, "<name>_position_m" and "<name>_rotation_vector_rad".
void addPose(CalibrationFile& calibration, const std::string& name, const Pose& X);
Pose poseAt(const CalibrationFile& calibration, const std::string& name);

/// The camera's nine figures and its picture's size. The reader validates as every camera is
/// validated.
void addCamera(CalibrationFile& calibration, const calibration::CameraModel& camera);
calibration::CameraModel cameraAt(const CalibrationFile& calibration);

}  // namespace palpa::station
