#pragma once

#include <cstdlib>
#include <filesystem>
#include <stdexcept>
#include <string>

namespace palpa::test {

/// A folder of its own with a short name, gone at the end: a socket's path has 107 characters at
/// most, and a build folder's may have more.
class ShortFolder {
 public:
  ShortFolder() {
    std::string name = (std::filesystem::temp_directory_path() / "palpa-XXXXXX").string();
    if (!::mkdtemp(name.data())) throw std::runtime_error("no folder for temporary files");
    path_ = name;
  }
  ~ShortFolder() {
    std::error_code none;
    std::filesystem::remove_all(path_, none);
  }
  ShortFolder(const ShortFolder&) = delete;
  ShortFolder& operator=(const ShortFolder&) = delete;
  const std::filesystem::path& path() const { return path_; }
  std::filesystem::path operator/(const std::string& name) const { return path_ / name; }

 private:
  std::filesystem::path path_;
};

}  // namespace palpa::test
