#pragma once

#include <string>
#include <utility>
#include <vector>

#include "source_tree.h"

/// Which folder may include what (layers.h). The build refuses most wrong arrows by its links, but
/// a header-only part or a library that comes along by chance slips through: this reads the
/// #include lines.
namespace palpa::house {

/// Every include of `file` that its layer does not allow, in words; empty: none. Files that belong
/// to no layer (tests) are free.
std::vector<std::string> wrongIncludes(const SourceFile& file);

/// What must not come to a file through the headers that it includes either, in words: the folders
/// its layer never sees; for a sealed layer everything else that it may not include. For each file
/// and header, one way that leads there.
std::vector<std::string> wrongWays(const std::vector<SourceFile>& tree);

/// Headers that the code includes, and whether in quotes.
std::vector<std::pair<std::string, bool>> includesOf(const std::string& code);

/// Where a header in quotes lies: beside the file that includes it when no folder is given.
std::string pathOfHeader(const std::string& file, const std::string& header);

/// "VTK", "OpenCV", "Eigen", ...; empty for the language's and the system's headers.
std::string libraryOf(const std::string& header);

}  // namespace palpa::house
