#pragma once

#include <cerrno>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <string_view>
#include <system_error>

#include "anatomy/geometry/error.h"

namespace palpa::record {

/// A file that is there whole or not at all: written beside under another name, renamed by
/// finish().
class WholeFile {
 public:
  explicit WholeFile(const std::filesystem::path& file)
      : file_(file), beside_(file.string() + ".part"), stream_(beside_, std::ios::binary) {
    if (!stream_) fail("cannot be created");
  }
  ~WholeFile() {
    std::error_code ignored;
    if (!finished_) std::filesystem::remove(beside_, ignored);
  }
  WholeFile(const WholeFile&) = delete;
  WholeFile& operator=(const WholeFile&) = delete;

  void write(std::string_view text) {
    stream_.write(text.data(), static_cast<std::streamsize>(text.size()));
    if (!stream_) fail("cannot be written");
  }
  void finish() {
    stream_.close();
    if (!stream_) fail("cannot be written");
    std::error_code problem;
    std::filesystem::rename(beside_, file_, problem);
    if (problem) fail("cannot be renamed into place");
    finished_ = true;
  }

 private:
  [[noreturn]] void fail(const char* what) const {
    throw Error(std::string(what) + " (" + std::strerror(errno) + ")", file_.string(),
                "Check that the folder exists, may be written to and has free space");
  }
  std::filesystem::path file_, beside_;
  std::ofstream stream_;
  bool finished_ = false;
};

}  // namespace palpa::record
