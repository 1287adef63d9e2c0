#include "apps/calibrate/recorded.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <fstream>
#include <sstream>

#include <nlohmann/json.hpp>

#include "anatomy/base/error.h"
#include "anatomy/base/json_text.h"
#include "anatomy/base/whole_file.h"
#include "ar/cameras/recorded_pictures.h"
#include "calibration/rotation.h"

namespace palpa::calibrate {
namespace {

constexpr std::uintmax_t kLargestTable = 64 << 20;
constexpr std::size_t kMostColumns = 64;

std::string trimmedCell(std::string cell) {
  const auto blank = [](char c) { return c == ' ' || c == '\t' || c == '\r' || c == '"'; };
  while (!cell.empty() && blank(cell.back())) cell.pop_back();
  const auto first = std::find_if_not(cell.begin(), cell.end(), blank);
  return {first, cell.end()};
}

std::vector<std::string> cellsOf(const std::string& line) {
  std::vector<std::string> cells;
  std::istringstream stream(line);
  for (std::string cell; std::getline(stream, cell, ',') && cells.size() <= kMostColumns;)
    cells.push_back(trimmedCell(cell));
  return cells;
}

}  // namespace

SampleTable::SampleTable(const std::filesystem::path& file) : name_(file.string()) {
  std::error_code error;
  const auto size = std::filesystem::file_size(file, error);
  if (error) throw Error("cannot be read (" + whyUnread(error) + ")", name_, "Check the name");
  if (size > kLargestTable) throw Error("is larger than 64 MB", name_, "Record for a shorter time");
  std::ifstream stream(file);
  std::size_t number = 0;
  for (std::string line; std::getline(stream, line);) {
    ++number;
    if (trimmedCell(line).empty() || line[0] == '#') continue;
    std::vector<std::string> cells = cellsOf(line);
    if (header_.empty()) {
      if (cells.size() > kMostColumns)
        throw Error("has more than 64 columns", name_, "Is it a table of samples?");
      header_ = std::move(cells);
      continue;
    }
    if (cells.size() != header_.size())
      throw Error("has " + std::to_string(cells.size()) + " cells where the header has " +
                      std::to_string(header_.size()),
                  name_ + ", line " + std::to_string(number), "Correct the line, or leave it out");
    cells_.push_back(std::move(cells));
    line_.push_back(number);
  }
  if (!stream.eof()) throw Error("cannot be read", name_, "Check its permissions");
  if (cells_.empty())
    throw Error("holds no samples", name_,
                "The first line names the columns, each further line is a sample");
}

bool SampleTable::has(const std::string& column) const {
  return std::find(header_.begin(), header_.end(), column) != header_.end();
}

std::size_t SampleTable::place(const std::string& column) const {
  const auto found = std::find(header_.begin(), header_.end(), column);
  if (found != header_.end()) return static_cast<std::size_t>(found - header_.begin());
  std::string names;
  for (const std::string& name : header_) names += (names.empty() ? "" : ", ") + name;
  throw Error("has no column \"" + column + "\"", name_, "It has: " + names.substr(0, 200));
}

void SampleTable::refuse(std::size_t row, const std::string& column,
                         const std::string& what) const {
  throw Error(what, name_ + ", line " + std::to_string(line_[row]) + ", column \"" + column + "\"",
              "Correct it, or leave the line out");
}

std::string SampleTable::text(std::size_t row, const std::string& column) const {
  return cells_[row][place(column)];
}

double SampleTable::number(std::size_t row, const std::string& column) const {
  const std::string& cell = cells_[row][place(column)];
  char* end = nullptr;
  const double value = std::strtod(cell.c_str(), &end);
  if (cell.empty() || *end != 0 || !std::isfinite(value))
    refuse(row, column, "\"" + cell.substr(0, 30) + "\" is not a number");
  return value;
}

Vec3 SampleTable::place(std::size_t row, const std::string& prefix) const {
  const bool mm = has(prefix + "x_mm");
  if (!mm && !has(prefix + "x_m") && has(prefix + "x"))
    throw Error("column \"" + prefix + "x\" does not say its unit", name_,
                "Call it \"" + prefix + "x_m\" or \"" + prefix + "x_mm\"");
  const std::string unit = mm ? "_mm" : "_m";
  Vec3 p;
  for (int i = 0; i < 3; ++i) p[i] = number(row, prefix + "xyz"[i] + unit);
  return mm ? Vec3(1e-3 * p) : p;
}

Quat SampleTable::turn(std::size_t row, const std::string& prefix) const {
  const double w = number(row, prefix + "q_w"), x = number(row, prefix + "q_x"),
               y = number(row, prefix + "q_y"), z = number(row, prefix + "q_z");
  const Quat q(w, x, y, z);
  if (std::abs(q.norm() - 1) > 1e-3)
    refuse(row, prefix + "q_w", "the four numbers are not a unit quaternion");
  return q.normalized();
}

Pose SampleTable::pose(std::size_t row, const std::string& prefix) const {
  return makePose(turn(row, prefix).toRotationMatrix(), place(row, prefix));
}

namespace {

using nlohmann::json;
constexpr std::uintmax_t kLargestList = 64 << 20;

bool isJson(const std::filesystem::path& file) { return file.extension() == ".json"; }

json listIn(const std::filesystem::path& file) {
  std::error_code error;
  const auto size = std::filesystem::file_size(file, error);
  if (error)
    throw Error("cannot be read (" + whyUnread(error) + ")", file.string(), "Check the name");
  if (size > kLargestList)
    throw Error("is larger than 64 MB", file.string(), "Record for a shorter time");
  json list = parsedOrDiscarded(readWhole(file).value_or(""));
  if (!list.is_array() || list.empty())
    throw Error("holds no list", file.string(), "Give a list of 4x4 matrices, in metres");
  return list;
}

Pose matrixAt(const json& m, const std::filesystem::path& file, std::size_t entry) {
  const std::string where = file.string() + ", entry " + std::to_string(entry + 1);
  Eigen::Matrix4d matrix;
  const auto bad = [&]() {
    return Error("is not a 4x4 matrix of numbers", where, "Give rows of a pose, in metres");
  };
  if (!m.is_array() || m.size() != 4) throw bad();
  for (std::size_t i = 0; i < 4; ++i) {
    if (!m[i].is_array() || m[i].size() != 4) throw bad();
    for (std::size_t j = 0; j < 4; ++j) {
      if (!m[i][j].is_number()) throw bad();
      matrix(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(j)) = m[i][j].get<double>();
    }
  }
  Pose X(matrix);
  calibration::requirePose(X, where);
  return X;
}

Vec3 vectorAt(const SampleTable& table, std::size_t row, const std::string& prefix,
              const std::string& unit) {
  return {table.number(row, prefix + "x" + unit), table.number(row, prefix + "y" + unit),
          table.number(row, prefix + "z" + unit)};
}

}  // namespace

std::vector<Pose> readPoses(const std::filesystem::path& file) {
  std::vector<Pose> poses;
  if (isJson(file)) {
    const json list = listIn(file);
    for (std::size_t i = 0; i < list.size(); ++i) poses.push_back(matrixAt(list[i], file, i));
    return poses;
  }
  const SampleTable table(file);
  for (std::size_t i = 0; i < table.rows(); ++i) poses.push_back(table.pose(i, ""));
  return poses;
}

std::vector<calibration::HandEyeSample> readPosePairs(const std::filesystem::path& file) {
  std::vector<calibration::HandEyeSample> pairs;
  if (isJson(file)) {
    const json list = listIn(file);
    for (std::size_t i = 0; i < list.size(); ++i) {
      if (!list[i].is_array() || list[i].size() != 2)
        throw Error("is not a pair of matrices", file.string() + ", entry " + std::to_string(i + 1),
                    "Give [end effector in base, tag in camera]");
      pairs.push_back({matrixAt(list[i][0], file, i), matrixAt(list[i][1], file, i)});
    }
    return pairs;
  }
  const SampleTable table(file);
  for (std::size_t i = 0; i < table.rows(); ++i)
    pairs.push_back({table.pose(i, "device_"), table.pose(i, "tag_")});
  return pairs;
}

std::vector<Touch> readTouches(const std::filesystem::path& file) {
  const SampleTable table(file);
  std::vector<Touch> touches;
  for (std::size_t i = 0; i < table.rows(); ++i) {
    Touch touch{table.has("name") ? table.text(i, "name") : std::to_string(i + 1),
                table.place(i, "known_"), table.place(i, "touched_"), false};
    touch.for_check = table.has("for") && table.text(i, "for") == "check";
    if (table.has("end_x_mm") || table.has("end_x_m"))
      touch.lever_D = touch.p_D - table.place(i, "end_");
    touches.push_back(touch);
  }
  return touches;
}

std::vector<calibration::TimedPoint> readTrack(const std::filesystem::path& file) {
  const SampleTable table(file);
  std::vector<calibration::TimedPoint> track;
  for (std::size_t i = 0; i < table.rows(); ++i)
    track.push_back({table.number(i, "t_s"), table.place(i, "")});
  return track;
}

std::vector<calibration::StaticReading> readStaticReadings(const std::filesystem::path& file) {
  const SampleTable table(file);
  std::vector<calibration::StaticReading> readings;
  for (std::size_t i = 0; i < table.rows(); ++i)
    readings.push_back({table.turn(i, "").toRotationMatrix(), vectorAt(table, i, "force_", "_N"),
                        vectorAt(table, i, "torque_", "_Nm")});
  return readings;
}

RecordedViews readViews(const std::string& glob, const ar::Board& board) {
  ar::ImageSequence pictures(glob, 1);
  RecordedViews recorded;
  while (const std::optional<ar::Frame> frame = pictures.grab()) {
    recorded.width = frame->image.cols;
    recorded.height = frame->image.rows;
    const std::string name = std::filesystem::path(frame->source).filename().string();
    calibration::BoardView view;
    view.name = name;
    for (const ar::BoardPoint& point : board.detect(frame->image)) {
      view.p_W.push_back(point.p_W);
      view.pixels.push_back(point.pixel);
    }
    if (view.p_W.size() < 8)
      recorded.unseen.push_back(name);
    else
      recorded.views.push_back(std::move(view));
  }
  return recorded;
}

}  // namespace palpa::calibrate
