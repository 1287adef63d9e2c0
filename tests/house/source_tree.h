#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace palpa::house {

/// A file of the project: path from the top, with '/', and content.
struct SourceFile {
  std::string path;
  std::string text;
  bool isCode() const;     ///< .h or .cpp
  bool isProduct() const;  ///< code, and no test
};

/// Every file of the project; leaves out what is made (build/, out/) and what starts with a dot at
/// the top. Read once: later calls return the same.
const std::vector<SourceFile>& sourceTree(const std::filesystem::path& top);

/// Without // and /* */ comments; texts in quotes stay.
std::string withoutComments(const std::string& code);

}  // namespace palpa::house
