#pragma once

#include <string>
#include <vector>

/// The folders of the product, and which of them and which outside libraries each may use.
namespace palpa::house {

struct Layer {
  std::string folder;  ///< "apps/task_*" stands for every folder that begins so
  /// Folders and headers it may include. Itself and anatomy/base are free.
  std::vector<std::string> ours{};
  /// Exceptions to those: not even through other headers.
  std::vector<std::string> never{};
  std::vector<std::string> libraries{};  ///< outside ones; the language's and the system's are free
  bool sealed = false;  ///< ours and libraries hold for what comes through other headers, too
};

const std::vector<Layer>& layers();

/// The layer with the longest folder that holds the file; nullptr for files of no layer (tests).
const Layer* layerOf(const std::string& path);

/// `header` of the project must not come to the file at `path` by any way. Kinds of task (needle,
/// palpation, comparison, search, pulse) do not know each other, neither as tasks nor in scores and
/// reports.
bool mustNotReach(const Layer& layer, const std::string& path, const std::string& header);

/// The file at `path` may include `header` of the project.
bool mayInclude(const Layer& layer, const std::string& path, const std::string& header);

bool mayUse(const Layer& layer, const std::string& library);

}  // namespace palpa::house
