#include "include_arrows.h"

#include <algorithm>
#include <sstream>

namespace palpa::house {
namespace {

using Names = std::vector<std::string>;

bool begins(const std::string& text, const std::string& with) { return text.rfind(with, 0) == 0; }

/// `path` lies in `folder`; "apps/task_*" stands for every such folder.
bool within(const std::string& path, const std::string& folder) {
  if (folder.back() == '*') return begins(path, folder.substr(0, folder.size() - 1));
  return begins(path, folder + "/");
}

bool withinAny(const std::string& path, const Names& folders) {
  return std::any_of(folders.begin(), folders.end(),
                     [&](const auto& f) { return within(path, f); });
}

/// The folder a file lies in: apps/task_needle for apps/task_needle/hud_text.cpp.
std::string folderOf(const std::string& path) { return path.substr(0, path.rfind('/')); }

const Names kLibraries{"anatomy", "haptics", "calibration", "ar", "scene"};

Names librariesAnd(Names more) {
  more.insert(more.end(), kLibraries.begin(), kLibraries.end());
  return more;
}

std::vector<Layer> makeLayers() {
  const Names app_libraries{"Eigen", "OpenCV", "JSON"};
  return {
      {"anatomy/geometry", {}, {}, {"Eigen"}},
      {"anatomy/deflection", {"anatomy/geometry"}, {}, {"Eigen"}},
      {"haptics/materials", {"anatomy/geometry"}, {}, {"Eigen"}},
      {"haptics/surface", {"anatomy/geometry"}, {}, {"Eigen"}},
      {"haptics/augmentation", {"anatomy/geometry", "haptics/surface"}, {}, {"Eigen"}},
      {"haptics/sensors", {"haptics", "anatomy/geometry"}, {}, {"Eigen"}},
      {"anatomy/volume", {"anatomy"}, {}, {"Eigen", "JSON", "GDCM", "VTK data", "zlib"}},
      {"anatomy", {}, {}, {"Eigen", "JSON", "tinygltf", "GDCM", "VTK data"}},
      {"haptics/devices", {"haptics", "anatomy/geometry"}, {}, {"Eigen", "libusb"}},
      {"haptics", {"anatomy/geometry"}, {"haptics/devices", "haptics/sensors"}, {"Eigen"}},
      {"calibration",
       {"anatomy/geometry", "haptics/materials"},
       {},
       {"Eigen", "Ceres", "Boost", "OpenCV", "JSON"}},
      {"ar/headset", {"anatomy/geometry"}, {}, {"Eigen", "OpenXR", "GLM", "OpenGL"}},
      {"ar",
       {"anatomy/geometry", "calibration"},
       {"ar/headset"},
       {"Eigen", "OpenCV", "AprilTag", "JSON"}},
      {"scene", {"anatomy"}, {}, {"Eigen", "VTK", "VTK data", "OpenGL"}},
      {"apps/runtime", kLibraries, {}, app_libraries},
      {"apps/assess/competence", {"anatomy/geometry", "apps/assess"}, {}, {"Eigen", "JSON"}},
      {"apps/assess", kLibraries, {}, {"Eigen", "JSON", "Boost"}},
      {"apps/station", kLibraries, {}, {"Eigen", "OpenCV", "JSON", "OpenSSL"}},
      {"apps/record/store",
       librariesAnd({"apps/record", "apps/runtime", "apps/station"}),
       {},
       {"Eigen", "JSON", "SQLite", "PostgreSQL"}},
      {"apps/record", librariesAnd({"apps/runtime"}), {}, {"Eigen", "JSON", "SQLite", "zlib"}},
      {"apps/study",
       librariesAnd({"apps/runtime", "apps/station", "apps/record/store"}),
       {},
       {"Eigen", "JSON"}},
      {"apps/link/igtl",
       {"anatomy/geometry", "haptics", "ar", "apps/runtime"},
       {},
       {"Eigen", "JSON", "OpenIGTLink"}},
      {"apps/link",
       {"anatomy/geometry", "apps/record", "apps/assess/metrics", "apps/runtime", "apps/station"},
       {},
       {"JSON", "httplib", "OpenSSL"}},
      {"apps/study_analysis",
       {"anatomy", "apps/assess/statistics", "apps/assess/metrics"},
       {},
       {"Eigen", "Boost"}},
      {"apps/report",
       librariesAnd({"apps/assess", "apps/study_analysis"}),
       {},
       {"Eigen", "JSON", "VTK", "VTK data", "Cairo"}},
      {"apps/twin/phantom", {"anatomy/geometry", "apps/station"}, {}, {"Eigen", "JSON"}},
      {"apps/twin", librariesAnd({"apps/runtime", "apps/station"}), {}, app_libraries},
      {"apps/trial", librariesAnd({"apps/runtime", "apps/station"}), {}, app_libraries},
      {"apps/task_*",
       librariesAnd({"apps/trial", "apps/runtime", "apps/assess", "apps/station"}),
       {},
       app_libraries},
      {"apps/replay",
       librariesAnd({"apps/task_*", "apps/trial", "apps/assess", "apps/runtime"}),
       {},
       app_libraries},
      {"apps/live",
       {"anatomy/geometry", "haptics", "scene", "apps/runtime", "apps/trial"},
       {"haptics/devices"},
       {"OpenCV", "JSON"}},
      {"apps/console",
       {"anatomy/geometry", "apps/runtime", "apps/live", "apps/record", "apps/study",
        "apps/station"},
       {},
       {"JSON", "httplib", "OpenSSL"}},
      {"apps/doctor",
       librariesAnd({"apps/station", "apps/runtime", "apps/record/store", "apps/link/igtl"}),
       {},
       {"Eigen", "OpenCV", "JSON"}},
      {"apps/cli", librariesAnd({"apps"}), {}, {"Eigen", "OpenCV", "JSON", "CLI11"}},
      {"apps/bench",
       librariesAnd({"apps"}),
       {},
       {"Eigen", "OpenCV", "JSON", "VTK", "VTK data", "Embree"}},
      {"apps",
       librariesAnd({"apps"}),
       {"apps/twin"},
       {"Eigen", "OpenCV", "JSON", "httplib", "SQLite"}},
  };
}

const Layer* layerOf(const std::string& path) {
  for (const Layer& layer : layers())
    if (within(path, layer.folder)) return &layer;
  return nullptr;
}

bool allowed(const Layer& layer, const std::string& path, const std::string& header, bool quoted) {
  const std::string library = libraryOf(header);
  if (!library.empty())
    return std::find(layer.libraries.begin(), layer.libraries.end(), library) !=
           layer.libraries.end();
  if (!quoted || header.find('/') == std::string::npos) return true;
  const std::string own = layer.folder.back() == '*' ? folderOf(path) : layer.folder;
  if (withinAny(header, layer.not_ours)) return false;
  return within(header, own) || withinAny(header, layer.ours);
}

}  // namespace

std::vector<std::pair<std::string, bool>> includesOf(const std::string& code) {
  std::vector<std::pair<std::string, bool>> headers;
  std::istringstream lines(withoutComments(code));
  for (std::string line; std::getline(lines, line);) {
    const std::size_t hash = line.find_first_not_of(" \t");
    if (hash == std::string::npos || line[hash] != '#') continue;
    if (line.find("include", hash) == std::string::npos) continue;
    const std::size_t open = line.find_first_of("<\"", hash);
    const std::size_t close =
        open == std::string::npos ? open : line.find_first_of(">\"", open + 1);
    if (close == std::string::npos) continue;
    headers.emplace_back(line.substr(open + 1, close - open - 1), line[open] == '"');
  }
  return headers;
}

const std::vector<Layer>& layers() {
  static const std::vector<Layer> all = makeLayers();
  return all;
}

std::string libraryOf(const std::string& header) {
  if (begins(header, "vtk")) {
    for (const char* data : {"vtkSmartPointer", "vtkNew", "vtkPolyData", "vtkPoints",
                             "vtkCellArray", "vtkImageData", "vtkFloatArray", "vtkDoubleArray",
                             "vtkMatrix4x4", "vtkQuadricDecimation", "vtkDecimatePro"})
      if (begins(header, data) && header.find("Mapper") == std::string::npos) return "VTK data";
    return "VTK";
  }
  static const std::vector<std::pair<std::string, std::string>> kPrefixes{
      {"Eigen/", "Eigen"},     {"opencv2/", "OpenCV"},    {"nlohmann/", "JSON"},
      {"cairo/", "Cairo"},     {"tiny_gltf", "tinygltf"}, {"gdcm", "GDCM"},
      {"libusb", "libusb"},    {"ceres/", "Ceres"},       {"apriltag/", "AprilTag"},
      {"openxr/", "OpenXR"},   {"GL/", "OpenGL"},         {"EGL/", "OpenGL"},
      {"X11/", "OpenGL"},      {"CLI/", "CLI11"},         {"sqlite3", "SQLite"},
      {"pqxx/", "PostgreSQL"}, {"zlib", "zlib"},          {"httplib", "httplib"},
      {"igtl", "OpenIGTLink"}, {"boost/", "Boost"},       {"glm/", "GLM"},
      {"embree3/", "Embree"},  {"openssl/", "OpenSSL"}};
  for (const auto& [prefix, library] : kPrefixes)
    if (begins(header, prefix)) return library;
  return "";
}

std::vector<std::string> wrongIncludes(const SourceFile& file) {
  std::vector<std::string> wrong;
  const Layer* layer = layerOf(file.path);
  if (!layer) return wrong;
  for (const auto& [header, quoted] : includesOf(file.text))
    if (!allowed(*layer, file.path, header, quoted))
      wrong.push_back(file.path + " includes " + header + ", which " + layer->folder + " may not");
  return wrong;
}

}  // namespace palpa::house
