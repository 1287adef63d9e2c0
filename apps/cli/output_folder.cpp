#include "apps/cli/output_folder.h"

#include <ctime>
#include <fstream>

#include "anatomy/geometry/error.h"

namespace palpa::cli {
namespace {

std::string timeText(const char* pattern, bool utc) {
  const std::time_t now = std::time(nullptr);
  std::tm parts{};
  utc ? gmtime_r(&now, &parts) : localtime_r(&now, &parts);
  char text[64];
  std::strftime(text, sizeof text, pattern, &parts);
  return text;
}

}  // namespace

std::string utcNow() { return timeText("%Y-%m-%dT%H:%M:%SZ", true); }

std::filesystem::path makeOutputFolder(const std::string& given, const std::string& command) {
  const std::filesystem::path folder =
      given.empty() ? std::filesystem::path("out") / (command + "-" + timeText("%Y%m%d-%H%M%S", false))
                    : std::filesystem::path(given);
  std::error_code error;
  std::filesystem::create_directories(folder, error);
  if (error)
    throw Error("cannot be made (" + error.message() + ")", folder.string(), "Choose another with --out");
  const std::filesystem::path probe = folder / ".palpa-write-test";
  const bool written = static_cast<bool>(std::ofstream(probe) << "x" << std::flush);
  std::filesystem::remove(probe, error);
  if (!written)
    throw Error("cannot be written to", folder.string(), "Choose another folder with --out, or mend its permissions");
  return folder;
}

}  // namespace palpa::cli
