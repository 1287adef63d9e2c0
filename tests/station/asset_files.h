#pragma once

#include <unistd.h>

#include <cctype>
#include <filesystem>
#include <fstream>
#include <functional>
#include <iterator>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "anatomy/base/error.h"
#include "anatomy/parametric/population.h"
#include "apps/station/material_files.h"
#include "apps/station/station_file.h"
#include "apps/task_needle/task_file.h"
#include "apps/twin/operator.h"
#include "ar/boards/board.h"

/// Every settings file the program is shipped with, and who reads it.
namespace palpa::station {

struct AssetFile {
  std::string name;  ///< under assets/
  std::function<void(const std::filesystem::path&)> read;
  bool is_json_file = true;  ///< read through JsonFile: has "version", and errors name the field

  std::filesystem::path path() const {
    return std::filesystem::path(PALPA_SOURCE_DIR) / "assets" / name;
  }
  std::string text() const {
    std::ifstream stream(path(), std::ios::binary);
    return {std::istreambuf_iterator<char>(stream), std::istreambuf_iterator<char>()};
  }
  nlohmann::json json() const { return nlohmann::json::parse(text()); }
};

inline void PrintTo(const AssetFile& asset, std::ostream* out) { *out << asset.name; }

inline std::vector<AssetFile> assetFiles() {
  const auto skill = [](const auto& file) { twin::readOperatorSkill(file); };
  return {
      {"stations/virtual_bench.json", [](const auto& file) { readStation(file); }},
      {"materials/needle.json", [](const auto& file) { readNeedleFile(file); }},
      {"tasks/paracentesis.json", [](const auto& file) { task_needle::readTask(file); }},
      {"materials/bone_pin.json", [](const auto& file) { readNeedleFile(file); }},
      {"tasks/bone_pin.json", [](const auto& file) { task_needle::readTask(file); }},
      {"operators/expert.json", skill},
      {"operators/novice.json", skill},
      {"boards/table.json", [](const auto& file) { ar::readTagGrid(file); }, false},
      {"patients/reference.json", [](const auto& file) { anatomy::readPopulation(file.string()); },
       false},
      {"stations/falcon.json", [](const auto& file) { readStation(file); }},
  };
}

/// "stations_virtual_bench_json": a name for a test.
inline std::string testName(const AssetFile& asset) {
  std::string name = asset.name;
  for (char& c : name)
    if (!std::isalnum(static_cast<unsigned char>(c))) c = '_';
  return name;
}

/// A text as a file, gone at the end of its life.
class Scratch {
 public:
  explicit Scratch(const std::string& bytes)
      : path_(std::filesystem::temp_directory_path() /
              ("palpa-station-" + std::to_string(::getpid()) + ".json")) {
    std::ofstream(path_, std::ios::binary) << bytes;
  }
  ~Scratch() {
    std::error_code ignored;
    std::filesystem::remove(path_, ignored);
  }
  Scratch(const Scratch&) = delete;
  Scratch& operator=(const Scratch&) = delete;
  const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path path_;
};

/// What a reader said of a text.
struct Verdict {
  bool valid = false;
  bool usage_error = false;  ///< of the kind a person can act on
  std::string message;
};

inline Verdict judge(const AssetFile& asset, const std::string& text) {
  const Scratch file(text);
  try {
    asset.read(file.path());
    return {true, false, ""};
  } catch (const UsageError& e) {
    return {false, true, e.what()};
  } catch (const Error& e) {
    return {false, false, e.what()};
  }  // anything else is a fault of the reader and fails the test
}

}  // namespace palpa::station
