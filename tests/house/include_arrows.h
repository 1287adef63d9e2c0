#pragma once

#include <string>
#include <utility>
#include <vector>

#include "source_tree.h"

/// Which folder may include what. The build refuses most wrong arrows by its links, but a
/// header-only part or a library that comes along by chance slips through: this reads the #include
/// lines.
namespace palpa::house {

struct Layer {
  std::string folder;                 ///< "apps/task_*" stands for every folder that begins so
  std::vector<std::string> ours;      ///< folders of the project it may include, beside itself
  std::vector<std::string> not_ours;  ///< exceptions to `ours`
  std::vector<std::string>
      libraries;  ///< outside libraries; the language's and the system's are free
};

/// The arrows, longest folder first: the first that fits a file decides.
const std::vector<Layer>& layers();

/// Every include of `file` that its layer does not allow, in words; empty: none. Files that belong
/// to no layer (tests) are free.
std::vector<std::string> wrongIncludes(const SourceFile& file);

/// Headers that the code includes, and whether in quotes.
std::vector<std::pair<std::string, bool>> includesOf(const std::string& code);

/// "VTK", "OpenCV", "Eigen", ...; empty for the language's and the system's headers.
std::string libraryOf(const std::string& header);

}  // namespace palpa::house
