#include <algorithm>
#include <fstream>
#include <set>

#include "apps/doctor/device_check.h"
#include "apps/station/assets.h"

namespace palpa::doctor {
namespace {

namespace fs = std::filesystem;

constexpr const char* kRule = "udev rule";
constexpr const char* kRuleFile = "60-palpa-falcon.rules";

bool holds(const std::string& line, const char* words) {
  return line.find(words) != std::string::npos;
}

/// A line for the Falcon; empty: there is none in the file.
std::string lineIn(const fs::path& file) {
  std::ifstream stream(file);
  for (std::string line; std::getline(stream, line);) {
    const std::size_t begin = line.find_first_not_of(" \t");
    if (begin != std::string::npos && line[begin] != '#' && holds(line, "0403") &&
        holds(line, "cb48"))
      return line;
  }
  return {};
}

std::string remedy() {
  std::string file = kRuleFile;
  try {
    file = station::assetFile("udev/" + file).string();
  } catch (const std::exception&) {  // that the data are missing is told elsewhere
  }
  return "As root: cp " + file +
         " /etc/udev/rules.d/, then udevadm control --reload, and plug the Falcon in again. The "
         "Debian package brings the rule";
}

}  // namespace

const std::vector<fs::path>& udevFolders() {
  static const std::vector<fs::path> folders{"/etc/udev/rules.d", "/run/udev/rules.d",
                                             "/usr/local/lib/udev/rules.d", "/usr/lib/udev/rules.d",
                                             "/lib/udev/rules.d"};
  return folders;
}

Finding askUdevRule(const std::vector<fs::path>& folders) {
  std::set<std::string> seen;
  std::error_code none;
  for (const fs::path& folder : folders)
    for (const auto& entry : fs::directory_iterator(folder, none)) {
      const fs::path& file = entry.path();
      if (file.extension() != ".rules" || !seen.insert(file.filename().string()).second) continue;
      const std::string line = lineIn(file);
      if (line.empty()) continue;
      if (holds(line, "uaccess") || holds(line, "GROUP") || holds(line, "0666"))
        return {kRule, State::well, "the Falcon may be used: " + file.string()};
      return {kRule, State::note,
              file.string() + " names the Falcon and lets nobody but root use it", remedy()};
    }
  return {kRule, State::note, "there is none for the Falcon: only root may use it", remedy()};
}

}  // namespace palpa::doctor
