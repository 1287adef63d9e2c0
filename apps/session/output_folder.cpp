#include "apps/session/output_folder.h"

#include "apps/runtime/clock.h"

#include <fstream>

#include "anatomy/base/error.h"

namespace palpa::session {
std::filesystem::path makeOutputFolder(const std::string& given, const std::string& command) {
  std::filesystem::path folder =
      given.empty() ? std::filesystem::path("out") /
                          (command + "-" + runtime::dateText("%Y%m%d-%H%M%S", runtime::Zone::local))
                    : std::filesystem::path(given);
  std::error_code error;
  std::filesystem::create_directories(folder, error);
  if (error)
    throw Error("cannot be made (" + error.message() + ")", folder.string(),
                "Choose another with --out");
  const std::filesystem::path probe = folder / ".palpa-write-test";
  const bool written = static_cast<bool>(std::ofstream(probe) << "x" << std::flush);
  std::filesystem::remove(probe, error);
  if (!written)
    throw Error("cannot be written to", folder.string(),
                "Choose another folder with --out, or correct its permissions");
  return folder;
}

}  // namespace palpa::session
