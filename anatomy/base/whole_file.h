#pragma once

#include <filesystem>
#include <fstream>
#include <optional>
#include <string>
#include <string_view>

namespace palpa {

/// A file that is there whole or not at all: written beside under another name, renamed by
/// finish(). Never takes the place of a session or of records. All throw Error.
class WholeFile {
 public:
  explicit WholeFile(const std::filesystem::path& file);
  ~WholeFile();
  WholeFile(const WholeFile&) = delete;
  WholeFile& operator=(const WholeFile&) = delete;

  void write(std::string_view text);
  void finish();

 private:
  [[noreturn]] void fail(int reason) const;
  std::filesystem::path file_, beside_;
  std::ofstream stream_;
  bool finished_ = false;
};

void writeWhole(const std::filesystem::path& file, std::string_view content);

/// The bytes of a file; nullopt where it cannot be read or is a folder. How large a file may be is
/// the caller's question.
std::optional<std::string> readWhole(const std::filesystem::path& file);

}  // namespace palpa
