#include "tree.h"

#include <algorithm>

namespace palpa::guide {

namespace fs = std::filesystem;

fs::path top() { return PALPA_SOURCE_DIR; }

std::vector<fs::path> chapters() {
  std::vector<fs::path> files;
  for (const auto& entry : fs::directory_iterator(top() / "docs"))
    if (entry.path().extension() == ".md") files.push_back(entry.path());
  std::sort(files.begin(), files.end());
  return files;
}

std::vector<fs::path> pagesOfTheProject() {
  std::vector<fs::path> files;
  for (fs::recursive_directory_iterator it(top()), end; it != end; ++it) {
    const std::string name = it->path().filename().string();
    if (it->is_directory() &&
        (name == "build" || name == "out" || name == "node_modules" || name.front() == '.'))
      it.disable_recursion_pending();
    else if (it->path().extension() == ".md")
      files.push_back(it->path());
  }
  std::sort(files.begin(), files.end());
  return files;
}

}  // namespace palpa::guide
