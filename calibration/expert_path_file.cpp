#include <cmath>
#include <nlohmann/json.hpp>

#include "anatomy/base/error.h"
#include "anatomy/base/json_text.h"
#include "anatomy/base/units.h"
#include "anatomy/base/whole_file.h"
#include "calibration/expert_path.h"

namespace palpa::calibration {
namespace {

using Json = nlohmann::json;
using Ordered = nlohmann::ordered_json;

constexpr int kPathVersion = 1;
constexpr const char* kFormat = "palpa expert path";

/// Reads fields of one file; every complaint names file and field.
class FieldReader {
 public:
  FieldReader(const std::string& where, const Json& root) : where_(where), root_(root) {}

  const Json& field(const std::string& key) const {
    if (!root_.is_object() || !root_.contains(key)) fail(key, "the field is missing");
    return root_.at(key);
  }
  double number(const std::string& key, double least, double most) const {
    return checked(field(key), key, least, most);
  }
  int count(const std::string& key, int least) const {
    if (!field(key).is_number_integer() || field(key).get<long long>() < least ||
        field(key).get<long long>() > 1'000'000)
      fail(key, "it must be a whole number from " + std::to_string(least));
    return field(key).get<int>();
  }
  Vec3 vector(const std::string& key, double most) const {
    const Json& value = field(key);
    if (!value.is_array() || value.size() != 3) fail(key, "it must be three numbers");
    Vec3 v;
    for (int i = 0; i < 3; ++i)
      v[i] = checked(value[static_cast<std::size_t>(i)], key, -most, most);
    return v;
  }
  Vec3 unitVector(const std::string& key) const {
    const Vec3 v = vector(key, 1.001);
    if (std::abs(v.norm() - 1) > 1e-3) fail(key, "it must be a unit vector");
    return v.normalized();
  }
  std::string text(const std::string& key) const {
    if (!field(key).is_string()) fail(key, "it must be a text");
    return field(key).get<std::string>();
  }
  bool flag(const std::string& key) const {
    if (!field(key).is_boolean()) fail(key, "it must be true or false");
    return field(key).get<bool>();
  }
  std::vector<std::string> texts(const std::string& key) const {
    const Json& value = field(key);
    if (!value.is_array()) fail(key, "it must be a list of texts");
    std::vector<std::string> result;
    for (const Json& item : value) {
      if (!item.is_string()) fail(key, "it must be a list of texts");
      result.push_back(item.get<std::string>());
    }
    return result;
  }
  [[noreturn]] void fail(const std::string& key, const std::string& what) const {
    throw Error(what, where_ + ", field \"" + key + "\"", "Calibrate the experts' path again");
  }

 private:
  double checked(const Json& value, const std::string& key, double least, double most) const {
    if (!value.is_number() || !std::isfinite(value.get<double>())) fail(key, "it is not a number");
    const double x = value.get<double>();
    if (x < least || x > most)
      fail(key, value.dump() + " is outside " + Json(least).dump() + " to " + Json(most).dump());
    return x;
  }

  const std::string& where_;
  const Json& root_;
};

Json parse(std::string_view text, const std::string& where) {
  try {
    return parseJson(text);
  } catch (const Json::exception&) {
    throw Error("this is not a JSON file", where, "Calibrate the experts' path again");
  }
}

void checkFormat(const FieldReader& reader) {
  if (reader.text("format") != kFormat) reader.fail("format", "this is not an expert path");
  const int version = reader.count("version", 1);
  if (version > kPathVersion)
    reader.fail("version", "version " + std::to_string(version) +
                               " is newer than this program knows (" +
                               std::to_string(kPathVersion) + "); update the program, or");
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

}  // namespace

ExpertPath readExpertPath(const std::filesystem::path& file) {
  const std::optional<std::string> text = readWhole(file);
  if (!text)
    throw Error("the file cannot be opened", file.string(), "Check the path, or calibrate first");
  return parseExpertPath(*text, file.string());
}

ExpertPath parseExpertPath(std::string_view text, const std::string& where) {
  const Json root = parse(text, where);
  const FieldReader reader(where, root);
  checkFormat(reader);
  constexpr double kFar_mm = 500;  // nothing that is taught lies farther from the clavicle
  ExpertPath path;
  path.source = text;
  path.simulated = reader.flag("simulated");
  path.made_by = reader.text("made_by");
  path.trials = reader.count("trials", 1);
  path.left_out = reader.count("left_out", 0);
  path.experts = reader.texts("experts");
  path.entry_L = kMm * reader.vector("entry_L_mm", kFar_mm);
  path.entry_sd = kMm * reader.number("entry_sd_mm", 0, 10);
  path.depth = kMm * reader.number("depth_mm", 0, 100);
  path.depth_sd = kMm * reader.number("depth_sd_mm", 0, 10);
  path.direction_L = reader.unitVector("direction_L");
  path.direction_sd = kDegree * reader.number("direction_sd_deg", 0, 10);
  path.direction_acceptable = kDegree * reader.number("direction_acceptable_deg", 0.1, 45);
  path.line_from_L = kMm * reader.vector("line_from_L_mm", kFar_mm);
  path.line_to_L = kMm * reader.vector("line_to_L_mm", kFar_mm);
  if ((path.line_to_L - path.line_from_L).norm() < 0.001)
    reader.fail("line_to_L_mm", "the line has no length");
  return path;
}

void writeExpertPath(const ExpertPath& path, const std::filesystem::path& file) {
  if (!allFinite(path))
    throw Error("the path holds a value that is not a number", file.string(),
                "Calibrate the experts' path again");
  writeWhole(file, toJson(path).dump(2) + "\n");
}

}  // namespace palpa::calibration
