#include "apps/console/process_log.h"

#include <algorithm>
#include <fstream>

#include "anatomy/base/plain_text.h"

namespace palpa::console {
namespace {

constexpr std::streamoff kTail = 16 << 10;
constexpr std::size_t kLongestLine = 1000;

}  // namespace

std::vector<std::string> lastLines(const std::filesystem::path& log, std::size_t most) {
  std::ifstream file(log, std::ios::binary | std::ios::ate);
  if (!file) return {};
  const std::streamoff size = file.tellg();
  file.seekg(std::max<std::streamoff>(0, size - kTail));
  std::vector<std::string> lines;
  for (std::string line; std::getline(file, line);) {
    if (const std::size_t anew = line.rfind('\r'); anew != std::string::npos)
      line.erase(0, anew + 1);
    if (!line.empty()) lines.push_back(plainText(line, kLongestLine));
  }
  if (lines.size() > most)
    lines.erase(lines.begin(), lines.end() - static_cast<std::ptrdiff_t>(most));
  return lines;
}

std::string complaintIn(const std::filesystem::path& log) {
  const std::vector<std::string> lines = lastLines(log, 50);
  const auto found = std::find_if(lines.rbegin(), lines.rend(), [](const std::string& line) {
    return line.rfind("palpa: ", 0) == 0;
  });
  return found == lines.rend() ? "" : found->substr(7);
}

}  // namespace palpa::console
