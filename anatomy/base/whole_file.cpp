#include "anatomy/base/whole_file.h"

#include <array>
#include <cerrno>
#include <cstring>
#include <system_error>

#include "anatomy/base/error.h"

namespace palpa {

namespace {

/// A session's evidence and a centre's records are databases; a page or a table that is given their
/// name must not take their place.
bool isDatabase(const std::filesystem::path& file) {
  constexpr std::string_view kBegins = "SQLite format 3";
  std::string start(kBegins.size(), ' ');
  std::ifstream stream(file, std::ios::binary);
  return stream.read(start.data(), static_cast<std::streamsize>(start.size())) && start == kBegins;
}

}  // namespace

WholeFile::WholeFile(const std::filesystem::path& file)
    : file_(file), beside_(file.string() + ".part") {
  if (isDatabase(file_))
    throw Error("holds a session or records, which nothing overwrites", file_.string(),
                "Give another name");
  stream_.open(beside_, std::ios::binary);
  if (!stream_) fail(errno);
}

WholeFile::~WholeFile() {
  std::error_code ignored;
  if (!finished_) std::filesystem::remove(beside_, ignored);
}

void WholeFile::write(std::string_view text) {
  stream_.write(text.data(), static_cast<std::streamsize>(text.size()));
  if (!stream_) fail(errno);
}

void WholeFile::finish() {
  stream_.close();
  if (!stream_) fail(errno);
  std::error_code problem;
  std::filesystem::rename(beside_, file_, problem);
  if (problem) fail(problem.value());
  finished_ = true;
}

void WholeFile::fail(int reason) const {
  throw Error(std::string("cannot be written (") + std::strerror(reason) + ")", file_.string(),
              "Check that the folder exists, may be written to and has free space");
}

void writeWhole(const std::filesystem::path& file, std::string_view content) {
  WholeFile whole(file);
  whole.write(content);
  whole.finish();
}

std::optional<std::string> readWhole(const std::filesystem::path& file) {
  std::ifstream stream(file, std::ios::binary);
  if (!stream) return std::nullopt;
  std::string bytes;
  std::array<char, 1 << 16> part;
  do {
    stream.read(part.data(), part.size());
    bytes.append(part.data(), static_cast<std::size_t>(stream.gcount()));
  } while (stream);
  if (stream.bad()) return std::nullopt;
  return bytes;
}

}  // namespace palpa
