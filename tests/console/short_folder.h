#pragma once

#include <cstdlib>
#include <filesystem>
#include <string>

namespace palpa::console {

/// A folder with a short name, for sockets: a socket's path has 107 characters at most.
class ShortFolder {
 public:
  ShortFolder() { path_ = ::mkdtemp(name_); }
  ~ShortFolder() {
    std::error_code none;
    std::filesystem::remove_all(path_, none);
  }
  ShortFolder(const ShortFolder&) = delete;
  ShortFolder& operator=(const ShortFolder&) = delete;
  std::string operator/(const std::string& name) const { return (path_ / name).string(); }
  std::string path() const { return path_.string(); }

 private:
  char name_[32] = "/tmp/palpa-con-XXXXXX";
  std::filesystem::path path_;
};

}  // namespace palpa::console
