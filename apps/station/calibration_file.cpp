#include "apps/station/calibration_file.h"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>

#include "anatomy/base/enum_names.h"
#include "anatomy/base/error.h"
#include "anatomy/base/file_schema.h"
#include "anatomy/base/json_file.h"
#include "anatomy/base/sha256.h"
#include "anatomy/base/whole_file.h"
#include "anatomy/geometry/pose.h"
#include "calibration/rotation.h"

namespace palpa::station {
namespace {

using nlohmann::json;
constexpr int kCalibrationVersion = 1;
constexpr const char* kCalibrationFormat = "palpa calibration";
constexpr std::size_t kMostNumbers = 200'000;
constexpr std::size_t kMostCoordinates = 1000;  // a matrix of as many rows and columns

const EnumNames<CalibrationKind> kCalibrationKinds{
    "camera",   "tool",     "workspace", "registration", "latency", "force-sensor",
    "material", "friction", "inclusion", "object",       "texture", "subtasks"};

std::vector<double> numbersOf(const JsonFile& file, const json& list, const std::string& at) {
  if (!list.is_array() || list.size() > kMostNumbers) file.refuse(at, "must be a list of numbers");
  std::vector<double> values;
  for (const json& item : list) {
    if (!item.is_number() || !std::isfinite(item.get<double>()))
      file.refuse(at, "must hold numbers only");
    values.push_back(item.get<double>());
  }
  return values;
}

const json& listAt(const JsonFile& file, const std::string& at) {
  const json::json_pointer place("/" + at);
  if (!file.json().contains(place) || !file.json().at(place).is_array())
    file.refuse(at, "must be a list");
  return file.json().at(place);
}

/// Symmetric, nothing below zero beyond rounding.
bool isCovariance(const Eigen::MatrixXd& m) {
  if (m.rows() != m.cols() || !m.allFinite()) return false;
  if (m.rows() == 0) return true;
  const Eigen::VectorXd sd = m.diagonal().cwiseMax(0).cwiseSqrt();
  if ((m.diagonal().array() < 0).any()) return false;
  for (Eigen::Index i = 0; i < m.rows(); ++i)
    for (Eigen::Index j = 0; j < m.cols(); ++j)
      if (std::abs(m(i, j) - m(j, i)) > 1e-6 * sd[i] * sd[j] + 1e-300 ||
          std::abs(m(i, j)) > 1.000001 * sd[i] * sd[j] + 1e-300)
        return false;
  return true;
}

json bodyOf(const CalibrationFile& c) {
  json parameters = json::object();
  for (const auto& p : c.parameters) parameters[p.name] = p.values;
  json matrix = json::array();
  for (Eigen::Index i = 0; i < c.covariance.rows(); ++i) {
    json row = json::array();
    for (Eigen::Index j = 0; j < c.covariance.cols(); ++j) row.push_back(c.covariance(i, j));
    matrix.push_back(row);
  }
  json checks = json::array(), rests = json::array(), files = json::array();
  for (const auto& k : c.checks)
    checks.push_back({{"name", k.name},
                      {"value", k.value},
                      {"limit", k.limit},
                      {"unit", k.unit},
                      {"passed", k.passed()}});
  for (const auto& r : c.rests_on) rests.push_back({{"kind", r.kind}, {"sha256", r.sha256}});
  for (const auto& f : c.data.files) files.push_back({{"name", f.name}, {"sha256", f.sha256}});
  return {{"format", kCalibrationFormat},
          {"version", kCalibrationVersion},
          {"kind", nameOf(c.kind)},
          {"station", c.station},
          {"date", c.date},
          {"made_by", c.made_by},
          {"simulated", c.simulated},
          {"valid_days", c.valid_days},
          {"parameters", parameters},
          {"covariance", {{"coordinates", c.coordinates}, {"matrix", matrix}}},
          {"residuals",
           {{"unit", c.residuals.unit},
            {"rms", c.residuals.rms},
            {"values", c.residuals.values},
            {"left_out", c.residuals.left_out}}},
          {"data",
           {{"samples", c.data.samples},
            {"used", c.data.used},
            {"source", c.data.source},
            {"files", files}}},
          {"checks", checks},
          {"rests_on", rests},
          {"verdict", c.verdict}};
}

bool allFinite(const CalibrationFile& c) {
  const auto finite = [](double x) { return std::isfinite(x); };
  for (const auto& p : c.parameters)
    if (!std::all_of(p.values.begin(), p.values.end(), finite)) return false;
  for (const auto& k : c.checks)
    if (!finite(k.value) || !finite(k.limit)) return false;
  return finite(c.residuals.rms) &&
         std::all_of(c.residuals.values.begin(), c.residuals.values.end(), finite);
}

void requireFormat(const JsonFile& file) {
  if (!file.json().is_object() || !file.json().contains("format") ||
      file.json().at("format") != kCalibrationFormat)
    throw UsageError("is not a calibration made by this program", file.name(),
                     "Give a file that `palpa calibrate` has written");
}

/// So that damage is told from a file that is none.
void requireUnchanged(const JsonFile& file) {
  json body = file.json();
  const std::string said = file.text("sha256");
  body.erase("sha256");
  if (sha256(body.dump()) != said)
    throw UsageError("was damaged or changed after it was written: its checksum does not fit",
                     file.name(), "Calibrate again");
}

void readCovariance(const JsonFile& file, CalibrationFile& c) {
  const json& covariance = file.json().value("covariance", json::object());
  if (!covariance.is_object()) file.refuse("covariance", "must be an object");
  for (const json& name : covariance.value("coordinates", json::array())) {
    if (!name.is_string()) file.refuse("covariance/coordinates", "must be names");
    c.coordinates.push_back(name.get<std::string>());
  }
  const json matrix = covariance.value("matrix", json::array());
  const auto n = static_cast<Eigen::Index>(c.coordinates.size());
  if (c.coordinates.size() > kMostCoordinates)
    file.refuse("covariance/coordinates",
                "has more than " + std::to_string(kMostCoordinates) + " names");
  if (!matrix.is_array() || matrix.size() != c.coordinates.size())
    file.refuse("covariance/matrix", "must be as large as its coordinates");
  c.covariance.resize(n, n);
  for (Eigen::Index i = 0; i < n; ++i) {
    const std::vector<double> row =
        numbersOf(file, matrix[static_cast<std::size_t>(i)], "covariance/matrix");
    if (row.size() != c.coordinates.size()) file.refuse("covariance/matrix", "must be square");
    for (Eigen::Index j = 0; j < n; ++j) c.covariance(i, j) = row[static_cast<std::size_t>(j)];
  }
  if (!isCovariance(c.covariance)) file.refuse("covariance/matrix", "is not a covariance");
}

void readResiduals(const JsonFile& file, CalibrationFile& c) {
  c.residuals.unit = file.text("residuals/unit");
  c.residuals.rms = file.number("residuals/rms", 0, 1e9);
  const json& residuals = file.json().at("residuals");
  c.residuals.values =
      numbersOf(file, residuals.value("values", json::array()), "residuals/values");
  for (const double index :
       numbersOf(file, residuals.value("left_out", json::array()), "residuals/left_out")) {
    if (index < 0 || index >= 1e6)
      file.refuse("residuals/left_out", "must hold places in the list");
    c.residuals.left_out.push_back(static_cast<int>(index));
  }
}

void readLists(const JsonFile& file, CalibrationFile& c) {
  for (const json& item : listAt(file, "checks")) {
    const JsonFile check(item, file.name() + ", \"checks\"");
    c.checks.push_back(
        {check.text("name"), check.number("value"), check.number("limit"), check.text("unit")});
  }
  for (const json& item : listAt(file, "rests_on")) {
    const JsonFile rest(item, file.name() + ", \"rests_on\"");
    c.rests_on.push_back({rest.text("kind"), rest.text("sha256")});
  }
}

CalibrationFile read(const JsonFile& file) {
  requireFormat(file);
  file.needVersion(kCalibrationVersion);
  requireUnchanged(file);
  CalibrationFile c;
  const std::optional<CalibrationKind> kind = calibrationKindNamed(file.text("kind"));
  if (!kind)
    file.refuse("kind", "is \"" + file.text("kind") + "\", which this program does not know");
  c.kind = *kind;
  c.station = file.text("station");
  c.date = file.text("date");
  c.made_by = file.text("made_by");
  c.simulated = file.flag("simulated", false);
  c.valid_days = file.integer("valid_days", 0, 100'000);
  const json& parameters = file.json().value("parameters", json());
  if (!parameters.is_object()) file.refuse("parameters", "must be an object");
  for (const auto& [name, list] : parameters.items())
    c.parameters.push_back({name, numbersOf(file, list, "parameters/" + name)});
  readCovariance(file, c);
  readResiduals(file, c);
  readLists(file, c);
  c.data.samples = file.integer("data/samples", 0, 100'000'000);
  c.data.used = file.integer("data/used", 0, c.data.samples);
  c.data.source = file.text("data/source");
  for (const json& item : listAt(file, "data/files")) {
    const JsonFile recorded(item, file.name() + ", \"data/files\"");
    c.data.files.push_back({recorded.text("name"), recorded.text("sha256")});
  }
  c.verdict = file.text("verdict");
  return c;
}

}  // namespace

const std::string& nameOf(CalibrationKind kind) { return kCalibrationKinds.of(kind); }

std::optional<CalibrationKind> calibrationKindNamed(std::string_view name) {
  return kCalibrationKinds.named(name);
}

/// A bad calibration is no mistake in how the program was called: exit code 1. A field that nobody
/// knows is one: somebody wrote it.
CalibrationFile readCalibration(const std::filesystem::path& path) {
  const JsonFile file = readOwnFile([&] {
    JsonFile whole(path);
    if (whole.has("format") || !whole.has("sha256")) requireFormat(whole);
    if (whole.has("version")) whole.needVersion(kCalibrationVersion);
    return whole;
  });
  refuseUnknownFields(file, "calibration");
  return readOwnFile([&] { return read(file); });
}

const std::vector<double>& CalibrationFile::at(const std::string& name, std::size_t size) const {
  for (const Numbers& p : parameters)
    if (p.name == name && p.values.size() == size) return p.values;
  throw Error("has no \"" + name + "\" of " + std::to_string(size) + " numbers",
              nameOf(kind) + " calibration", "Calibrate again");
}

std::string textOf(const CalibrationFile& calibration) {
  const auto n = static_cast<Eigen::Index>(calibration.coordinates.size());
  if (!allFinite(calibration) || calibration.covariance.rows() != n ||
      !isCovariance(calibration.covariance))
    throw Error("the result is not finite", nameOf(calibration.kind) + " calibration",
                "Record the data again");
  json body = bodyOf(calibration);
  body["sha256"] = sha256(body.dump());
  return body.dump(1) + "\n";
}

void writeCalibration(const CalibrationFile& calibration, const std::filesystem::path& file) {
  writeWhole(file, textOf(calibration));
}

void addPose(CalibrationFile& calibration, const std::string& name, const Pose& X) {
  const Vec3 p = X.translation(), w = calibration::rotationVector(X.rotation());
  calibration.parameters.push_back({name + "_position_m", {p.x(), p.y(), p.z()}});
  calibration.parameters.push_back({name + "_rotation_vector_rad", {w.x(), w.y(), w.z()}});
}

Pose poseAt(const CalibrationFile& calibration, const std::string& name) {
  const std::vector<double>& p = calibration.at(name + "_position_m", 3);
  const std::vector<double>& w = calibration.at(name + "_rotation_vector_rad", 3);
  return makePose(calibration::rotationOf({w[0], w[1], w[2]}), Vec3(p[0], p[1], p[2]));
}

void addCamera(CalibrationFile& calibration, const calibration::CameraModel& camera) {
  calibration.parameters.push_back({"size_px", {double(camera.width), double(camera.height)}});
  calibration.parameters.push_back({"focal_px", {camera.fx, camera.fy}});
  calibration.parameters.push_back({"centre_px", {camera.cx, camera.cy}});
  calibration.parameters.push_back(
      {"distortion_k1k2p1p2k3", {camera.distortion.begin(), camera.distortion.end()}});
}

calibration::CameraModel cameraAt(const CalibrationFile& calibration) {
  calibration::CameraModel camera;
  const auto& size = calibration.at("size_px", 2);
  camera.width = static_cast<int>(std::clamp(size[0], 0.0, 1e5));
  camera.height = static_cast<int>(std::clamp(size[1], 0.0, 1e5));
  camera.fx = calibration.at("focal_px", 2)[0];
  camera.fy = calibration.at("focal_px", 2)[1];
  camera.cx = calibration.at("centre_px", 2)[0];
  camera.cy = calibration.at("centre_px", 2)[1];
  const auto& k = calibration.at("distortion_k1k2p1p2k3", 5);
  std::copy(k.begin(), k.end(), camera.distortion.begin());
  camera.rms_px = calibration.residuals.rms;
  calibration::validate(camera, "camera calibration");
  return camera;
}

}  // namespace palpa::station
