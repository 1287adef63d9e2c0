#include "apps/station/calibrations.h"

#include <algorithm>
#include <optional>

#include "anatomy/base/error.h"
#include "anatomy/base/sha256.h"
#include "anatomy/base/utc.h"
#include "apps/station/station_file.h"

namespace palpa::station {
namespace {

using std::chrono::sys_days;

std::string titleOf(const AppliedCalibration& c) {
  return "the " + nameOf(c.file.kind) + " calibration";
}

Packed3 packedAt(const CalibrationFile& file, const std::string& name) {
  const std::vector<double>& v = file.at(name, 3);
  return {v[0], v[1], v[2]};
}

void applyTo(ForceSensorSetup& sensor, const CalibrationFile& file) {
  sensor.bias.f_S = packedAt(file, "bias_force_N");
  sensor.bias.tau_S = packedAt(file, "bias_torque_Nm");
  sensor.tool.mass = file.at("tool_mass_kg", 1)[0];
  sensor.tool.p_SM = packedAt(file, "tool_centre_m");
}

haptics::WorkspaceCorrection correctionIn(const CalibrationFile& file) {
  haptics::WorkspaceCorrection correction;
  const double order = file.at("order", 1)[0];
  if (!(order >= 0 && order <= haptics::WorkspaceCorrection::kHighestOrder))
    throw Error("is of an order that is not known", "workspace calibration", "Calibrate again");
  correction.order = static_cast<int>(order);
  const int terms = (correction.order + 1) * (correction.order + 2) * (correction.order + 3) / 6;
  correction.centre = packedAt(file, "centre_m");
  correction.half = packedAt(file, "half_m");
  for (const double half : correction.half)
    if (!(half > 0)) throw Error("has no size", "workspace calibration", "Calibrate again");
  const std::vector<double>& c = file.at("coefficients_m", static_cast<std::size_t>(3 * terms));
  for (std::size_t k = 0; k < static_cast<std::size_t>(terms); ++k)
    correction.coefficients[k] = {c[3 * k], c[3 * k + 1], c[3 * k + 2]};
  return correction;
}

}  // namespace

std::vector<AppliedCalibration> readCalibrations(const JsonFile& file,
                                                 const std::filesystem::path& folder) {
  std::vector<AppliedCalibration> calibrations;
  if (!file.has("calibrations")) return calibrations;
  if (!file.json().at("calibrations").is_array()) file.refuse("calibrations", "must be a list");
  for (const nlohmann::json& item : file.json().at("calibrations")) {
    const JsonFile entry(item, file.name() + ", \"calibrations\"");
    AppliedCalibration c;
    c.path = folder / entry.text("path");
    c.sha256_wanted = entry.text("sha256");
    c.file = readCalibration(c.path);
    c.sha256 = sha256OfFile(c.path);
    if (nameOf(c.file.kind) != entry.text("kind"))
      entry.refuse("kind", "is \"" + entry.text("kind") + "\", but the file is a " +
                               nameOf(c.file.kind) + " calibration");
    if (calibrationOf(calibrations, c.file.kind)) entry.refuse("kind", "occurs twice");
    calibrations.push_back(std::move(c));
  }
  return calibrations;
}

const AppliedCalibration* calibrationOf(const std::vector<AppliedCalibration>& calibrations,
                                        CalibrationKind kind) {
  for (const AppliedCalibration& c : calibrations)
    if (c.file.kind == kind) return &c;
  return nullptr;
}

nlohmann::json toJson(const std::vector<AppliedCalibration>& calibrations,
                      const std::filesystem::path& folder) {
  nlohmann::json list = nlohmann::json::array();
  for (const AppliedCalibration& c : calibrations)
    list.push_back({{"kind", nameOf(c.file.kind)},
                    {"path", c.path.lexically_proximate(folder).string()},
                    {"sha256", c.sha256},
                    {"date", c.file.date},
                    {"verdict", c.file.verdict}});
  return list;
}

std::string faultIn(const AppliedCalibration& c,
                    const std::vector<AppliedCalibration>& calibrations,
                    const std::string& station) {
  if (!c.file.passed()) return titleOf(c) + " failed: " + c.file.verdict;
  if (c.file.station != station)
    return titleOf(c) + " belongs to station \"" + c.file.station + "\"";
  if (c.sha256 != c.sha256_wanted)
    return titleOf(c) + " was replaced after the station's file was written";
  for (const CalibrationFile::Rest& rest : c.file.rests_on) {
    const std::optional<CalibrationKind> kind = calibrationKindNamed(rest.kind);
    const AppliedCalibration* other = kind ? calibrationOf(calibrations, *kind) : nullptr;
    if (!other || other->sha256 != rest.sha256)
      return titleOf(c) + " is outdated: it was made with another " + rest.kind + " calibration";
  }
  return "";
}

std::string faultOf(const std::vector<AppliedCalibration>& calibrations,
                    const std::string& station) {
  for (const AppliedCalibration& c : calibrations)
    if (std::string fault = faultIn(c, calibrations, station); !fault.empty()) return fault;
  return "";
}

std::string outdatedOn(const std::vector<AppliedCalibration>& calibrations,
                       const std::string& date) {
  const auto today = dateIn(date);
  for (const AppliedCalibration& c : calibrations) {
    const auto made = dateIn(c.file.date);
    if (!made) return titleOf(c) + " has no date";
    if (today && sys_days(*today) - sys_days(*made) > std::chrono::days(c.file.valid_days))
      return titleOf(c) + " is outdated: made on " + c.file.date.substr(0, 10) + ", good for " +
             std::to_string(c.file.valid_days) + " days";
  }
  return "";
}

void applyCalibrations(Station& s) {
  if (s.calibrations.empty()) return;
  s.calibration_date.clear();
  for (const AppliedCalibration& c : s.calibrations) {
    if (s.calibration_date.empty() || c.file.date < s.calibration_date)
      s.calibration_date = c.file.date;
    const CalibrationKind kind = c.file.kind;
    if (kind == CalibrationKind::camera) s.camera = cameraAt(c.file);
    if (kind == CalibrationKind::workspace) s.workspace = correctionIn(c.file);
    if (kind == CalibrationKind::tool) s.X_ET = poseAt(c.file, "X_ET");
    if (kind == CalibrationKind::registration) s.X_WD = poseAt(c.file, "X_WD");
    if (kind == CalibrationKind::force_sensor && s.force_sensor) applyTo(*s.force_sensor, c.file);
    if (kind == CalibrationKind::latency) s.camera_latency_s = c.file.at("camera_latency_s", 1)[0];
  }
  const std::string fault = faultOf(s.calibrations, s.id);
  s.calibration_verdict = fault.empty() ? std::string(kPassed) : fault;
}

Station withCalibrations(const Station& station,
                         const std::vector<AppliedCalibration>& calibrations) {
  Station s = station;
  s.camera = s.design.camera;
  s.X_WD = s.design.X_WD;
  s.X_ET = s.design.X_ET;
  s.camera_latency_s = s.design.camera_latency_s;
  s.workspace = {};
  s.force_sensor = s.design.force_sensor;
  s.calibrations = calibrations;
  for (const AppliedCalibration& before : station.calibrations)
    if (!calibrationOf(calibrations, before.file.kind)) s.calibrations.push_back(before);
  applyCalibrations(s);
  return s;
}

void judgeAge(Station& s, const std::string& date) {
  const std::string old = outdatedOn(s.calibrations, date);
  if (!old.empty() && s.calibrated()) s.calibration_verdict = old;
}

}  // namespace palpa::station
