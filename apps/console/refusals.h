#pragma once

#include <filesystem>
#include <mutex>
#include <string>

namespace palpa::console {

/// What was refused, to whom and why, in a file that does not grow beyond a megabyte or two; never
/// a token, cookie, query or body.
class Refusals {
 public:
  explicit Refusals(std::filesystem::path file) : file_(std::move(file)) {}
  void note(const std::string& remote, const std::string& method, const std::string& path,
            int status, const std::string& words);

 private:
  const std::filesystem::path file_;
  std::mutex mutex_;
};

}  // namespace palpa::console
