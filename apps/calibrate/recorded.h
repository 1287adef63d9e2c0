#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "anatomy/geometry/pose.h"
#include "apps/calibrate/results.h"
#include "ar/boards/board.h"
#include "calibration/camera_calibration.h"

namespace palpa::calibrate {

/// A table of recorded samples: text, columns separated by commas, a header row with the columns'
/// names. The end of a name is its unit: "x_mm" and "x_m" are both understood; a length without a
/// unit is refused, because a guess is worse than a question.
class SampleTable {
 public:
  /// Throws Error naming the file, and the line where one is wrong.
  explicit SampleTable(const std::filesystem::path& file);

  std::size_t rows() const { return cells_.size(); }
  bool has(const std::string& column) const;
  std::string text(std::size_t row, const std::string& column) const;
  /// Throws Error naming file, line and column for what is no finite number.
  double number(std::size_t row, const std::string& column) const;
  /// "<prefix>x", y and z with one of the units "_m" and "_mm", in metres.
  Vec3 place(std::size_t row, const std::string& prefix) const;
  /// "<prefix>q_w", x, y, z: a unit quaternion to 1e-3.
  Quat turn(std::size_t row, const std::string& prefix) const;
  /// Both: a pose.
  Pose pose(std::size_t row, const std::string& prefix) const;

  const std::string& name() const { return name_; }

 private:
  [[noreturn]] void refuse(std::size_t row, const std::string& column,
                           const std::string& what) const;
  std::size_t place(const std::string& column) const;

  std::string name_;
  std::vector<std::string> header_;
  std::vector<std::vector<std::string>> cells_;
  std::vector<std::size_t> line_;
};

}  // namespace palpa::calibrate

/// Recorded samples: tables (SampleTable) and pictures. Columns and their units are named in
/// each function. All throw Error with file and line.
namespace palpa::calibrate {

/// x_, y_, z_ (m or mm), q_w, q_x, q_y, q_z: the end effector in the device's base. Or JSON: a list
/// of 4x4 matrices, m.
std::vector<Pose> readPoses(const std::filesystem::path& file);

/// device_x, ... device_q_z: X_DE; tag_x, ... tag_q_z: the tag in the camera or, better, in the
/// board. Or JSON: a list of pairs of 4x4 matrices, m.
std::vector<calibration::HandEyeSample> readPosePairs(const std::filesystem::path& file);

/// known_x, ...: in W; touched_x, ...: in D; optional "name", "for" ("check": not used to fit) and
/// end_x, ...: the end effector's place in D, which a map of the workspace is made of.
std::vector<Touch> readTouches(const std::filesystem::path& file);

/// t_s; x, y, z.
std::vector<calibration::TimedPoint> readTrack(const std::filesystem::path& file);

/// q_w, ...: the sensor in the device's base; force_x_N, ..., torque_x_Nm, ....
std::vector<calibration::StaticReading> readStaticReadings(const std::filesystem::path& file);

/// t_s; force_N, normal; speed_mm_per_s or speed_m_per_s along the surface; acceleration_m_per_s2
/// of the tool. Where times leave a gap another stroke begins. `dt`: where the step goes, s.
std::vector<calibration::TextureStroke> readTextureStrokes(const std::filesystem::path& file,
                                                           double tool_mass, double* dt);

struct RecordedViews {
  std::vector<calibration::BoardView> views;
  std::vector<std::string> unseen;  ///< pictures in which the board was not found
  int width = 0, height = 0;
};
/// Pictures that match a shell pattern. Throws UsageError for a pattern that matches nothing.
RecordedViews readViews(const std::string& glob, const ar::Board& board);

}  // namespace palpa::calibrate
