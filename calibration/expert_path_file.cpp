#include <cmath>
#include <nlohmann/json.hpp>

#include "anatomy/base/error.h"
#include "anatomy/base/file_schema.h"
#include "anatomy/base/json_file.h"
#include "anatomy/base/units.h"
#include "anatomy/base/whole_file.h"
#include "calibration/expert_path.h"

namespace palpa::calibration {
namespace {

using Json = nlohmann::json;
using Ordered = nlohmann::ordered_json;

constexpr int kPathVersion = 2;
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

/// How each version names what it holds: version 1 in L, of an average body.
struct Names {
  const char *entry, *direction, *line_from, *line_to;
};
constexpr Names kInL{"entry_L_mm", "direction_L", "line_from_L_mm", "line_to_L_mm"},
    kOwn{"entry_mm", "direction", "line_from_mm", "line_to_mm"};

Ordered toJson(const ExpertPath& path) {
  return {{"format", kFormat},
          {"version", kPathVersion},
          {"simulated", path.simulated},
          {"made_by", path.made_by},
          {"frame",
           "the teaching line of each body: along it, across it inward, across it cephalad; entry "
           "and line_from from its entry point, line_to from the middle of its vein; direction "
           "against the way from where the needle is turned to the vein"},
          {"trials", path.trials},
          {"left_out", path.left_out},
          {"experts", path.experts},
          {kOwn.entry, inMm(path.entry)},
          {"entry_sd_mm", path.entry_sd / kMm},
          {"entry_acceptable_mm", path.entry_acceptable / kMm},
          {"depth_mm", path.depth / kMm},
          {"depth_sd_mm", path.depth_sd / kMm},
          {"depth_acceptable_mm", path.depth_acceptable / kMm},
          {kOwn.direction, {path.direction.x(), path.direction.y(), path.direction.z()}},
          {"direction_sd_deg", path.direction_sd / kDegree},
          {"direction_acceptable_deg", path.direction_acceptable / kDegree},
          {kOwn.line_from, inMm(path.line_from)},
          {kOwn.line_to, inMm(path.line_to)},
          {"line_sd_mm", path.line_sd / kMm},
          {"line_acceptable_mm", path.line_acceptable / kMm}};
}

bool allFinite(const ExpertPath& path) {
  return path.entry.allFinite() && path.direction.allFinite() && path.line_from.allFinite() &&
         path.line_to.allFinite() &&
         std::isfinite(path.entry_sd + path.depth + path.depth_sd + path.direction_sd +
                       path.line_sd + path.entry_acceptable + path.depth_acceptable +
                       path.direction_acceptable + path.line_acceptable);
}

constexpr double kFar_mm = 500;  // nothing that is taught lies farther from the clavicle

void readVectors(const JsonFile& file, const Names& names, ExpertPath* path) {
  path->entry = kMm * vectorIn(file, names.entry, kFar_mm);
  path->direction = unitVectorIn(file, names.direction);
  path->line_from = kMm * vectorIn(file, names.line_from, kFar_mm);
  path->line_to = kMm * vectorIn(file, names.line_to, kFar_mm);
}

void readOwnLine(const JsonFile& file, ExpertPath* path) {
  readVectors(file, kOwn, path);
  path->line_sd = kMm * file.number("line_sd_mm", 0, 10);
  path->entry_acceptable = kMm * file.number("entry_acceptable_mm", 0.1, 50);
  path->depth_acceptable = kMm * file.number("depth_acceptable_mm", 0.1, 50);
  path->line_acceptable = kMm * file.number("line_acceptable_mm", 0.1, 50);
}

void readInLandmarks(const JsonFile& file, ExpertPath* path) {
  readVectors(file, kInL, path);
  if ((path->line_to - path->line_from).norm() < 0.001)
    file.refuse(kInL.line_to, "makes a line of no length");
}

void needFormat(const JsonFile& file) {
  if (file.text("format") != kFormat) file.refuse("format", "is not that of an expert path");
}

ExpertPath pathIn(const JsonFile& file) {
  needFormat(file);
  constexpr int kMost = 1'000'000;
  ExpertPath path;
  path.axes = file.needVersion(kPathVersion) == 1 ? PathAxes::landmarks : PathAxes::own_line;
  path.simulated = file.flag("simulated");
  path.made_by = file.text("made_by");
  path.trials = file.integer("trials", 1, kMost);
  path.left_out = file.integer("left_out", 0, kMost);
  path.experts = file.texts("experts");
  path.entry_sd = kMm * file.number("entry_sd_mm", 0, 10);
  path.depth = kMm * file.number("depth_mm", 0, 100);
  path.depth_sd = kMm * file.number("depth_sd_mm", 0, 10);
  path.direction_sd = kDegree * file.number("direction_sd_deg", 0, 10);
  path.direction_acceptable = kDegree * file.number("direction_acceptable_deg", 0.1, 45);
  path.axes == PathAxes::own_line ? readOwnLine(file, &path) : readInLandmarks(file, &path);
  return path;
}

}  // namespace

ExpertPath readExpertPath(const std::filesystem::path& file) {
  const std::optional<std::string> text = readWhole(file);
  if (!text) throw Error("cannot be read", file.string(), "Check the path, or calibrate first");
  const JsonFile json = readOwnFile([&] {
    JsonFile whole = JsonFile::ofText(*text, file.string(), kRemedy);
    if (whole.has("format")) needFormat(whole);
    if (whole.has("version")) whole.needVersion(kPathVersion);
    return whole;
  });
  refuseUnknownFields(json, "expert_path");  // a recording's copy is taken as it is
  return parseExpertPath(*text, file.string());
}

ExpertPath parseExpertPath(std::string_view text, const std::string& where) {
  ExpertPath path = readOwnFile([&] { return pathIn(JsonFile::ofText(text, where, kRemedy)); });
  path.source = text;
  return path;
}

void writeExpertPath(const ExpertPath& path, const std::filesystem::path& file) {
  if (path.axes != PathAxes::own_line)
    throw Error(
        "the path is about landmarks, as in files of version 1; those are read, not written",
        file.string(), kRemedy);
  if (!allFinite(path))
    throw Error("the path holds a value that is not a number", file.string(), kRemedy);
  writeWhole(file, toJson(path).dump(2) + "\n");
}

}  // namespace palpa::calibration
