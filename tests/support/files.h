#pragma once

#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>

namespace palpa::test {

/// A folder of its own in the build folder, empty at the start of the test. `suite`: the test's folder.
inline std::filesystem::path freshFolder(const std::string& suite, const std::string& name) {
  const auto folder = std::filesystem::path(PALPA_BUILD_DIR) / "tests" / suite / "tmp" / name;
  std::filesystem::remove_all(folder);
  std::filesystem::create_directories(folder);
  return folder;
}

inline std::string slurp(const std::filesystem::path& file) {
  std::ifstream stream(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(stream), {}};
}

}  // namespace palpa::test
