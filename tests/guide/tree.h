#pragma once

#include <filesystem>
#include <vector>

namespace palpa::guide {

std::filesystem::path top();  ///< of the project
std::vector<std::filesystem::path>
chapters();  ///< docs/*.md, sorted; docs/README.md is one of them
std::vector<std::filesystem::path> pagesOfTheProject();  ///< every *.md but what is made, sorted

}  // namespace palpa::guide
