#include <cmath>
#include <nlohmann/json.hpp>

#include "anatomy/base/error.h"
#include "anatomy/base/json_file.h"
#include "anatomy/base/units.h"
#include "anatomy/base/whole_file.h"
#include "calibration/expert_path.h"

namespace palpa::calibration {
namespace {

using Json = nlohmann::json;
using Ordered = nlohmann::ordered_json;

constexpr int kPathVersion = 1;
constexpr const char* kFormat = "palpa expert path";
constexpr const char* kRemedy = "Calibrate the experts' path again";

Vec3 vectorIn(const JsonFile& file, const std::string& field, double most) {
  const std::array<double, 3> xyz = file.triple(field);
  Vec3 v(xyz[0], xyz[1], xyz[2]);
  if (v.cwiseAbs().maxCoeff() > most) {
    std::string what = "holds a number beyond ";
    file.refuse(field, what.append(Json(most).dump()));
  }
  return v;
}

Vec3 unitVectorIn(const JsonFile& file, const std::string& field) {
  const Vec3 v = vectorIn(file, field, 1.001);
  if (std::abs(v.norm() - 1) > 1e-3) file.refuse(field, "must be a unit vector");
  return v.normalized();
}

Ordered inMm(const Vec3& v) { return {v.x() / kMm, v.y() / kMm, v.z() / kMm}; }

Ordered toJson(const ExpertPath& path) {
  return {{"format", kFormat},
          {"version", kPathVersion},
          {"simulated", path.simulated},
          {"made_by", path.made_by},
          {"frame",
           "medial, posterior, cephalad; origin: junction of the clavicle's medial and "
           "middle thirds"},
          {"trials", path.trials},
          {"left_out", path.left_out},
          {"experts", path.experts},
          {"entry_L_mm", inMm(path.entry_L)},
          {"entry_sd_mm", path.entry_sd / kMm},
          {"depth_mm", path.depth / kMm},
          {"depth_sd_mm", path.depth_sd / kMm},
          {"direction_L", {path.direction_L.x(), path.direction_L.y(), path.direction_L.z()}},
          {"direction_sd_deg", path.direction_sd / kDegree},
          {"direction_acceptable_deg", path.direction_acceptable / kDegree},
          {"line_from_L_mm", inMm(path.line_from_L)},
          {"line_to_L_mm", inMm(path.line_to_L)}};
}

bool allFinite(const ExpertPath& path) {
  return path.entry_L.allFinite() && path.direction_L.allFinite() && path.line_from_L.allFinite() &&
         path.line_to_L.allFinite() &&
         std::isfinite(path.entry_sd + path.depth + path.depth_sd + path.direction_sd +
                       path.direction_acceptable);
}

ExpertPath pathIn(const JsonFile& file) {
  if (file.text("format") != kFormat) file.refuse("format", "is not that of an expert path");
  file.needVersion(kPathVersion);
  constexpr double kFar_mm = 500;  // nothing that is taught lies farther from the clavicle
  constexpr int kMost = 1'000'000;
  ExpertPath path;
  path.simulated = file.flag("simulated");
  path.made_by = file.text("made_by");
  path.trials = file.integer("trials", 1, kMost);
  path.left_out = file.integer("left_out", 0, kMost);
  path.experts = file.texts("experts");
  path.entry_L = kMm * vectorIn(file, "entry_L_mm", kFar_mm);
  path.entry_sd = kMm * file.number("entry_sd_mm", 0, 10);
  path.depth = kMm * file.number("depth_mm", 0, 100);
  path.depth_sd = kMm * file.number("depth_sd_mm", 0, 10);
  path.direction_L = unitVectorIn(file, "direction_L");
  path.direction_sd = kDegree * file.number("direction_sd_deg", 0, 10);
  path.direction_acceptable = kDegree * file.number("direction_acceptable_deg", 0.1, 45);
  path.line_from_L = kMm * vectorIn(file, "line_from_L_mm", kFar_mm);
  path.line_to_L = kMm * vectorIn(file, "line_to_L_mm", kFar_mm);
  if ((path.line_to_L - path.line_from_L).norm() < 0.001)
    file.refuse("line_to_L_mm", "makes a line of no length");
  return path;
}

}  // namespace

ExpertPath readExpertPath(const std::filesystem::path& file) {
  const std::optional<std::string> text = readWhole(file);
  if (!text) throw Error("cannot be read", file.string(), "Check the path, or calibrate first");
  return parseExpertPath(*text, file.string());
}

ExpertPath parseExpertPath(std::string_view text, const std::string& where) {
  ExpertPath path = readOwnFile([&] { return pathIn(JsonFile::ofText(text, where, kRemedy)); });
  path.source = text;
  return path;
}

void writeExpertPath(const ExpertPath& path, const std::filesystem::path& file) {
  if (!allFinite(path))
    throw Error("the path holds a value that is not a number", file.string(), kRemedy);
  writeWhole(file, toJson(path).dump(2) + "\n");
}

}  // namespace palpa::calibration
