#pragma once

#include <string>
#include <utility>
#include <vector>

#include <Eigen/Core>

#include "apps/station/calibration_file.h"

namespace palpa::calibrate {

/// Points to look at: what was measured, over what it was measured at.
struct MeasuredPlot {
  std::string title, x, y;  ///< axes with units
  struct Dot {
    double x = 0, y = 0;
    bool left_out = false;
  };
  std::vector<Dot> dots;
  std::vector<Dot> predicted = {};  ///< a line: what the found law says
  /// Along x, in place of round numbers.
  std::vector<std::pair<double, std::string>> marks = {};
};

/// How many times something was seen in each part of the picture, row by row from the top.
struct Coverage {
  int columns = 0, rows = 0;
  std::vector<int> counts;
};

/// A figure all over a surface: in cells, darker where it is more; where it is not sure, dashed.
struct DrawnMap {
  std::string title, unit;
  int columns = 0, rows = 0;
  Eigen::Vector2d low = Eigen::Vector2d::Zero(), high = Eigen::Vector2d::Zero();  ///< mm
  std::vector<double> values;            ///< row by row, from `low`
  std::vector<bool> unsure;              ///< of each
  std::vector<Eigen::Vector2d> touches;  ///< mm
};

/// What a routine found: the file to keep, and the same in words and pictures.
struct Result {
  station::CalibrationFile file;
  std::string title;                   ///< "Needle tip"
  std::vector<std::string> sentences;  ///< what was found, for an educator
  std::vector<std::string> advice;     ///< what could be better, when to redo it
  std::vector<MeasuredPlot> plots;
  Coverage coverage;
  std::vector<DrawnMap> maps = {};
};

/// Where the data come from and who asks.
struct Origin {
  std::string station, command, source, date;
  bool simulated = false;
  std::vector<station::CalibrationFile::Data::File> files = {};
};

/// A file begun with `origin`, of a kind, good for so many days.
station::CalibrationFile begun(const Origin& origin, station::CalibrationKind kind, int valid_days);

/// "pass", or the checks that did not hold, in words.
std::string verdictOf(const std::vector<station::CalibrationFile::Check>& checks);

/// "0.12 mm" and the like: the number with as many digits as it deserves.
std::string quantity(double value, const std::string& unit);

}  // namespace palpa::calibrate
