#include "source_tree.h"

#include <algorithm>
#include <fstream>
#include <iterator>
#include <map>

namespace palpa::house {
namespace {

namespace fs = std::filesystem;

bool isMade(const fs::path& entry) {
  const std::string name = entry.filename().string();
  return name == "build" || name == "out" || name.front() == '.';
}

std::string textOf(const fs::path& file) {
  std::ifstream stream(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(stream), std::istreambuf_iterator<char>()};
}

std::vector<SourceFile> readTree(const fs::path& top) {
  std::vector<SourceFile> files;
  for (fs::recursive_directory_iterator it(top), end; it != end; ++it) {
    if (it.depth() == 0 && isMade(it->path())) {
      if (it->is_directory()) it.disable_recursion_pending();
      continue;
    }
    if (it->is_regular_file() && !it->is_symlink())
      files.push_back({fs::relative(it->path(), top).generic_string(), textOf(it->path())});
  }
  std::sort(files.begin(), files.end(),
            [](const auto& a, const auto& b) { return a.path < b.path; });
  return files;
}

}  // namespace

bool SourceFile::isCode() const {
  const std::string extension = fs::path(path).extension().string();
  return extension == ".h" || extension == ".cpp";
}

bool SourceFile::isProduct() const { return isCode() && path.rfind("tests/", 0) != 0; }

const std::vector<SourceFile>& sourceTree(const fs::path& top) {
  static std::map<fs::path, std::vector<SourceFile>> trees;
  const auto known = trees.find(top);
  return known != trees.end() ? known->second : trees.emplace(top, readTree(top)).first->second;
}

std::string withoutComments(const std::string& code) {
  std::string kept;
  char quote = 0;
  for (std::size_t i = 0; i < code.size(); ++i) {
    const char c = code[i], next = i + 1 < code.size() ? code[i + 1] : '\0';
    if (quote) {
      kept += c;
      if (c == '\\')
        kept += code[++i];
      else if (c == quote || c == '\n')
        quote = 0;  // a digit separator (1'000) ends with its line
    } else if (c == '/' && (next == '/' || next == '*')) {
      const std::size_t stop = next == '/' ? code.find('\n', i) : code.find("*/", i + 2);
      if (stop == std::string::npos) break;
      i = next == '/' ? stop - 1 : stop + 1;
    } else {
      if (c == '"') quote = c;
      kept += c;
    }
  }
  return kept;
}

}  // namespace palpa::house
