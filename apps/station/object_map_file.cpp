#include "apps/station/object_map_file.h"

#include <algorithm>
#include <cmath>

#include <nlohmann/json.hpp>

#include "anatomy/base/error.h"
#include "apps/station/calibration_file.h"

namespace palpa::station {
namespace {

constexpr double kPress_s = 0.5;
constexpr double kLeastDepth = 5e-4, kMostDepth = 0.02;     // m
constexpr double kStiffest = 1e5, kRoughest = 10;           // N/m; 1
constexpr double kSmallestStep = 1e-4, kLargestStep = 0.1;  // m

bool allWithin(const std::vector<double>& values, double low, double high) {
  return std::all_of(values.begin(), values.end(),
                     [&](double v) { return v > low && v <= high; });  // no number: neither
}

/// Empty: nothing is wrong.
std::string mapFault(const MappedObject& object) {
  const auto nodes =
      static_cast<std::size_t>(object.columns) * static_cast<std::size_t>(object.rows);
  if (object.columns < 2 || object.rows < 2) return "has fewer than 2 x 2 places";
  if (std::max(object.columns, object.rows) > haptics::kMapSide)
    return "has more than " + std::to_string(haptics::kMapSide) + " places along a side";
  const Eigen::Vector2d step = object.step();
  if (!(step.minCoeff() >= kSmallestStep && step.maxCoeff() <= kLargestStep))
    return "has places that are not 0.1 to 100 mm apart";
  if (object.stiffness.size() != nodes || object.stiffness_sd.size() != nodes ||
      object.friction.size() != nodes)
    return "has not one figure for each place";
  if (!allWithin(object.stiffness, 0, kStiffest) || !allWithin(object.friction, 0, kRoughest) ||
      !allWithin(object.stiffness_sd, 0, kRoughest))
    return "has a stiffness or friction that no soft thing has";
  if (!allWithin({object.depth}, kLeastDepth, kMostDepth))
    return "is of no depth that can be pressed";
  if (object.relaxation_share.size() != object.relaxation_time.size() ||
      !allWithin(object.relaxation_time, 0, 1e4) || !allWithin(object.relaxation_share, -1e-9, 10))
    return "has a relaxation that no soft thing has";
  return "";
}

void requireSound(const MappedObject& object, const std::string& file) {
  if (const std::string fault = mapFault(object); !fault.empty())
    throw Error(fault, file, "Learn it again: palpa calibrate object");
}

const std::vector<double>& listAt(const CalibrationFile& file, const std::string& name,
                                  const std::string& path) {
  for (const CalibrationFile::Numbers& numbers : file.parameters)
    if (numbers.name == name) return numbers.values;
  throw Error("has no \"" + name + '"', path, "Learn it again: palpa calibrate object");
}

void requireUsable(const CalibrationFile& file, const std::string& station,
                   const std::string& path) {
  if (file.kind != CalibrationKind::object)
    throw Error("is a calibration of \"" + nameOf(file.kind) + "\", not of an object", path,
                "Give the object.json that palpa calibrate object wrote");
  if (!file.passed())
    throw Error("did not pass: " + file.verdict, path,
                "Touch the object where it is known least: palpa calibrate object");
  if (file.station != station)
    throw Error("belongs to station \"" + file.station + "\", not to \"" + station + '"', path,
                "Learn the object where it lies: palpa calibrate object --station FILE");
}

Eigen::Vector2d pointIn(const std::vector<double>& v) { return {v[0], v[1]}; }

/// Of a share, while a force rises evenly to u times the share's time: what is left of it.
double leftOf(double u) { return u > 1e-9 ? (1 - std::exp(-u)) / u : 1; }

}  // namespace

MappedObject readMappedObject(const std::filesystem::path& path, const std::string& station) {
  const CalibrationFile file = readCalibration(path);
  requireUsable(file, station, path.string());
  MappedObject object;
  object.low = pointIn(file.at("low_m", 2));
  object.high = pointIn(file.at("high_m", 2));
  object.depth = file.at("depth_m", 1)[0];
  const double step = file.at("step_m", 1)[0];
  const Eigen::Vector2d cells = (object.high - object.low) / std::max(step, kSmallestStep);
  const auto nodes = [](double n) {
    return 1 + static_cast<int>(std::lround(std::clamp(n, 0.0, 1000.0)));
  };
  object.columns = nodes(cells.x());
  object.rows = nodes(cells.y());
  object.stiffness = listAt(file, "stiffness_N_per_m", path.string());
  object.stiffness_sd = listAt(file, "stiffness_sd_of_ln", path.string());
  object.friction = listAt(file, "friction", path.string());
  object.relaxation_share = listAt(file, "relaxation_share", path.string());
  object.relaxation_time = listAt(file, "relaxation_time_s", path.string());
  object.date = file.date;
  object.simulated = file.simulated;
  requireSound(object, path.string());
  return object;
}

nlohmann::json jsonOf(const MappedObject& object) {
  return {{"low_m", {object.low.x(), object.low.y()}},
          {"high_m", {object.high.x(), object.high.y()}},
          {"columns", object.columns},
          {"rows", object.rows},
          {"depth_m", object.depth},
          {"stiffness_N_per_m", object.stiffness},
          {"stiffness_sd_of_ln", object.stiffness_sd},
          {"friction", object.friction},
          {"relaxation_share", object.relaxation_share},
          {"relaxation_time_s", object.relaxation_time},
          {"date", object.date},
          {"simulated", object.simulated}};
}

MappedObject mappedObjectIn(const nlohmann::json& json) {
  MappedObject object;
  const auto list = [&](const char* name) { return json.at(name).get<std::vector<double>>(); };
  try {
    const std::vector<double> low = list("low_m"), high = list("high_m");
    object.low = {low.at(0), low.at(1)};
    object.high = {high.at(0), high.at(1)};
    object.columns = json.at("columns");
    object.rows = json.at("rows");
    object.depth = json.at("depth_m");
    object.stiffness = list("stiffness_N_per_m");
    object.stiffness_sd = list("stiffness_sd_of_ln");
    object.friction = list("friction");
    object.relaxation_share = list("relaxation_share");
    object.relaxation_time = list("relaxation_time_s");
    object.date = json.at("date");
    object.simulated = json.at("simulated");
  } catch (const std::exception& e) {
    throw Error(std::string("is damaged (") + e.what() + ')', "the recorded map of the object",
                "Restore the file from a backup");
  }
  requireSound(object, "the recorded map of the object");
  return object;
}

haptics::LearntMap learntMap(const MappedObject& object, const haptics::StiffnessModulation& law) {
  haptics::LearntMap map;
  const Eigen::Vector2d step = object.step();
  map.columns = object.columns;
  map.rows = object.rows;
  map.low_x = static_cast<float>(object.low.x());
  map.low_y = static_cast<float>(object.low.y());
  map.step_x = static_cast<float>(step.x());
  map.step_y = static_cast<float>(step.y());
  double quicker = 1;
  for (std::size_t i = 0; i < object.relaxation_share.size(); ++i)
    quicker += object.relaxation_share[i] * leftOf(kPress_s / object.relaxation_time[i]);
  const double by_law = haptics::forceOf(law.real, object.depth - law.x0, object.depth / kPress_s);
  for (std::size_t i = 0; i < object.stiffness.size(); ++i) {
    const double by_map = object.stiffness[i] * quicker * object.depth;
    map.stiffness[i] = by_law > 0 ? static_cast<float>(by_map / by_law) : 1;
    map.friction[i] =
        law.friction.mu > 0 ? static_cast<float>(object.friction[i] / law.friction.mu) : 1;
  }
  return map;
}

}  // namespace palpa::station
