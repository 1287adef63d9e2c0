#include "layers.h"

#include <algorithm>

namespace palpa::house {
namespace {

using Names = std::vector<std::string>;

bool begins(const std::string& text, const std::string& with) { return text.rfind(with, 0) == 0; }

bool isPattern(const std::string& folder) { return folder.back() == '*'; }

bool within(const std::string& path, const std::string& folder) {
  if (isPattern(folder)) return begins(path, folder.substr(0, folder.size() - 1));
  return path == folder || begins(path, folder + "/");
}

bool withinAny(const std::string& path, const Names& folders) {
  return std::any_of(folders.begin(), folders.end(),
                     [&](const std::string& folder) { return within(path, folder); });
}

bool contains(const Names& names, const std::string& name) {
  return std::find(names.begin(), names.end(), name) != names.end();
}

/// The folder that a file of `layer` may use freely: apps/task_needle for
/// apps/task_needle/needle_scene.cpp.
std::string ownFolder(const Layer& layer, const std::string& path) {
  if (!isPattern(layer.folder)) return layer.folder;
  return path.substr(0, path.find('/', layer.folder.size() - 1));
}

/// "needle", "palpation", "comparison", "search" or "pulse" for the files of one kind of task
/// alone; empty: others.
std::string engineOf(const std::string& path) {
  for (const char* before : {"apps/task_", "apps/assess/", "apps/report/"})
    for (const char* engine : {"needle", "palpation", "comparison", "search", "pulse"})
      if (begins(path, std::string(before) + engine + "/")) return engine;
  return "";
}

bool areOfOtherEngines(const std::string& path, const std::string& header) {
  const std::string engine = engineOf(path), other = engineOf(header);
  return !engine.empty() && !other.empty() && engine != other;
}

}  // namespace

const Layer* layerOf(const std::string& path) {
  const Layer* longest = nullptr;
  for (const Layer& layer : layers())
    if (within(path, layer.folder) && (!longest || layer.folder.size() > longest->folder.size()))
      longest = &layer;
  return longest;
}

bool mustNotReach(const Layer& layer, const std::string& path, const std::string& header) {
  if (withinAny(header, layer.never) || areOfOtherEngines(path, header)) return true;
  const bool is_other_task = isPattern(layer.folder) && within(header, layer.folder) &&
                             !within(header, ownFolder(layer, path));
  return is_other_task;
}

bool mayInclude(const Layer& layer, const std::string& path, const std::string& header) {
  if (mustNotReach(layer, path, header)) return false;
  return within(header, ownFolder(layer, path)) || within(header, "anatomy/base") ||
         withinAny(header, layer.ours);
}

bool mayUse(const Layer& layer, const std::string& library) {
  return contains(layer.libraries, library);
}

}  // namespace palpa::house
