#include "anatomy/geometry/whole_file.h"

#include <cerrno>
#include <cstring>
#include <fstream>
#include <string>

#include "anatomy/geometry/error.h"

namespace palpa {

void writeWhole(const std::filesystem::path& file, std::string_view content) {
  const std::filesystem::path beside = file.string() + ".part";
  std::error_code problem;
  std::ofstream stream(beside, std::ios::binary);
  stream.write(content.data(), static_cast<std::streamsize>(content.size()));
  stream.close();
  if (stream) {
    std::filesystem::rename(beside, file, problem);
    if (!problem) return;
  }
  const std::string reason = problem ? problem.message() : std::strerror(errno);
  std::filesystem::remove(beside, problem);
  throw Error("cannot be written (" + reason + ")", file.string(),
              "Check that the folder exists, may be written to and has free space");
}

}  // namespace palpa
