#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "anatomy/geometry/pose.h"

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
