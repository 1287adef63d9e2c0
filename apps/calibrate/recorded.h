#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "apps/calibrate/results.h"
#include "ar/board.h"
#include "calibration/board_view.h"

/// Recorded samples: tables (sample_table.h) and pictures. Columns and their units are named in
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

struct RecordedViews {
  std::vector<calibration::BoardView> views;
  std::vector<std::string> unseen;  ///< pictures in which the board was not found
  int width = 0, height = 0;
};
/// Pictures that match a shell pattern. Throws UsageError for a pattern that matches nothing.
RecordedViews readViews(const std::string& glob, const ar::Board& board);

}  // namespace palpa::calibrate
