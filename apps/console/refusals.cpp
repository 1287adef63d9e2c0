#include "apps/console/refusals.h"

#include <algorithm>
#include <fstream>

#include "apps/runtime/serving_clock.h"

namespace palpa::console {
namespace {

constexpr std::uintmax_t kLongest = 1u << 20;
constexpr std::size_t kLongestPart = 120;

/// In one line and short, whatever somebody sent.
std::string plain(const std::string& text) {
  std::string line = text.substr(0, kLongestPart);
  std::replace_if(
      line.begin(), line.end(), [](unsigned char c) { return c < 0x20 || c >= 0x7f; }, '?');
  return line;
}

/// One word of it: what was sent adds no words of its own.
std::string word(const std::string& text) {
  std::string one = plain(text);
  std::replace(one.begin(), one.end(), ' ', '?');
  return one.empty() ? "-" : one;
}

}  // namespace

void Refusals::note(const std::string& remote, const std::string& method, const std::string& path,
                    int status, const std::string& words) {
  const std::lock_guard lock(mutex_);
  std::error_code none;
  if (std::filesystem::file_size(file_, none) > kLongest && !none)
    std::filesystem::rename(file_, file_.string() + ".1", none);
  std::ofstream(file_, std::ios::app)
      << runtime::utcNow() << ' ' << word(remote) << ' ' << word(method) << ' '
      << word(path.substr(0, path.find('?'))) << ' ' << status << ' ' << plain(words) << '\n';
}

}  // namespace palpa::console
