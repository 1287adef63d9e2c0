#include "schema_files.h"

#include <algorithm>
#include <fstream>
#include <map>
#include <regex>
#include <stdexcept>

namespace palpa::schemas {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

constexpr const char* kEnding = ".schema.json";

/// Shipped files and their kinds: the one place where both meet.
struct Place {
  const char* pattern;  ///< of the whole path
  const char* kind;
};
constexpr Place kPlaces[] = {
    {"boards/[^/]+", "board"},
    {"campaigns/[^/]+", "campaign"},
    {"checklists/global_rating.json", "global_rating"},
    {"checklists/subclavian.json", "checklist"},
    {"materials/(needle|bone_pin).json", "needle_material"},
    {"materials/lumps.json", "lumps"},
    {"materials/(lumps|surfaces)/[^/]+", "calibration"},
    {"materials/surfaces.json", "surfaces"},
    {"operators/(expert|novice).json", "operator_needle"},
    {"operators/friction_[^/]+", "operator_friction"},
    {"operators/pulse_[^/]+", "operator_pulse"},
    {"operators/palpation_[^/]+", "operator_palpation"},
    {"operators/search_[^/]+", "operator_search"},
    {"operators/squeeze_[^/]+", "operator_squeeze"},
    {"patients/bodyparts3d_[^/]+", "patient_map"},
    {"patients/reference.json", "population"},
    {"materials/textures/[^/]+.json", "calibration"},
    {"phantoms/mockups.json", "phantoms"},
    {"phantoms/layered.json", "layered_phantoms"},
    {"phantoms/layered.tables.json", "layered_tables"},
    {"phantoms/textures/[^/]+", "rough_surfaces"},
    {"phantoms/mockups.tables.json", "phantom_tables"},
    {"phantoms/opposed.json", "opposed_phantoms"},
    {"phantoms/opposed.tables.json", "opposed_tables"},
    {"presentations/[^/]+", "presentation"},
    {"protocols/[^/]+", "protocol"},
    {"protocols/learners/[^/]+", "learners"},
    {"protocols/questionnaires/[^/]+", "questionnaire"},
    {"stations/[^/]+", "station"},
    {"interactions/[^/]+", "interactive_procedures"},
    {"tasks/[^/]+_expert_path.json", "expert_path"},
    {"tasks/(bone_pin|paracentesis|paracentesis_guided).json", "task_needle"},
    {"tasks/friction.json", "task_friction"},
    {"tasks/pulse.json", "task_pulse"},
    {"tasks/palpation_[^/]+", "task_palpation"},
    {"tasks/search.json", "task_search"},
    {"tasks/squeeze.json", "task_squeeze"},
    {"tasks/expert_ranges.json", "expert_ranges"},
    {"tasks/(?!.*_expert_path|expert_ranges)[^/]+\\.json", "task"},
    {"tracking/[^/]+", "tracking_model"},
};

json resolved(const json& node, const json& root) {
  if (node.is_object() && node.contains("$ref")) {
    const std::string reference = node.at("$ref").get<std::string>();
    const std::size_t hash = std::min(reference.find('#'), reference.size());
    const json other =
        hash == 0 ? root : jsonOf(assetsFolder() / "schemas" / reference.substr(0, hash));
    const json::json_pointer place(hash == reference.size() ? std::string()
                                                            : reference.substr(hash + 1));
    return resolved(other.at(place), other);
  }
  json whole = node;
  if (whole.is_object()) whole.erase("definitions");
  if (whole.is_structured())
    for (json& part : whole) part = resolved(json(part), root);
  return whole;
}

}  // namespace

fs::path assetsFolder() { return fs::path(PALPA_SOURCE_DIR) / "assets"; }

json jsonOf(const fs::path& file) {
  std::ifstream stream(file, std::ios::binary);
  if (!stream) throw std::runtime_error("cannot be read: " + file.string());
  return json::parse(stream);
}

json publishedSchema(const std::string& kind) {
  return jsonOf(assetsFolder() / "schemas" / (kind + kEnding));
}

json schemaOf(const std::string& kind) {
  const json schema = publishedSchema(kind);
  return resolved(schema, schema);
}

bool matches(const std::string& text, const std::string& pattern) {
  static std::map<std::string, std::regex> made;  // it takes longer than to match
  const auto found = made.find(pattern);
  return std::regex_match(text, found != made.end()
                                    ? found->second
                                    : made.emplace(pattern, std::regex(pattern)).first->second);
}

std::vector<std::string> publishedKinds() {
  std::vector<std::string> kinds;
  for (const fs::directory_entry& entry : fs::directory_iterator(assetsFolder() / "schemas")) {
    std::string name = entry.path().filename().string();
    if (!name.ends_with(kEnding)) continue;
    name.erase(name.find(kEnding));
    if (name != "common") kinds.push_back(name);
  }
  std::sort(kinds.begin(), kinds.end());
  return kinds;
}

std::vector<std::string> kindsOf(const std::string& asset) {
  std::vector<std::string> kinds;
  for (const Place& place : kPlaces)
    if (matches(asset, place.pattern)) kinds.emplace_back(place.kind);
  return kinds;
}

std::vector<std::string> shippedFiles() {
  std::vector<std::string> files;
  for (const fs::directory_entry& entry : fs::recursive_directory_iterator(assetsFolder())) {
    const fs::path asset = entry.path().lexically_relative(assetsFolder());
    if (entry.is_regular_file() && asset.extension() == ".json" && *asset.begin() != "schemas")
      files.push_back(asset.generic_string());
  }
  std::sort(files.begin(), files.end());
  return files;
}

}  // namespace palpa::schemas
