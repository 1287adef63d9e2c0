#include "include_arrows.h"

#include <map>
#include <set>
#include <sstream>

#include "layers.h"

namespace palpa::house {
namespace {

bool begins(const std::string& text, const std::string& with) { return text.rfind(with, 0) == 0; }

bool allowed(const Layer& layer, const std::string& path, const std::string& header, bool quoted) {
  const std::string library = libraryOf(header);
  if (!library.empty()) return mayUse(layer, library);
  if (!quoted || header.find('/') == std::string::npos) return true;
  return mayInclude(layer, path, header);
}

/// What each product file includes of the project, and of outside libraries.
struct Includes {
  std::set<std::string> ours, libraries;
};
using Tree = std::map<std::string, Includes>;

Tree includesOfTree(const std::vector<SourceFile>& files) {
  Tree tree;
  for (const SourceFile& file : files)
    if (file.isCode() && layerOf(file.path)) tree[file.path] = {};
  for (const SourceFile& file : files) {
    const auto node = tree.find(file.path);
    if (node == tree.end()) continue;
    for (const auto& [header, quoted] : includesOf(file.text)) {
      const std::string path = pathOfHeader(file.path, header);
      const std::string library = libraryOf(header);
      if (quoted && tree.count(path)) node->second.ours.insert(path);
      if (!library.empty()) node->second.libraries.insert(library);
    }
  }
  return tree;
}

/// Every header that comes to `file` through others, and the one that includes it.
std::map<std::string, std::string> reachedFrom(const std::string& file, const Tree& tree) {
  std::map<std::string, std::string> by;
  std::vector<std::string> open{file};
  while (!open.empty()) {
    const std::string at = open.back();
    open.pop_back();
    for (const std::string& header : tree.at(at).ours)
      if (header != file && by.emplace(header, at).second) open.push_back(header);
  }
  return by;
}

void addWrongWays(const std::string& file, const Tree& tree, std::vector<std::string>& wrong) {
  const Layer& layer = *layerOf(file);
  for (const auto& [header, by] : reachedFrom(file, tree)) {
    const bool is_direct = by == file;
    if (!is_direct &&
        (layer.sealed ? !mayInclude(layer, file, header) : mustNotReach(layer, file, header)))
      wrong.push_back(file + " gets " + header + " through " + by);
    if (!layer.sealed) continue;
    for (const std::string& library : tree.at(header).libraries)
      if (!mayUse(layer, library))
        wrong.push_back(file + " gets " + library + " through " + header);
  }
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

std::string pathOfHeader(const std::string& file, const std::string& header) {
  if (header.find('/') != std::string::npos) return header;
  return file.substr(0, file.rfind('/') + 1) + header;
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
      {"Eigen/", "Eigen"},       {"unsupported/Eigen/", "Eigen"},
      {"opencv2/", "OpenCV"},    {"nlohmann/", "JSON"},
      {"cairo/", "Cairo"},       {"webp/", "WebP"},
      {"tiny_gltf", "tinygltf"}, {"gdcm", "GDCM"},
      {"libusb", "libusb"},      {"ceres/", "Ceres"},
      {"apriltag/", "AprilTag"}, {"openxr/", "OpenXR"},
      {"GL/", "OpenGL"},         {"EGL/", "OpenGL"},
      {"X11/", "OpenGL"},        {"CLI/", "CLI11"},
      {"sqlite3", "SQLite"},     {"pqxx/", "PostgreSQL"},
      {"zlib", "zlib"},          {"httplib", "httplib"},
      {"igtl", "OpenIGTLink"},   {"boost/", "Boost"},
      {"glm/", "GLM"},           {"embree3/", "Embree"},
      {"openssl/", "OpenSSL"},   {"AL/", "OpenAL"},
      {"avahi-", "Avahi"},       {"mosquitto", "Mosquitto"},
      {"cjose", "cjose"},        {"mqtt_protocol", "Mosquitto"}};
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

std::vector<std::string> wrongWays(const std::vector<SourceFile>& files) {
  const Tree tree = includesOfTree(files);
  std::vector<std::string> wrong;
  for (const auto& [file, includes] : tree) addWrongWays(file, tree, wrong);
  return wrong;
}

}  // namespace palpa::house
