#include "apps/calibrate/recorded.h"

#include <cmath>
#include <fstream>
#include <nlohmann/json.hpp>

#include "anatomy/geometry/error.h"
#include "apps/calibrate/sample_table.h"
#include "ar/image_sequence.h"
#include "calibration/rotation.h"

namespace palpa::calibrate {
namespace {

using nlohmann::json;
constexpr std::uintmax_t kLargestList = 64 << 20;

bool isJson(const std::filesystem::path& file) { return file.extension() == ".json"; }

json listIn(const std::filesystem::path& file) {
  std::error_code error;
  const auto size = std::filesystem::file_size(file, error);
  if (error)
    throw Error("cannot be read (" + error.message() + ")", file.string(), "Check the name");
  if (size > kLargestList)
    throw Error("is larger than 64 MB", file.string(), "Record for a shorter time");
  std::ifstream stream(file);
  json list = json::parse(stream, nullptr, false);
  if (!list.is_array() || list.empty())
    throw Error("holds no list", file.string(), "Give a list of 4x4 matrices, in metres");
  return list;
}

Pose matrixAt(const json& m, const std::filesystem::path& file, std::size_t entry) {
  const std::string where = file.string() + ", entry " + std::to_string(entry + 1);
  Eigen::Matrix4d matrix;
  const auto bad = [&]() {
    return Error("is no 4x4 matrix of numbers", where, "Give rows of a pose, in metres");
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
        throw Error("is no pair of matrices", file.string() + ", entry " + std::to_string(i + 1),
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
